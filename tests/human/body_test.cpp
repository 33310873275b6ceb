#include <algorithm>
#include <cmath>
#include <map>

#include "core/atomic_file.h"
#include "human/made_human.h"
#include "io/gltf.h"
#include "make_human/glb.h"
#include "network/file.h"

using namespace vasa;
using namespace vasa::human;

namespace {

/// How many times each directed edge occurs.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directedEdges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  return edges;
}

void checkClosed(const SkinnedMesh& mesh) {
  CAPTURE(mesh.name);
  int wrong = 0;
  const auto edges = directedEdges(mesh.mesh);
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    wrong += count != 1 || back == edges.end();
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("the built-in human is made twice with the same bytes") {
  const std::vector<std::byte> body = writeGlb(madeHuman().rig, madeHuman().meshes, madeHuman().clips),
                               vessels = encodeNetwork(madeHuman().vessels, {.quantise = true});
#ifdef VASA_HUMAN_DATA  // where this build made it, too
  const std::filesystem::path data = VASA_HUMAN_DATA;
  const auto builtBody = readFile(data / "human.glb"), builtVessels = readFile(data / "human.vasa");
  REQUIRE(builtBody.ok());
  REQUIRE(builtVessels.ok());
  CHECK(*builtBody == body);
  CHECK(*builtVessels == vessels);
#else
  const Result<Human> again = makeHuman(VASA_HUMAN_TABLES);
  REQUIRE(again.ok());
  CHECK(writeGlb(again->rig, again->meshes, again->clips) == body);
  CHECK(encodeNetwork(again->vessels, {.quantise = true}) == vessels);
#endif
}

TEST_CASE("skin, bones, heart, organs, cartilage and teeth are closed and face outwards") {
  REQUIRE(madeHuman().meshes.size() > 6);
  CHECK(madeHuman().meshes[0].name == "skin");
  CHECK(madeHuman().meshes[1].name == "bones");
  CHECK(madeHuman().meshes[2].name == "keep-out: heart");
  CHECK(madeHuman().meshes[3].name == "cartilage");
  CHECK(madeHuman().meshes[4].name == "teeth");
  for (std::size_t m = 5; m < madeHuman().meshes.size(); ++m)
    CHECK(madeHuman().meshes[m].name.starts_with("organ: "));
  for (const SkinnedMesh& mesh : madeHuman().meshes) {
    checkClosed(mesh);
    CHECK(mesh.mesh.volume() > 0);
  }
}

TEST_CASE("the skin is that of an adult of 1.75 m standing on the floor") {
  const TriangleMesh& skin = madeHuman().meshes[0].mesh;
  const Aabb box = skin.bounds();
  CHECK(box.low.y == doctest::Approx(0).epsilon(0.004));
  CHECK(box.high.y == doctest::Approx(1.75).epsilon(0.01));
  CHECK(skin.volume() > 0.055);  // 70 kg, about 0.068 m³
  CHECK(skin.volume() < 0.080);
  CHECK(skin.triangles.size() <= 60000);
}

TEST_CASE("weights are of at most four joints and sum to one") {
  for (const SkinnedMesh& mesh : madeHuman().meshes) {
    CAPTURE(mesh.name);
    REQUIRE(mesh.influences.size() == mesh.mesh.positions.size());
    REQUIRE(mesh.normals.size() == mesh.mesh.positions.size());
    bool sums = true, joints = true, normals = true;
    for (const SkinInfluence& influence : mesh.influences) {
      const vec4 w = influence.weights;
      sums &= std::abs(w.x + w.y + w.z + w.w - 1) < 1e-6f && glm::all(glm::greaterThanEqual(w, vec4(0)));
      for (std::uint16_t joint : influence.joints) joints &= joint < madeHuman().rig.joints.size();
    }
    for (vec3 n : mesh.normals) normals &= std::abs(glm::length(n) - 1) < 1e-4f;
    CHECK(sums);
    CHECK(joints);
    CHECK(normals);
  }
}

TEST_CASE("a bone's vertex moves with one joint, and the heart's") {
  for (std::size_t m = 1; m < madeHuman().meshes.size(); ++m) {
    const std::string& name = madeHuman().meshes[m].name;
    if (name.starts_with("organ: ") && name != "organ: heart") continue;
    bool single = true;
    for (const SkinInfluence& influence : madeHuman().meshes[m].influences)
      single &= influence.weights == vec4(1, 0, 0, 0);
    CHECK(single);
  }
}

TEST_CASE("the motions are there, thirty frames a second, unit rotations") {
  std::vector<std::string> names;
  for (const Clip& clip : madeHuman().clips) {
    CAPTURE(clip.name);
    names.push_back(clip.name);
    CHECK(clip.framesPerSecond == 30);
    bool units = true, steps = true;
    for (const JointTracks& track : clip.tracks) {
      for (const quat& q : track.rotation.values) units &= std::abs(glm::length(q) - 1) < 1e-5f;
      for (std::size_t i = 1; i < track.rotation.times.size(); ++i)
        steps &= std::abs(track.rotation.times[i] - track.rotation.times[i - 1] - 1.0f / 30) < 1e-5f;
    }
    CHECK(units);
    CHECK(steps);
  }
  for (const char* name : {"stand", "walk", "run", "squat", "wave", "elbow_flex", "fist", "neck_turn",
                           "twist", "arms_overhead", "dance"})
    CHECK(std::count(names.begin(), names.end(), name) == 1);
}

TEST_CASE("a looping motion ends where it began") {
  for (const Clip& clip : madeHuman().clips) {
    CAPTURE(clip.name);
    float gap = 0;
    for (const JointTracks& track : clip.tracks)
      gap = std::max(gap, glm::length(track.rotation.values.front() - track.rotation.values.back()));
    CHECK(gap < 1e-3f);
  }
}

TEST_CASE("the reader of glTF takes the body whole") {
  const auto path = std::filesystem::temp_directory_path() / "vasa_made_human.glb";
  const std::vector<std::byte> bytes = writeGlb(madeHuman().rig, madeHuman().meshes, madeHuman().clips);
  REQUIRE(writeFileAtomically(path, bytes).ok());
  const Result<Body> read = readBody(path);
  std::filesystem::remove(path);
  if (!read.ok()) FAIL(read.error().message);
  CHECK(read->skeleton.joints.size() == madeHuman().rig.joints.size());
  REQUIRE(read->meshes.size() == madeHuman().meshes.size());
  CHECK(read->meshes[0].mesh.triangles.size() == madeHuman().meshes[0].mesh.triangles.size());
  CHECK(read->meshes[0].colour.a < 1);
  REQUIRE(read->clips.size() == madeHuman().clips.size());
  for (std::size_t i = 0; i < read->clips.size(); ++i) {
    CHECK(read->clips[i].name == madeHuman().clips[i].name);
    CHECK(read->clips[i].frameCount() == madeHuman().clips[i].tracks[0].rotation.times.size());
  }
}

TEST_CASE("no motion lifts or sinks the standing body off the floor") {
  for (const Clip& clip : madeHuman().clips) {
    if (clip.name == "run") continue;  // which has a flight
    CAPTURE(clip.name);
    const std::vector<vec3>& root = clip.tracks[0].translation.values;
    const float rest = madeHuman().rig.points[0].position.y;
    float highest = 0;
    for (vec3 p : root) highest = std::max(highest, p.y - rest);
    CHECK(highest < 0.05f);
  }
}

TEST_CASE("a fault in a table is named with its file and line") {
  const auto folder = std::filesystem::temp_directory_path() / "vasa_human_faulty";
  std::filesystem::remove_all(folder);
  std::filesystem::copy(VASA_HUMAN_TABLES, folder);
  REQUIRE(
      writeFileAtomically(folder / "joints.csv",
                          std::string("kind,name,parent,x_mm,y_mm,z_mm,towards,bend_towards,skin_blend_mm\n"
                                      "joint,Hips,,0,abc,0,Top,0 0 1,40\n"))
          .ok());
  const Result<Human> made = makeHuman(folder);
  std::filesystem::remove_all(folder);
  REQUIRE_FALSE(made.ok());
  CHECK(made.error().fault == Fault::badInput);
  CHECK(made.error().message == "joints.csv:2: 'abc' is not a number");
}
