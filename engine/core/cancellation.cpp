#include "core/cancellation.h"

// Which wish counts belongs to the thread rather than to each signature on the way: work is cancelled from
// outside, by whoever waits for it, and no result depends on it.
namespace vasa {
namespace {

thread_local const std::atomic<bool>* heeded = nullptr;

}  // namespace

CancellationScope::CancellationScope(const std::atomic<bool>* asked) : before_(heeded) { heeded = asked; }

CancellationScope::~CancellationScope() { heeded = before_; }

const std::atomic<bool>* CancellationScope::current() { return heeded; }

void checkpoint() {
  if (heeded && heeded->load(std::memory_order_relaxed)) throw Cancelled{};
}

}  // namespace vasa
