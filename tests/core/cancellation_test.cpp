#include "core/cancellation.h"

#include <doctest/doctest.h>

#include <atomic>

#include "core/parallel.h"

using namespace vasa;

TEST_CASE("a checkpoint lets pass what nobody cancelled, and everything outside of a scope") {
  checkpoint();
  Cancellation wish;
  {
    const CancellationScope scope(wish);
    checkpoint();
    wish.ask();
    CHECK(wish.asked());
    CHECK_THROWS_AS(checkpoint(), Cancelled);
    {
      const Cancellation other;
      const CancellationScope inner(other);
      checkpoint();
    }
    CHECK_THROWS_AS(checkpoint(), Cancelled);
  }
  checkpoint();
}

TEST_CASE("cheap rounds are looked at now and then") {
  Cancellation wish;
  const CancellationScope scope(wish);
  wish.ask();
  Checkpoints checkpoints;
  int rounds = 0;
  CHECK_THROWS_AS(for (; rounds < 100000; ++rounds) checkpoints.pass(), Cancelled);
  CHECK(rounds < 5000);
}

TEST_CASE("a parallel loop leaves by Cancelled on whatever thread it runs, also from a loop within") {
  for (const unsigned threads : {1u, 4u}) {
    setThreadCount(threads);
    Cancellation wish;
    std::atomic<int> begun{0};
    const auto work = [&] {
      const CancellationScope scope(wish);
      parallelFor(1000, 1, [&](std::size_t i) {
        if (++begun == 5) wish.ask();
        parallelFor(50, 1, [&](std::size_t) { CHECK(i < 1000); });
      });
    };
    CHECK_THROWS_AS(work(), Cancelled);
    CHECK(begun < 1000);
    std::atomic<int> after{0};
    parallelFor(10, 1, [&](std::size_t) { ++after; });  // the threads are free of it again
    CHECK(after == 10);
  }
}
