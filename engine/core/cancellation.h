#pragma once
#include <atomic>
#include <cstdint>
#include <memory>

namespace vasa {

/// The wish that some work stops, from any thread. Copies are the same wish.
class Cancellation {
 public:
  void ask() { asked_->store(true, std::memory_order_relaxed); }
  bool asked() const { return asked_->load(std::memory_order_relaxed); }

 private:
  friend class CancellationScope;
  std::shared_ptr<std::atomic<bool>> asked_ = std::make_shared<std::atomic<bool>>(false);
};

/// What checkpoint() throws. It is no std::exception, so that readers which answer for damaged files let it
/// through.
struct Cancelled {};

/// What its thread does while it lives heeds a wish, and so does what that hands to other threads by
/// parallelFor(). Scopes nest: the innermost counts.
class CancellationScope {
 public:
  explicit CancellationScope(const Cancellation& wish) : CancellationScope(wish.asked_.get()) {}
  /// As another thread does. @param asked  what current() was there; null: nothing is heeded
  explicit CancellationScope(const std::atomic<bool>* asked);
  ~CancellationScope();
  CancellationScope(const CancellationScope&) = delete;
  CancellationScope& operator=(const CancellationScope&) = delete;

  static const std::atomic<bool>* current();

 private:
  const std::atomic<bool>* before_;
};

/// Leaves work that is no longer wanted by throwing Cancelled; nothing happens outside of a scope. For loops
/// that may take more than some hundredths of a second; what throws must leave nothing behind that others
/// see. A nanosecond.
void checkpoint();

/// checkpoint() every so many calls, for loops whose rounds are cheaper than that.
class Checkpoints {
 public:
  void pass() {
    if ((++count_ & 0xfffu) == 0) checkpoint();
  }

 private:
  std::uint32_t count_ = 0;
};

}  // namespace vasa
