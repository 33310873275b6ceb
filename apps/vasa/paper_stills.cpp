#include <fmt/format.h>

#include <algorithm>

#include "core/cancellation.h"
#include "core/log.h"
#include "paper_easel.h"
#include "scene/frame.h"

// Figure 7: stills of the clips that move the body most, each at the frame that is farthest from rest.
namespace vasa::cli {
namespace {

struct Still {
  const Clip* clip;
  std::uint32_t frame = 0;
  float moved = 0;  // [m] a joint, on average, since rest; without the way over the floor
};

Still farthestFrame(const Scene& scene, const Clip& clip) {
  const Skeleton& skeleton = scene.body.skeleton;
  const Pose rest = restPose(skeleton);
  Still still{&clip};
  for (std::uint32_t frame = 0; frame < clip.frameCount(); ++frame) {
    const Pose pose = samplePose(skeleton, clip, clip.timeOfFrame(frame));
    const vec3 way = wayOverFloor(scene, pose);
    float moved = 0;
    for (std::size_t j = 0; j < pose.world.size(); ++j)
      moved += glm::distance(vec3(pose.world[j][3]) - way, vec3(rest.world[j][3]));
    moved /= float(pose.world.size());
    if (moved > still.moved) still.moved = moved, still.frame = frame;
  }
  return still;
}

// Of vessels and joints, with the flesh around them.
Aabb boundsOf(const FrameMaker& maker) {
  constexpr float kFlesh = 0.05f;  // [m]
  Aabb box;
  for (const vec4& point : maker.points()) box.add(vec3(point), kFlesh);
  for (const mat4& joint : maker.pose().world) box.add(vec3(joint[3]), kFlesh);
  return box;
}

}  // namespace

Result<PaperFigure> clipFigure(const PaperStudy& study, gpu::Device& device) {
  const Scene& scene = study.scene;
  std::vector<Still> stills;
  for (const Clip& clip : scene.body.clips) stills.push_back(farthestFrame(scene, clip));
  const std::size_t count = std::min<std::size_t>(study.quick ? 3 : 6, stills.size());
  std::ranges::stable_sort(stills, std::greater<>(), &Still::moved);
  stills.resize(count);
  PaperFigure figure{"Stills of animation clips: a deformation of blood vessels in real time.", {}, {}, {}};
  if (stills.empty()) figure.note = "This body has no clips.";

  const PictureSize size{study.pixels(330), study.pixels(460)};
  const float aspect = float(size.width) / float(size.height);
  Renderer renderer(device, scene.network, scene.body.meshes,
                    {.width = size.width,
                     .height = size.height,
                     .pixelError = kAutoPixelError,
                     .table = &study.table,
                     .supersample = study.quick ? 1u : 2u,
                     .occlusion = true,
                     .timed = false});
  ProgressLine progress("figure 7");
  for (const Still& still : stills) {
    FrameMaker maker(scene, {.avoid = true});
    for (std::uint32_t frame = 0; frame <= still.frame; ++frame) {  // so that a signal is heard between two
      checkpoint();
      maker.make(still.clip, still.clip->timeOfFrame(frame));
      progress.update(figure.panels.size() * 100 + 100 * frame / (still.frame + 1), count * 100);
    }
    const Camera camera = cameraOn(boundsOf(maker), {0.45f, 0.1f, 1}, aspect);
    renderer.draw({.points = maker.points(),
                   .knotFrames = maker.knotFrames(),
                   .jointMatrices = maker.jointMatrices(),
                   .camera = camera,
                   .look = pageLook(),
                   .heartScale = maker.heartScale()});
    figure.panels.push_back(
        {fmt::format("{}, frame {}", still.clip->name, still.frame), renderer.readBack()});
  }
  return figure;
}

}  // namespace vasa::cli
