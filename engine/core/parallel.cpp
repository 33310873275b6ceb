#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#ifdef __linux__
#include <sys/resource.h>
#endif

#include <memory>
#include <thread>

#include "core/cancellation.h"
#include "core/isolated.h"

#ifdef VASA_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace vasa {
namespace {

std::unique_ptr<tbb::global_control> limit;

thread_local bool wayGiven = false;  // by this thread

// ThreadSanitizer does not see how TBB, which is not built for it, hands work on: it is told here that a
// loop's rounds come after its beginning, and its end after all of them, and nothing about one round and
// another.
struct Order {
#ifdef VASA_THREAD_SANITIZER
  char begun = 0, done = 0;
  Order() { __tsan_release(&begun); }
  ~Order() { __tsan_acquire(&done); }
#endif
};
struct Round {
#ifdef VASA_THREAD_SANITIZER
  Order& order;
  explicit Round(Order& own) : order(own) { __tsan_acquire(&order.begun); }
  ~Round() { __tsan_release(&order.done); }
#else
  explicit Round(Order&) {}
#endif
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

void parallelFor(std::size_t count, std::size_t grain, FunctionRef<void(std::size_t)> body) {
  const std::atomic<bool>* const asked = CancellationScope::current();
  const bool behindOthers = wayGiven;
  tbb::task_group_context context;
  Order order;
  const auto rounds = [&](const auto& range) {
    const Round round(order);
    const CancellationScope scope(asked);
    if (behindOthers) giveWay();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      checkpoint();
      body(i);
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain ? grain : 1), rounds, context);
  // A loop around this one that failed on another thread ends this one early, without a word.
  if (context.is_group_execution_cancelled()) throw Cancelled();
}

void isolated(FunctionRef<void()> work) { tbb::this_task_arena::isolate(work); }

void giveWay() {
  if (wayGiven) return;
  wayGiven = true;
#ifdef __linux__
  constexpr int kNice = 10;
  if (getpriority(PRIO_PROCESS, 0) < kNice) setpriority(PRIO_PROCESS, 0, kNice);  // of this thread alone
#endif
}

}  // namespace vasa
