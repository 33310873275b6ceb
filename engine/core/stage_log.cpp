#include "core/stage_log.h"

#include <array>
#include <cstdio>

#include "core/log.h"

namespace vasa {

void StageLog::next(std::string what) {
  end();
  what_ = std::move(what);
  start_ = Clock::now();
}

void StageLog::end() {
  if (what_.empty()) return;
  if (logLevel() == LogLevel::verbose) {
    std::array<char, 32> ms{};
    std::snprintf(ms.data(), ms.size(), "%7.1f ms  ", msSince(start_));
    logDetail(ms.data() + what_);
  }
  what_.clear();
}

}  // namespace vasa
