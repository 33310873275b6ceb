#include "viewer/timings.h"

#include <algorithm>

#include "render/profiler.h"

namespace vasa::viewer {

float History::median() const {
  if (count_ == 0) return 0;
  std::vector<float> sorted;
  for (std::size_t i = 0; i < count_; ++i) sorted.push_back(at(i));
  const auto middle = sorted.begin() + std::ptrdiff_t(count_ / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

void Timings::add(const char* name, double ms) {
  auto found = std::ranges::find(stages_, name, &Stage::name);
  if (found == stages_.end()) found = stages_.insert(found, {name, {}});
  found->history.add(float(ms));
}

void Timings::addShape(const FrameReport& report, double ms) {
  for (const auto& [stage, took] : shapeStages(report, true)) add(stage, took);
  shape_.add(float(ms));
}

void Timings::addPicture(const FrameTimes& times, double ms) {
  for (const auto& [stage, took] : pictureStages(times, true)) add(stage, took);
  picture_.add(float(ms));
}

void Timings::addWindow(double declare, double draw, double present) {
  add("panels_ms", declare);
  add("window_ms", draw);
  add("present_ms", present);
}

}  // namespace vasa::viewer
