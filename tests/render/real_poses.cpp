#include "real_poses.h"

#include "scene/frame.h"
#include "support/real_scene.h"

namespace vasa::test {

Result<RealPoses> realPoses(const std::filesystem::path& data, const std::vector<std::string>& clips,
                            int steps) {
  const Result<Scene> scene = realScene(data);
  if (!scene) return scene.error();
  FrameMaker maker(*scene);
  RealPoses result{scene->network, {}};
  const auto add = [&](const std::string& name, bool middle) {
    result.poses.push_back({name,
                            middle,
                            {maker.points().begin(), maker.points().end()},
                            {maker.knotFrames().begin(), maker.knotFrames().end()}});
  };
  maker.make(nullptr, 0);
  add("", true);
  for (const std::string& name : clips) {
    const Result<const Clip*> clip = findClip(scene->body, name);
    if (!clip) return clip.error();
    for (int step = 0; step <= steps; ++step) {
      maker.make(*clip, glm::mix((*clip)->start, (*clip)->end, float(step) / float(steps)));
      add(name, 2 * step == steps);
    }
  }
  return result;
}

}  // namespace vasa::test
