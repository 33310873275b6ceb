#include "make_human/extreme_poses.h"

#include <algorithm>
#include <cmath>

namespace vasa::human {
namespace {

constexpr std::uint32_t kFrameStep = 3;

/// How much two poses differ: the turns of all joints between them, in terms of the chord.
float difference(const Pose& a, const Pose& b) {
  float total = 0;
  for (std::size_t i = 1; i < a.world.size(); ++i) {
    const mat3 da = glm::transpose(mat3(a.world[0])) * mat3(a.world[i]);
    const mat3 db = glm::transpose(mat3(b.world[0])) * mat3(b.world[i]);
    float sum = 0;
    for (int k = 0; k < 3; ++k) sum += glm::dot(da[k] - db[k], da[k] - db[k]);
    total += std::sqrt(sum);
  }
  return total;
}

}  // namespace

std::vector<Pose> extremePoses(const Body& body, int posesPerClip) {
  std::vector<Pose> chosen;
  const Pose rest = restPose(body.skeleton);
  for (const Clip& clip : body.clips) {
    std::vector<Pose> all;
    std::vector<float> distance;
    for (std::uint32_t frame = 0; frame < clip.frameCount(); frame += kFrameStep) {
      all.push_back(samplePose(body.skeleton, clip, clip.timeOfFrame(frame)));
      distance.push_back(difference(all.back(), rest));
    }
    for (int k = 0; k < posesPerClip; ++k) {
      const std::size_t next =
          std::size_t(std::max_element(distance.begin(), distance.end()) - distance.begin());
      chosen.push_back(all[next]);
      for (std::size_t i = 0; i < all.size(); ++i)
        distance[i] = std::min(distance[i], difference(all[i], all[next]));
    }
  }
  return chosen;
}

}  // namespace vasa::human
