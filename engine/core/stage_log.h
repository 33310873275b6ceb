#pragma once
#include <string>

#include "core/clock.h"

namespace vasa {

/// Tells, where the log is verbose (core/log.h), how long the stages of something took: one after the other,
/// each until the next one begins or this goes. Several can run beside one another, each on its own thread.
class StageLog {
 public:
  StageLog() = default;
  explicit StageLog(std::string what) { next(std::move(what)); }
  ~StageLog() { end(); }
  StageLog(const StageLog&) = delete;
  StageLog& operator=(const StageLog&) = delete;

  void next(std::string what);
  void end();

 private:
  std::string what_;  // empty: none
  Clock::time_point start_;
};

}  // namespace vasa
