#include "core/parallel.h"

#include <doctest/doctest.h>

#ifdef __linux__
#include <sys/resource.h>
#endif

#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace vasa;

TEST_CASE("every index is visited once, for any number of threads") {
  for (const unsigned threads : {1u, 2u, 8u}) {
    setThreadCount(threads);
    CHECK(threadCount() == threads);
    std::vector<int> visits(1000, 0);
    parallelFor(visits.size(), 7, [&](std::size_t i) { ++visits[i]; });
    for (const int count : visits) CHECK(count == 1);
  }
  parallelFor(0, 1, [](std::size_t) { FAIL("nothing to do"); });
}

TEST_CASE("an exception leaves the loop") {
  CHECK_THROWS_AS(parallelFor(100, 1,
                              [](std::size_t i) {
                                if (i == 50) throw std::runtime_error("stop");
                              }),
                  std::runtime_error);
}

#ifdef __linux__
TEST_CASE(
    "a thread that gives way and its loops' workers have a lower priority, and the thread beside it its own") {
  const auto priority = [] { return getpriority(PRIO_PROCESS, 0); };
  const int before = priority();
  setThreadCount(4);
  std::mutex mutex;
  const auto prioritiesInLoop = [&] {
    std::set<int> seen;
    parallelFor(64, 1, [&](std::size_t) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // workers have time to come
      const std::lock_guard lock(mutex);
      seen.insert(priority());
    });
    return seen;
  };
  CHECK(prioritiesInLoop() == std::set<int>{before});  // makes workers that have the usual one
  std::set<int> seen;
  std::thread([&] {
    giveWay();
    giveWay();
    seen = prioritiesInLoop();
  }).join();
  CHECK(seen == std::set<int>{std::max(before, 10)});
  CHECK(priority() == before);
  setThreadCount(0);
}
#endif
