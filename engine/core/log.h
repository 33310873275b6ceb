#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace vasa {

enum class LogLevel { quiet, normal, verbose };

/// Everything said to a person goes to standard error; standard output is for data.
void setLogLevel(LogLevel level);
LogLevel logLevel();

void logInfo(std::string_view message);     ///< shown unless quiet
void logWarning(std::string_view message);  ///< "warning: ..." shown unless quiet
void logError(std::string_view message);    ///< "error: ..." always shown
void logDetail(std::string_view message);   ///< shown when verbose

/// Keeps back what logWarning() is told on this thread while it lives; it is said at the end, unless it was
/// dropped. For what may be done again: a file that is read a second time, in another unit.
class HeldWarnings {
 public:
  HeldWarnings();
  ~HeldWarnings();
  HeldWarnings(const HeldWarnings&) = delete;
  HeldWarnings& operator=(const HeldWarnings&) = delete;
  void drop() { warnings_.clear(); }

 private:
  friend void logWarning(std::string_view message);
  HeldWarnings* outer_;
  std::vector<std::string> warnings_;
};

/// One line on a terminal that is overwritten as work goes on ("converting 120/1031"); silent when
/// standard error is no terminal or the level is quiet. Safe to call from several threads.
class ProgressLine {
 public:
  explicit ProgressLine(std::string_view title);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void update(std::size_t done, std::size_t total);

 private:
  struct State;
  State* state_;
};

}  // namespace vasa
