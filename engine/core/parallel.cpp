#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_scheduler_observer.h>

#ifdef __linux__
#include <sys/resource.h>
#endif

#include <memory>
#include <thread>

#include "core/cancellation.h"

namespace vasa {
namespace {

std::unique_ptr<tbb::global_control> limit;

void lowerPriority() {
#ifdef __linux__
  constexpr int kNice = 10;
  if (getpriority(PRIO_PROCESS, 0) < kNice) setpriority(PRIO_PROCESS, 0, kNice);  // of this thread alone
#endif
}

class WorkersGiveWay final : public tbb::task_scheduler_observer {
 public:
  WorkersGiveWay() { observe(true); }  // those of the calling thread's loops
  ~WorkersGiveWay() override { observe(false); }
  void on_scheduler_entry(bool worker) override {
    if (worker) lowerPriority();
  }
};

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

void giveWay() {
  lowerPriority();
  thread_local const WorkersGiveWay workers;
}

}  // namespace vasa
