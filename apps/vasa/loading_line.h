#pragma once
#include <cstring>
#include <mutex>
#include <optional>

#include "core/log.h"
#include "scene/reading.h"

namespace vasa::cli {

/// What a command does before it begins, as a line on a terminal (core/log.h): for loadScene() and what comes
/// after it.
class LoadingLine {
 public:
  void operator()(const char* what, std::size_t done = 0, std::size_t total = 0) {
    const std::lock_guard lock(mutex_);
    if (!line_ || std::strcmp(what_, what) != 0) {
      line_.reset();  // wipes the one before
      line_.emplace(what);
      what_ = what;
    }
    line_->update(done, total);
  }
  ReadingProgress told() {
    return [this](const char* what, std::size_t done, std::size_t total) { (*this)(what, done, total); };
  }

 private:
  std::mutex mutex_;
  const char* what_ = "";
  std::optional<ProgressLine> line_;
};

}  // namespace vasa::cli
