#include "viewer/timings.h"

#include <algorithm>

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
  add("pose_ms", report.poseMs);
  add("deform_ms", report.deformMs);
  add("kinks_ms", report.kinksMs);
  add("volume_ms", report.volumeMs);
  add("detect_ms", report.avoid.detectMs);
  add("obstacles_ms", report.avoid.boneMs);
  add("avoid_ms", report.avoid.solveMs);
  add("certify_ms", report.avoid.certifyMs);
  add("knot_frames_ms", report.framesMs);
  shape_.add(float(ms));
}

void Timings::addPicture(const FrameTimes& times, double ms) {
  add("upload_ms", times.upload);
  add("tessellate_ms", times.tessellate);
  add("forks_ms", times.forks);
  add("draw_ms", times.draw);
  add("capillaries_ms", times.capillaries);
  add("meshes_ms", times.meshes);
  picture_.add(float(ms));
}

}  // namespace vasa::viewer
