#include "gpu/driver_threads.h"

#ifdef __linux__
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
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
void DriverThreads::spread() const {
  const std::vector<int> on = processors(), now = threadsOfProcess();
  if (on.size() < 2) return;
  std::vector<int> made;
  std::ranges::set_difference(now, before_, std::back_inserter(made));
  std::erase_if(made, [](int thread) { return nameOf(thread) != kMaker && !isRasteriser(thread); });
  const auto first = std::ranges::find_if(made, isRasteriser),
             last = std::find_if_not(first, made.end(), isRasteriser);
  const std::ptrdiff_t count = last - first;
  for (std::ptrdiff_t k = 0; k < 2 * count && k < made.end() - first; ++k)
    keepOn(first[k], on[std::size_t(k % count) % on.size()]);
}
#else
DriverThreads::DriverThreads() = default;
DriverThreads::~DriverThreads() = default;
void DriverThreads::spread() const {}
#endif

}  // namespace vasa::gpu
