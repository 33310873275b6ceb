#include "fuzz/growth.h"

#include <algorithm>

#include "core/log.h"
#include "fuzz/processor_time.h"
#include "io/read_limits.h"
#include "support/live_memory.h"

namespace vasa::test {
namespace {

/// The least of three runs: what else the machine does only adds. @param read  gives the message of a refusal
double secondsFor(const std::string& file, const std::function<std::string(const std::string&)>& read,
                  std::string& refusal) {
  double least = 1e9;
  for (int run = 0; run < 3; ++run) {
    const double before = processorSeconds();
    refusal = read(file);
    least = std::min(least, processorSeconds() - before);
  }
  return least;
}

}  // namespace

std::string times(std::size_t n, const std::function<std::string(std::size_t)>& part) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += part(i);
  return text;
}
std::string times(std::size_t n, const std::string& part) {
  return times(n, [&](std::size_t) { return part; });
}

void checkGrowth(const std::vector<Shape>& shapes,
                 const std::function<std::string(const std::string&)>& read) {
  const LogLevel level = logLevel();
  setLogLevel(LogLevel::quiet);
  for (const Shape& shape : shapes) {
    CAPTURE(std::string(shape.name));
    double seconds[3];
    std::string told;
    for (int k = 0; k < 3; ++k) {
      const std::string file = shape.make(shape.n << k);
      const std::size_t before = restartPeak();
      std::string refusal;
      seconds[k] = secondsFor(file, read, refusal);
      const std::size_t memory = peakMemory() - before;
      CAPTURE(file.size());
      CAPTURE(memory);
      if (countsMemory()) CHECK(memory <= kMemoryTimes * file.size() + kMemoryFree);
      told += "  " + of(file.size() / 1000) + " kB " + of(std::size_t(seconds[k] * 1e6)) + " us " +
              of(memory / 1000) + " kB" + (refusal.empty() ? "" : " refused");
      if (k == 2 && !refusal.empty()) told += ": " + refusal.substr(0, 160);
    }
    MESSAGE(std::string(shape.name) << told);
    // In proportion it is four times as long, in the square sixteen times. The tenth of a second is for what
    // the system does.
    CHECK(seconds[2] < 8 * seconds[0] + 0.1);
  }
  setLogLevel(level);
}

}  // namespace vasa::test
