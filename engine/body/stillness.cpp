#include "body/stillness.h"

#include <algorithm>

#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr std::size_t kStillSamples = 200;
constexpr std::uint32_t kFrames = 8;  // of a clip
constexpr float kGoesHeights = 0.05f;
constexpr float kStaysShare = 0.1f;
constexpr float kAboutAsNear = 2, kBlurHeights = 0.02f;

// The links about as near to a place as the nearest one: which of them it goes with is not judged here.
std::vector<JointId> nearLinks(const SpineSet& spines, vec3 p, float blur) {
  std::vector<std::pair<float, JointId>> all;
  float least = 1e30f;
  for (const SpineJoint& joint : spines.joints) {
    if (!joint.parent.valid()) continue;
    const vec3 from = spines.joints[joint.parent.value].centre;
    const float distance =
        glm::distance(p, glm::mix(from, joint.centre, closestOnSegment(p, from, joint.centre)));
    all.emplace_back(distance, joint.parent);
    least = std::min(least, distance);
  }
  std::vector<JointId> near;
  for (const auto& [distance, link] : all)
    if (distance <= kAboutAsNear * least + blur) near.push_back(link);
  return near;
}

}  // namespace

float shareLeftBehind(const Body& body, const Binding& binding, std::span<const vec4> points) {
  const std::size_t count = std::min(points.size(), kStillSamples);
  if (count == 0 || body.clips.empty()) return 0;
  const float height = body.height();
  const std::vector<Station> stations = mainStations(binding);
  std::vector<std::size_t> samples;
  std::vector<std::vector<JointId>> links;
  for (std::size_t i = 0; i < count; ++i) {
    samples.push_back(i * points.size() / count);
    links.push_back(nearLinks(binding.spines, vec3(points[samples.back()]), kBlurHeights * height));
  }
  const float goes = kGoesHeights * height;
  std::vector<bool> behind(count);
  SpinePose spine(binding.spines);
  for (const Clip& clip : body.clips)
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      const float time = glm::mix(clip.start, clip.end, float(frame) / float(kFrames - 1));
      spine.run(binding.spines, samplePose(body.skeleton, clip, time));
      for (std::size_t i = 0; i < count; ++i) {
        if (links[i].empty()) continue;
        const vec3 p(points[samples[i]]);
        float linkWay = 1e30f;  // of the one that moves least
        for (const JointId link : links[i])
          linkWay = std::min(linkWay, glm::distance(spine.placeAfter(link, p), p));
        const float own = glm::distance(spine.place(stations[samples[i]], p), p);
        if (linkWay > goes && own < kStaysShare * linkWay) behind[i] = true;
      }
    }
  return float(std::ranges::count(behind, true)) / float(count);
}

}  // namespace vasa
