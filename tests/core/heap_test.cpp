#include "core/heap.h"

#include <doctest/doctest.h>

#include <fstream>
#include <memory>
#include <thread>
#include <vector>

using namespace vasa;

// Sanitizers have allocators of their own; clang does not say by these names that it builds for one.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__clang__)
namespace {

// [MiB] in memory.
double resident() {
  std::ifstream file("/proc/self/statm");
  double all = 0, pages = 0;
  file >> all >> pages;
  return pages * 4096 / (1 << 20);
}

}  // namespace

TEST_CASE("what another thread asked for and this one frees goes back to the system") {
  std::vector<std::unique_ptr<char[]>> blocks(40'000);
  std::thread([&] {
    for (auto& block : blocks) block = std::make_unique<char[]>(2'000);
  }).join();
  const double before = resident();
  auto last = std::move(blocks.back());  // that heap's end stays in use, and all before it is kept
  blocks.clear();
  CHECK(before - resident() < 20);
  returnFreedMemory();
  CHECK(before - resident() > 60);
}
#endif
