#include "core/unawaited.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>

using namespace vasa;

TEST_CASE("work that nothing waits for goes on when its future is let go, and is known of until it ends") {
  std::promise<void> leave;
  std::atomic<bool> begun = false;
  {
    const std::future<void> done =
        startUnawaited([&begun, wish = std::make_shared<std::future<void>>(leave.get_future())] {
          begun = true;
          wish->wait();
        });
    CHECK(done.wait_for(std::chrono::seconds(0)) == std::future_status::timeout);
  }
  CHECK(hasUnawaited());
  leave.set_value();
  while (hasUnawaited()) std::this_thread::yield();
  CHECK(begun);
}

TEST_CASE("what such work throws is met by who asks for its end") {
  std::future<void> done = startUnawaited([] { throw std::runtime_error("no device"); });
  CHECK_THROWS_WITH(done.get(), "no device");
  CHECK(!hasUnawaited());
}
