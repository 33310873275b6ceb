#include "make_human/motion_probe.h"

#include <algorithm>
#include <cmath>

#include "body/binding.h"
#include "body/deform.h"
#include "body/skinning.h"
#include "core/parallel.h"
#include "make_human/extreme_poses.h"
#include "make_human/solid.h"

namespace vasa::human {
namespace {

constexpr int kPosesPerClip = 5;

}  // namespace

std::vector<MotionProbe::Place> MotionProbe::halfSpans(const Network& network) {
  std::vector<Place> places;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const std::uint32_t steps = 2 * network.vessels()[v].spanCount();
    for (std::uint32_t k = 0; k <= steps; ++k) places.push_back({v, float(k) / float(steps)});
  }
  return places;
}

Body bodyOf(const Rig& rig, std::vector<SkinnedMesh> meshes, std::vector<Clip> clips) {
  Body body;
  body.name = "human.glb";
  for (int point : rig.joints) {
    const RigPoint& from = rig.points[std::size_t(point)];
    Skeleton::Joint joint;
    joint.name = from.name;
    joint.rest.translation = from.position;
    if (from.parent >= 0) {
      joint.parent = JointId{std::uint32_t(rig.points[std::size_t(from.parent)].joint)};
      joint.rest.translation -= rig.points[std::size_t(from.parent)].position;
    }
    joint.restWorld[3] = vec4(from.position, 1);
    joint.inverseBind[3] = vec4(-from.position, 1);
    body.skeleton.joints.push_back(joint);
  }
  body.meshes = std::move(meshes);
  body.clips = std::move(clips);
  return body;
}

MotionProbe::MotionProbe(Body body) : body_(std::move(body)), poses_(extremePoses(body_, kPosesPerClip)) {}

template <class Visit>
Result<void> MotionProbe::visitPoses(const Network& network, std::span<const Place> places, std::size_t mesh,
                                     Visit visit) const {
  const Result<Binding> binding = bind(body_, network, "human.vasa");
  if (!binding.ok()) return binding.error();
  Deformer deformer(*binding);
  std::vector<vec4> posed(network.points().size());
  for (const Pose& pose : poses_) {
    deformer.run(network, pose, posed);
    TriangleMesh surface;
    surface.triangles = body_.meshes[mesh].mesh.triangles;
    skinPositions(body_.meshes[mesh], skinMatrices(body_.skeleton, pose), surface.positions);
    const Solid solid(surface);
    parallelFor(places.size(), 256, [&](std::size_t i) {
      const Vessel& vessel = network.vessels()[places[i].vessel];
      const vec3 p(evaluate(Network::pointsOf(vessel, posed), places[i].share * float(vessel.spanCount())));
      visit(i, p, solid, surface.positions);
    });
  }
  return {};
}

Result<std::vector<Escape>> MotionProbe::escapes(const Network& network) const {
  const std::vector<Place> places = halfSpans(network);
  std::vector<float> excess(places.size(), 0.0f);
  const auto visit = [&](std::size_t i, vec3 p, const Solid& skin, std::span<const vec3> corners) {
    if (skin.winding(p) > 0) return;
    float nearest = 1;  // few places get here: no tree is built for them
    for (vec3 q : corners) nearest = std::min(nearest, glm::dot(p - q, p - q));
    excess[i] = std::max(excess[i], std::sqrt(nearest));
  };
  if (const Result<void> visited = visitPoses(network, places, 0, visit); !visited.ok())
    return visited.error();
  std::vector<Escape> escapes;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (excess[i] > 0) escapes.push_back({places[i].vessel, places[i].share, excess[i]});
  return escapes;
}

Result<std::vector<VesselId>> MotionProbe::throughBones(const Network& network, float depth) const {
  const std::vector<Place> places = halfSpans(network);
  std::vector<char> deep(places.size(), 0);
  const auto visit = [&](std::size_t i, vec3 p, const Solid& bones, std::span<const vec3>) {
    if (!deep[i]) deep[i] = bones.isDeep(p, depth);  // few places are inside: no tree is built for them
  };
  if (const Result<void> visited = visitPoses(network, places, 1, visit); !visited.ok())
    return visited.error();
  std::vector<VesselId> vessels;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (deep[i] && (vessels.empty() || vessels.back().value != places[i].vessel))
      vessels.push_back({places[i].vessel});
  return vessels;
}

}  // namespace vasa::human
