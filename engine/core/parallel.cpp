#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <thread>

#include "core/cancellation.h"

namespace vasa {
namespace {

std::unique_ptr<tbb::global_control> limit;

}  // namespace

void setThreadCount(unsigned count) {
  const unsigned threads = count ? count : std::max(1u, std::thread::hardware_concurrency());
  limit.reset();
  limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

unsigned threadCount() {
  return unsigned(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t)>& body) {
  const std::atomic<bool>* const asked = CancellationScope::current();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain ? grain : 1), [&](const auto& range) {
    const CancellationScope scope(asked);
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      checkpoint();
      body(i);
    }
  });
}

}  // namespace vasa
