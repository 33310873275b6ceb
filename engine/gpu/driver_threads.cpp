#include "gpu/driver_threads.h"

#ifdef __linux__
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <thread>
#endif

namespace vasa::gpu {

#ifdef __linux__
namespace {

constexpr std::string_view kRasteriser = "llvmpipe-";
constexpr const char* kMaker = "vasa-driver";

std::vector<int> threadsOfProcess() {
  std::vector<int> threads;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task", failed)) {
    const std::string name = entry.path().filename().string();
    int id = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), id).ec == std::errc()) threads.push_back(id);
  }
  std::ranges::sort(threads);
  return threads;
}

std::string nameOf(int thread) {
  std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/comm");
  std::string name;
  std::getline(file, name);
  return name;
}

bool isRasteriser(int thread) { return nameOf(thread).starts_with(kRasteriser); }

std::vector<int> processors() {
  std::vector<int> list;
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return list;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &set)) list.push_back(i);
  return list;
}

void keepOn(int thread, int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(processor, &set);
  sched_setaffinity(thread, sizeof set, &set);  // a thread that is gone by now needs none
}

}  // namespace

DriverThreads::DriverThreads() : before_(threadsOfProcess()) {
  pthread_getname_np(pthread_self(), name_.data(), name_.size());
  pthread_setname_np(pthread_self(), kMaker);
}

DriverThreads::~DriverThreads() { pthread_setname_np(pthread_self(), name_.data()); }

// The driver makes its rasterisers, then as many unnamed threads for compute shaders; ids grow in that order.
// A rasteriser names itself once it runs, which on a busy machine may be a moment after it was made.
std::vector<int> DriverThreads::made() const {
  std::vector<int> threads;
  for (int wait = 0; wait < 20; ++wait) {
    threads.clear();
    const std::vector<int> now = threadsOfProcess();
    std::ranges::set_difference(now, before_, std::back_inserter(threads));
    std::erase_if(threads, [](int thread) { return nameOf(thread) != kMaker && !isRasteriser(thread); });
    if (2 * std::ranges::count_if(threads, isRasteriser) >= std::ptrdiff_t(threads.size())) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return threads;
}

void DriverThreads::spread() const {
  const std::vector<int> on = processors();
  if (on.size() < 2) return;
  const std::vector<int> made = this->made();
  const auto first = std::ranges::find_if(made, isRasteriser),
             last = std::find_if_not(first, made.end(), isRasteriser);
  const std::ptrdiff_t count = last - first;
  for (std::ptrdiff_t k = 0; k < 2 * count && k < made.end() - first; ++k)
    keepOn(first[k], on[std::size_t(k % count) % on.size()]);
}
#else
DriverThreads::DriverThreads() = default;
DriverThreads::~DriverThreads() = default;
std::vector<int> DriverThreads::made() const { return {}; }
void DriverThreads::spread() const {}
#endif

}  // namespace vasa::gpu
