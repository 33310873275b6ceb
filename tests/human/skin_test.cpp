#include <algorithm>
#include <cmath>

#include "body/skinning.h"
#include "core/atomic_file.h"
#include "human/made_human.h"
#include "make_human/clips.h"
#include "make_human/motion_probe.h"
#include "make_human/skin_fit.h"
#include "make_human/skin_sheet.h"
#include "make_human/weight_fit.h"

using namespace vasa;
using namespace vasa::human;

namespace {

/// A closed box of 4 x 4 x 4 patches a side, [-1, 1] each way.
TriangleMesh box() {
  constexpr int kSteps = 4;
  TriangleMesh mesh;
  const auto corner = [&](vec3 p) {
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i)
      if (glm::distance(mesh.positions[i], p) < 1e-4f) return i;
    mesh.positions.push_back(p);
    return std::uint32_t(mesh.positions.size() - 1);
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f})
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const auto at = [&](int a, int b) {
            vec3 p;
            p[axis] = side;
            p[(axis + 1) % 3] = -1 + 2 * float(a) / kSteps;
            p[(axis + 2) % 3] = -1 + 2 * float(b) / kSteps;
            return corner(p);
          };
          std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (side < 0) std::swap(b, d);
          mesh.triangles.emplace_back(a, b, c);
          mesh.triangles.emplace_back(a, c, d);
        }
  return mesh;
}

}  // namespace

TEST_CASE("weights go to where the form is least, and never below zero") {
  // One vertex that two joints take to 0 and 1, wanted at 0.25 and beyond either end.
  for (const float wanted : {0.25f, -2.0f, 3.0f}) {
    CAPTURE(wanted);
    SoughtWeights weights;
    weights.count = 2;
    weights.weights = {0.5f, 0.5f};
    WeightQuadric quadric;
    const float moves[2] = {0 - wanted, 1 - wanted};
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < 2; ++k) quadric.a[j][k] = moves[j] * moves[k];
    lower(quadric, weights);
    CHECK(weights.weights[1] == doctest::Approx(std::clamp(wanted, 0.0f, 1.0f)).epsilon(1e-4));
    CHECK(weights.weights[0] + weights.weights[1] == doctest::Approx(1));
  }
}

TEST_CASE("a sheet that is only turned about stays as it is, a dented one comes back, and floors hold") {
  const TriangleMesh rest = box();
  const SkinSheet sheet(rest);
  const std::size_t count = rest.positions.size();
  const quat turn = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 3)));
  std::vector<vec3> turned;
  for (vec3 p : rest.positions) turned.push_back(turn * p + vec3(5, 0, 0));
  std::vector<vec3> moved = turned;
  std::vector<quat> turns(count, turn);
  std::vector<SkinSheet::Floor> floors(count);
  sheet.relax(moved, turns, floors, 10);
  for (std::size_t i = 0; i < count; ++i) CHECK(glm::distance(moved[i], turned[i]) < 1e-5f);

  std::vector<vec3> dented = rest.positions;
  dented[0] += vec3(0.3f, 0, 0);
  std::vector<quat> none(count, quat(1, 0, 0, 0));
  sheet.relax(dented, none, floors, 30);
  float widest = 0;
  for (std::size_t i = 0; i < count; ++i)
    widest = std::max(widest, glm::distance(dented[i], rest.positions[i]));
  CHECK(widest < 0.05f);

  floors[0] = {{1, 0, 0}, rest.positions[0].x + 0.2f};
  std::vector<vec3> pushed = rest.positions;
  std::fill(none.begin(), none.end(), quat(1, 0, 0, 0));
  sheet.relax(pushed, none, floors, 10);
  CHECK(pushed[0].x >= rest.positions[0].x + 0.2f - 1e-5f);
  const std::uint32_t beside = sheet.neighbours(0)[0];
  CHECK(pushed[beside].x > rest.positions[beside].x + 0.02f);  // what is around it gives way, too
}

TEST_CASE("the knee cap turns with the knee, the shoulder blade with the arm") {
  const Body body = bodyOf(madeHuman().rig, {}, madeHuman().clips);
  const auto turnOf = [&](std::string_view clip, std::string_view joint, float time) {
    const auto found = std::ranges::find(body.clips, clip, &Clip::name);
    REQUIRE(found != body.clips.end());
    const Pose pose = samplePose(body.skeleton, *found, time);
    const JointId id = body.skeleton.find(joint), above = body.skeleton.joints[id.value].parent;
    const quat local =
        glm::quat_cast(glm::transpose(mat3(pose.world[above.value])) * mat3(pose.world[id.value]));
    return glm::degrees(2 * std::acos(std::min(std::abs(local.w), 1.0f)));
  };
  const float knee = turnOf("squat", "LeftLeg", 1.4f);
  CHECK(knee > 100);
  CHECK(turnOf("squat", "LeftPatella", 1.4f) == doctest::Approx(0.7f * knee).epsilon(0.01));
  CHECK(turnOf("arms_overhead", "LeftScapula", 2) > 25);
  CHECK(turnOf("arms_overhead", "RightShoulder", 2) > 18);
}

TEST_CASE("a coupling of what is no joint or no angle is named with its line") {
  const auto folder = std::filesystem::temp_directory_path() / "vasa_human_couplings";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string head = "joint,angle,leader,leads,share,from_deg\n";
  const auto faultOf = [&](const std::string& row) {
    REQUIRE(writeFileAtomically(folder / "couplings.csv", head + row).ok());
    const auto made = makeClips(kTables / "clips.csv", kTables / "clip_keys.csv", folder / "couplings.csv",
                                madeHuman().rig);
    return made.ok() ? std::string() : made.error().message;
  };
  CHECK(faultOf("LeftPatella,flex,LeftLeg,flex,0.7,\n").empty());
  CHECK(faultOf("LeftWing,flex,LeftLeg,flex,0.7,\n") == "couplings.csv:2: no joint 'LeftWing'");
  CHECK(faultOf("LeftPatella,spin,LeftLeg,flex,0.7,\n") ==
        "couplings.csv:2: an angle is flex, abduct or twist");
  std::filesystem::remove_all(folder);
}
