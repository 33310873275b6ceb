#include "core/log.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <utility>

#include "core/visible.h"

namespace vasa {
namespace {

std::atomic<LogLevel> level{LogLevel::normal};
std::mutex outputMutex;
thread_local HeldWarnings* holder = nullptr;  // the innermost

bool colourful() {
  static const bool yes = isatty(STDERR_FILENO) && !std::getenv("NO_COLOR");
  return yes;
}

void write(const char* colour, std::string_view label, std::string_view message) {
  const std::lock_guard lock(outputMutex);
  const bool paint = colourful() && *colour;
  // Names of files, and of what is in them, are others' words.
  const std::string text = visibleLines(message);
  std::fprintf(stderr, "%s%.*s%s%s\n", paint ? colour : "", int(label.size()), label.data(),
               paint ? "\x1b[0m" : "", text.c_str());
}

}  // namespace

void setLogLevel(LogLevel value) { level = value; }
LogLevel logLevel() { return level; }

void logInfo(std::string_view message) {
  if (level != LogLevel::quiet) write("", "", message);
}
void logWarning(std::string_view message) {
  if (holder) return holder->warnings_.emplace_back(message), void();
  if (level != LogLevel::quiet) write("\x1b[33m", "warning: ", message);
}
void logError(std::string_view message) { write("\x1b[31m", "error: ", message); }
void logDetail(std::string_view message) {
  if (level == LogLevel::verbose) write("", "", message);
}

HeldWarnings::HeldWarnings() : outer_(std::exchange(holder, this)) {}
HeldWarnings::~HeldWarnings() {
  holder = outer_;
  for (const std::string& warning : warnings_) logWarning(warning);
}

struct ProgressLine::State {
  std::string title;
  std::chrono::steady_clock::time_point last{};
  bool shown = false;
};

ProgressLine::ProgressLine(std::string_view title)
    : state_(isatty(STDERR_FILENO) && level != LogLevel::quiet ? new State{std::string(title)} : nullptr) {}

ProgressLine::~ProgressLine() {
  if (state_ && state_->shown) {
    const std::lock_guard lock(outputMutex);
    std::fputs("\r\x1b[K", stderr);
  }
  delete state_;
}

void ProgressLine::update(std::size_t done, std::size_t total) {
  if (!state_) return;
  const std::lock_guard lock(outputMutex);
  const auto now = std::chrono::steady_clock::now();
  if (state_->shown && done != total && now - state_->last < std::chrono::milliseconds(50)) return;
  state_->last = now;
  state_->shown = true;
  std::fprintf(stderr, "\r\x1b[K%s", state_->title.c_str());
  if (total > 0) std::fprintf(stderr, " %zu/%zu", done, total);
  std::fflush(stderr);
}

}  // namespace vasa
