#pragma once
#include <chrono>

namespace vasa {

using Clock = std::chrono::steady_clock;

inline double msSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Adds the time from when it was made until it goes to a sum [ms].
class StageClock {
 public:
  explicit StageClock(double& sum) : sum_(sum) {}
  ~StageClock() { sum_ += msSince(start_); }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

 private:
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace vasa
