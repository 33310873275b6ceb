#include <algorithm>
#include <array>
#include <map>

#include "body/binding.h"
#include "body/deform.h"
#include "body/skinning.h"
#include "core/atomic_file.h"
#include "core/parallel.h"
#include "human/made_human.h"
#include "io/gltf.h"
#include "make_human/bones.h"
#include "make_human/glb.h"
#include "make_human/solid.h"

using namespace vasa;
using namespace vasa::human;

namespace {

constexpr float kAllowed = 0.002f;

const Body& savedBody() {
  static const Result<Body> body = [] {
    const auto path = std::filesystem::temp_directory_path() / "vasa_made_human_moving.glb";
    REQUIRE(writeFileAtomically(path, writeGlb(madeHuman().rig, madeHuman().meshes, madeHuman().clips)).ok());
    Result<Body> read = readBody(path);
    std::filesystem::remove(path);
    return read;
  }();
  if (!body.ok()) FAIL(body.error().message);
  return *body;
}

/// Places along all vessels, every half span.
std::vector<vec4> samplesOf(const Network& network, std::span<const vec4> points, std::vector<int>* owners) {
  std::vector<vec4> samples;
  for (std::size_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    for (std::uint32_t k = 0; k <= 2 * vessel.spanCount(); ++k) {
      samples.push_back(evaluate(Network::pointsOf(vessel, points), 0.5f * float(k)));
      if (owners) owners->push_back(int(v));
    }
  }
  return samples;
}

struct Worst {
  float depth = 0;
  std::size_t frame = 0;
};

}  // namespace

TEST_CASE("no motion brings a vessel's middle out of the skin by more than 2 mm") {
  const Body& body = savedBody();
  const Network& network = madeHuman().vessels;
  const Result<Binding> binding = bind(body, network, "human.vasa");
  if (!binding.ok()) FAIL(binding.error().message);
  MESSAGE(network.sweepCount() << " sweeps, " << network.vessels().size() << " vessels, binding "
                               << binding->bytes() << " bytes");
  Deformer deformer(*binding);
  std::vector<vec4> posed(network.points().size());
  for (const Clip& clip : body.clips) {
    std::map<int, Worst> outside;
    for (std::size_t frame = 0; frame < clip.frameCount(); frame += kFrameStep) {
      const Pose pose = samplePose(body.skeleton, clip, float(frame) / clip.framesPerSecond);
      deformer.run(network, pose, posed);
      SkinnedMesh skin = body.meshes[0];
      skinVertices(body.meshes[0], skinMatrices(body.skeleton, pose), skin.mesh.positions, skin.normals);
      const Solid solid(skin.mesh);
      std::vector<int> owners;
      const std::vector<vec4> samples = samplesOf(network, posed, &owners);
      std::vector<float> beyond(samples.size(), 0);
      parallelFor(samples.size(), 64, [&](std::size_t i) {
        const vec3 p(samples[i]);  // nearly all are inside, where the way to the skin says nothing
        if (solid.winding(p) > 0) return;
        if (const auto place = solid.at(p, 0.1f)) beyond[i] = place->distance;
      });
      for (std::size_t i = 0; i < samples.size(); ++i)
        if (beyond[i] > kAllowed && beyond[i] > outside[owners[i]].depth)
          outside[owners[i]] = {beyond[i], frame};
    }
    CAPTURE(clip.name);
    for (const auto& [vessel, worst] : outside)
      MESSAGE(clip.name << ": " << network.vessels()[std::size_t(vessel)].name << " " << 1e3f * worst.depth
                        << " mm in frame " << worst.frame);
    CHECK(outside.empty());
  }
}

TEST_CASE("at rest no vessel is in bone, and only the great ones' origins in the heart") {
  const Network& network = madeHuman().vessels;
  std::vector<int> owners;
  const std::vector<vec4> samples = samplesOf(network, network.points(), &owners);
  const auto& meshes = madeHuman().meshes;
  const SkinnedMesh skeleton = united(std::array{meshes[1], meshes[3], meshes[4]});
  const Solid bones(skeleton.mesh), heart(meshes[2].mesh);
  std::map<int, float> inBone, inHeart;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const float radius = samples[i].w;
    if (const auto place = bones.at(vec3(samples[i]), radius))
      inBone[owners[i]] = std::max(inBone[owners[i]], radius - place->distance);
    if (const auto place = heart.at(vec3(samples[i]), radius))
      inHeart[owners[i]] = std::max(inHeart[owners[i]], radius - place->distance);
  }
  for (const auto& [vessel, depth] : inBone)
    if (depth > 0.5e-3f)
      MESSAGE("bone: " << network.vessels()[std::size_t(vessel)].name << " " << 1e3f * depth << " mm");
  for (const auto& [vessel, depth] : inHeart)
    if (depth > 0.5e-3f)
      MESSAGE("heart: " << network.vessels()[std::size_t(vessel)].name << " " << 1e3f * depth << " mm");
  CHECK(std::none_of(inBone.begin(), inBone.end(), [](const auto& o) { return o.second > 1.1e-3f; }));
}
