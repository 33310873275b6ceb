#include "core/parallel.h"

#include <doctest/doctest.h>

#include <stdexcept>
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
  CHECK_THROWS_AS(parallelFor(100, 1, [](std::size_t i) { if (i == 50) throw std::runtime_error("stop"); }),
                  std::runtime_error);
}
