#include "core/unawaited.h"

#include <atomic>
#include <exception>
#include <thread>
#include <utility>

namespace vasa {
namespace {

std::atomic<int> going = 0;

}  // namespace

std::future<void> startUnawaited(std::function<void()> work) {
  std::promise<void> promise;
  std::future<void> done = promise.get_future();
  ++going;
  try {
    std::thread([work = std::move(work), promise = std::move(promise)]() mutable {
      try {
        std::exchange(work, nullptr)();
        --going;
        promise.set_value();
      } catch (...) {
        --going;
        promise.set_exception(std::current_exception());
      }
    }).detach();
  } catch (...) {  // there is no thread to be had
    --going;
    throw;
  }
  return done;
}

bool hasUnawaited() { return going > 0; }

}  // namespace vasa
