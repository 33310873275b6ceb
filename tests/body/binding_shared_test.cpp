#include <doctest/doctest.h>

#include "body/binding.h"
#include "body/deform.h"
#include "io/gltf.h"
#include "support/shared_data.h"

namespace {

using namespace vasa;

/// Every so many-th vertex of the vessels of the real body.
std::vector<vec4> someVesselPoints(const std::filesystem::path& data) {
  std::vector<vec4> points;
  for (const char* file : {"bp3d/bp3d_arteries.glb", "bp3d/bp3d_veins.glb"}) {
    const Result<std::vector<MeshElement>> elements = readGltfElements(data / file);
    REQUIRE(elements);
    for (const MeshElement& element : *elements)
      for (std::size_t i = 0; i < element.mesh.positions.size(); i += 150)
        points.emplace_back(element.mesh.positions[i], 0.001f);
  }
  return points;
}

/// Largest step of the body's rigidly moved vertices and of the points between frames of a clip.
struct Steps {
  float bones = 0, points = 0;
};

Steps stepsOf(const Body& body, const Clip& clip, const Binding& binding, const std::vector<vec4>& rest) {
  Deformer deformer(binding);
  std::vector<vec4> now(rest.size()), before;
  std::vector<vec3> boneNow, boneBefore;
  Steps steps;
  for (std::uint32_t f = 0; f < clip.frameCount(); ++f) {
    const Pose pose = samplePose(body.skeleton, clip, clip.timeOfFrame(f));
    deformer.run(rest, pose, now);
    boneNow.clear();
    for (const SkinnedMesh& mesh : body.meshes)
      for (std::size_t v = 0; v < mesh.influences.size(); v += 20) {
        const std::uint16_t joint = mesh.influences[v].joints[0];
        if (mesh.influences[v].weights[0] < 0.99f) continue;
        boneNow.emplace_back(pose.world[joint] * body.skeleton.joints[joint].inverseBind *
                             vec4(mesh.mesh.positions[v], 1));
      }
    for (std::size_t i = 0; i < before.size(); ++i)
      steps.points = std::max(steps.points, glm::distance(vec3(now[i]), vec3(before[i])));
    for (std::size_t i = 0; i < boneBefore.size(); ++i)
      steps.bones = std::max(steps.bones, glm::distance(boneNow[i], boneBefore[i]));
    before = now;
    boneBefore = boneNow;
  }
  return steps;
}

}  // namespace

TEST_CASE("real vessels follow the real body without jumps") {
  VASA_REQUIRE_SHARED_DATA(data);
  const Result<Body> body = readBody(data / "bp3d/bp3d_body.glb");
  REQUIRE(body);
  const std::vector<vec4> rest = someVesselPoints(data);
  const Result<Binding> binding = bindPoints(*body, rest, "bp3d");
  REQUIRE(binding);
  CHECK(binding->bytes() <= 16 * rest.size());

  std::vector<vec4> out(rest.size());
  Deformer(*binding).run(rest, restPose(body->skeleton), out);
  float worst = 0;
  for (std::size_t i = 0; i < rest.size(); ++i)
    worst = std::max(worst, glm::distance(vec3(rest[i]), vec3(out[i])));
  CHECK(worst < 1e-6f);

  for (const Clip& clip : body->clips) {
    if (clip.name != "elbow_flex" && clip.name != "knee_squat" && clip.name != "fist") continue;
    const Steps steps = stepsOf(*body, clip, *binding, rest);
    CAPTURE(clip.name);
    CHECK(steps.points <= 1.05f * steps.bones);
  }
}

TEST_CASE("real vessels are refused by another real body") {
  VASA_REQUIRE_SHARED_DATA(data);
  const Result<Body> body = readBody(data / "rigs/makehuman_male_cmu31.glb");
  REQUIRE(body);
  const Result<Binding> binding = bindPoints(*body, someVesselPoints(data), "bp3d.vasa");
  REQUIRE_FALSE(binding);
  CHECK(binding.error().fault == Fault::badInput);
  CHECK(binding.error().message.find("% of them lie outside its skin at rest") != std::string::npos);
  CHECK(binding.error().message.find("makehuman_male_cmu31.glb") != std::string::npos);
}
