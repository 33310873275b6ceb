#pragma once
#include <string_view>

namespace vasa {

enum class LogLevel { quiet, normal, verbose };

/// Everything said to a person goes to standard error; standard output is for data.
void setLogLevel(LogLevel level);
LogLevel logLevel();

void logInfo(std::string_view message);     ///< shown unless quiet
void logWarning(std::string_view message);  ///< "warning: ..." shown unless quiet
void logError(std::string_view message);    ///< "error: ..." always shown
void logDetail(std::string_view message);   ///< shown when verbose

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
