#ifdef __linux__
#include <doctest/doctest.h>
#include <sched.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "gpu/gpu_rig.h"

using namespace vasa;

namespace {

cpu_set_t processorsOf(int thread) {
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(thread, sizeof set, &set);
  return set;
}

int firstOf(const cpu_set_t& set) {
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &set)) return i;
  return -1;
}

}  // namespace

TEST_CASE("a CPU device's rasterisers lie on a processor each, and this thread wherever it could before") {
  const cpu_set_t own = processorsOf(0);
  VASA_REQUIRE_GPU(rig);
  const cpu_set_t after = processorsOf(0);
  CHECK(CPU_EQUAL(&own, &after));
  std::size_t rasterisers = 0;
  std::set<int> used;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string name;
    std::getline(std::ifstream(entry.path() / "comm"), name);
    if (!name.starts_with("llvmpipe-")) continue;
    const cpu_set_t set = processorsOf(std::stoi(entry.path().filename().string()));
    if (CPU_COUNT(&own) > 1) CHECK(CPU_COUNT(&set) == 1);
    CHECK(CPU_ISSET(firstOf(set), &own));
    used.insert(firstOf(set));
    ++rasterisers;
  }
  if (rig.device().adapter().name.starts_with("llvmpipe")) CHECK(rasterisers > 0);
  CHECK(used.size() == std::min(rasterisers, std::size_t(CPU_COUNT(&own))));
}
#endif
