#include <doctest/doctest.h>

#include <cmath>

#include "body/carry.h"
#include "body/doll.h"
#include "body/person.h"
#include "body/strain.h"
#include "body/strain_limit.h"
#include "body/surface_carry.h"
#include "mesh/components.h"
#include "mesh/weld.h"
#include "network/sample_network.h"
#include "support/meshes.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// An arch and what leaves it, in the trunk.
Network archNetwork() {
  std::vector<vec4> arch;
  for (int i = 0; i <= 12; ++i) {
    const float t = float(i) / 12;  // up in front, over, and down behind
    const float angle = kPi * std::min(1.0f, t / 0.5f);
    arch.emplace_back(0.02f * std::cos(angle),
                      t < 0.5f ? 1.3f + 0.05f * std::sin(angle) : 1.3f - 0.5f * (t - 0.5f),
                      0.03f * std::cos(angle), 0.012f);
  }
  NetworkBuilder builder;
  builder.addVessel({"arch", {}, VesselKind::artery}, arch);
  builder.addVessel({"along the spine", {}, VesselKind::vein},
                    straightVessel({0.02f, 1.0f, -0.03f}, {0.02f, 1.4f, -0.03f}, 0.01f, 8));
  auto network = builder.build(1.75f);
  if (!network.ok()) FAIL(network.error().message);
  return std::move(*network);
}

// A joint elsewhere, all that hangs on it where it was: another rig of the same person.
Body withJointMoved(Body body, std::string_view name, vec3 by) {
  auto& joints = body.skeleton.joints;
  const JointId moved = body.skeleton.find(name);
  joints[moved.value].restWorld[3] += vec4(by, 0);
  joints[moved.value].rest.translation += by;
  for (auto& joint : joints)
    if (joint.parent == moved) joint.rest.translation -= by;
  joints[moved.value].inverseBind = glm::inverse(joints[moved.value].restWorld);
  return body;
}

// The doll with a spine of boxes and twelve pairs of ribs beside it.
Body ribbedDoll(float lowestRib, float pitch) {
  Body body = dollBody("cmu");
  SkinnedMesh bones;
  bones.name = "bones";
  const auto add = [&](vec3 centre, vec3 half) {
    const float y = centre.y;
    const JointId carrier = body.skeleton.find(y < 0.9f    ? "LeftFoot"
                                               : y < 1.2f  ? "LowerBack"
                                               : y < 1.45f ? "Spine"
                                                           : "Head");
    const SkinnedMesh box = boxMesh("bones", centre - half, centre + half);
    appendMesh(bones.mesh, box.mesh);
    bones.normals.insert(bones.normals.end(), box.normals.begin(), box.normals.end());
    bones.influences.insert(bones.influences.end(), box.normals.size(),
                            {{std::uint16_t(carrier.value)}, {1, 0, 0, 0}});
  };
  for (int k = 0; k < 12; ++k) {
    const float y = lowestRib + pitch * float(k);
    add({0, y, -0.01f}, {0.02f, 0.4f * pitch, 0.02f});
    for (const float side : {1.0f, -1.0f}) add({0.061f * side, y, -0.01f}, {0.04f, 0.4f * pitch, 0.02f});
  }
  add({0, 1.65f, 0}, {0.07f, 0.1f, 0.09f});
  add({0.09f, 0.03f, 0.05f}, {0.04f, 0.03f, 0.1f});
  body.meshes.push_back(std::move(bones));
  return body;
}

float worstAway(std::span<const vec4> points, std::span<const vec4> wanted) {
  float worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    worst = std::max(worst, glm::distance(vec3(points[i]), vec3(wanted[i])));
  return worst;
}

}  // namespace

TEST_CASE("strain is told by pieces, beside the factor of the whole, the worst vessel first") {
  NetworkBuilder builder;
  builder.addVessel({"even"}, straightVessel({0, 0, 0}, {0, 0.2f, 0}, 0.002f, 20));
  builder.addVessel({"uneven"}, straightVessel({1, 0, 0}, {1, 0.2f, 0}, 0.002f, 20));
  const auto network = builder.build(1);
  REQUIRE(network.ok());
  std::vector<vec4> after(network->points().begin(), network->points().end());
  for (vec4& p : after) {  // twice as large; of the second vessel the upper half three times as long as that
    if (p.x > 0.5f && p.y > 0.1f) p.y = 0.1f + 3 * (p.y - 0.1f);
    p.x *= 2, p.y *= 2, p.z *= 2;
  }
  const auto strains = measureStrain(*network, network->points(), after, 2);
  REQUIRE(strains.size() == 2);
  CHECK(network->vessel(strains[0].vessel).name == "uneven");
  CHECK(strains[0].most == doctest::Approx(3).epsilon(0.02));
  CHECK(strains[0].least == doctest::Approx(1).epsilon(0.02));
  CHECK(strains[0].place.y > 0.2f);
  CHECK(strains[1].most == doctest::Approx(1).epsilon(1e-3));
  CHECK(strains[1].least == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("joints of a spine that sit at other vertebrae stretch no vessel") {
  const Body from = dollBody("vrm");
  const Body to = withJointMoved(from, "chest", vec3(0, -0.06f, 0));
  const Network network = archNetwork();
  const auto carried = carryNetwork(network, from, to, "arch.vasa");
  if (!carried.ok()) FAIL(carried.error().message);
  const auto strains = measureStrain(network, network.points(), carried->points, carried->radiusFactor);
  for (const VesselStrain& strain : strains) {
    CHECK(strain.least > 0.95f);
    CHECK(strain.most < 1.05f);
  }
  CHECK(worstAway(carried->points, network.points()) < 0.01f);
}

TEST_CASE("a pelvis is where its legs hang on it, wherever a rig puts the joint of the hips") {
  const Body from = dollBody("vrm");
  NetworkBuilder builder;
  builder.addVessel({"iliac artery"}, straightVessel({0.02f, 0.99f, 0}, {0.07f, 0.91f, 0.02f}, 0.004f, 8));
  builder.addVessel({"median sacral"}, straightVessel({0, 1.0f, -0.03f}, {0, 0.9f, -0.05f}, 0.002f, 8));
  const auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  for (const vec3 by : {vec3(0, 0.05f, 0), vec3(0, -0.05f, 0), vec3(0, 0.03f, -0.04f)}) {
    const auto carried = carryNetwork(*network, from, withJointMoved(from, "hips", by), "iliac.vasa");
    if (!carried.ok()) FAIL(carried.error().message);
    CHECK(worstAway(carried->points, network->points()) < 0.004f);
  }
}

TEST_CASE("a chest that ends lower takes the vessels of its ribs down, and those of pelvis and neck stay") {
  NetworkBuilder builder;
  builder.addVessel({"intercostal"},
                    straightVessel({0.025f, 1.13f, 0.02f}, {0.06f, 1.13f, 0.02f}, 0.001f, 8));
  builder.addVessel({"iliac"}, straightVessel({0.02f, 0.94f, 0}, {0.08f, 0.91f, 0}, 0.004f, 8));
  builder.addVessel({"carotid"}, straightVessel({0.03f, 1.45f, 0}, {0.03f, 1.53f, 0}, 0.003f, 8));
  const auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  const auto carried =
      carryNetwork(*network, ribbedDoll(1.13f, 0.022f), ribbedDoll(1.1f, 0.0247f), "chest.vasa");
  if (!carried.ok()) FAIL(carried.error().message);
  std::vector<vec4> wanted(network->points().begin(), network->points().end());
  for (vec4& p : std::span(wanted).first(network->vessels()[0].pointCount)) p.y -= 0.03f;
  CHECK(worstAway(carried->points, wanted) < 0.009f);
}

TEST_CASE("the joint of a palm may sit at the wrist or at the knuckles") {
  Body from = dollBody("vrm");
  auto& joints = from.skeleton.joints;
  const JointId hand = from.skeleton.find("leftHand");
  const vec3 wrist(joints[hand.value].restWorld[3]);
  const vec3 along =
      glm::normalize(wrist - vec3(joints[from.skeleton.find("leftLowerArm").value].restWorld[3]));
  const auto add = [&](const char* name, JointId parent, vec3 place) {
    Skeleton::Joint joint{name, parent, {}, glm::translate(mat4(1), place), {}};
    joint.rest.translation = place - vec3(joints[parent.value].restWorld[3]);
    joint.inverseBind = glm::inverse(joint.restWorld);
    joints.push_back(joint);
    return JointId{std::uint32_t(joints.size() - 1)};
  };
  const JointId palm = add("leftPalm", hand, wrist + 0.02f * along);
  for (const char* finger : {"leftIndexProximal", "leftMiddleProximal"})
    add(finger, palm, wrist + 0.09f * along + vec3(0, 0, finger[4] == 'I' ? 0.01f : -0.01f));
  NetworkBuilder builder;
  builder.addVessel({"palmar artery"}, straightVessel(wrist, wrist + 0.085f * along, 0.001f, 8));
  const auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  const auto carried =
      carryNetwork(*network, from, withJointMoved(from, "leftPalm", 0.04f * along), "palm.vasa");
  if (!carried.ok()) FAIL(carried.error().message);
  CHECK(worstAway(carried->points, network->points()) < 0.004f);
}

TEST_CASE("vessels of a limb that the other body lacks are named") {
  const Body from = person();
  Body to = from;
  for (auto& joint : to.skeleton.joints)  // no part by its name, and none by shape
    if (joint.name == "leftLowerLeg" || joint.name == "leftFoot" || joint.name == "leftToes")
      joint.name = "prop";
  const Body ofOneBone = to;  // the skin is all there
  for (SkinnedMesh& skin : to.meshes)
    std::erase_if(skin.mesh.triangles, [&](const uvec3& t) {
      return skin.mesh.positions[t.x].x > 0 && skin.mesh.positions[t.x].y < 0.5f;
    });
  NetworkBuilder builder;
  for (const float side : {1.0f, -1.0f})
    builder.addVessel({side > 0 ? "left tibial artery" : "right tibial artery"},
                      straightVessel({0.09f * side, 0.4f, 0}, {0.09f * side, 0.1f, 0}, 0.003f, 8));
  builder.addVessel({"aorta"}, straightVessel({0.02f, 1.0f, 0}, {0.02f, 1.3f, 0}, 0.01f, 8));
  const auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  const auto carried = carryNetwork(*network, from, to, "a.vasa");
  if (!carried.ok()) FAIL(carried.error().message);
  CHECK(carried->limbsMissing == std::vector<std::string>{"left leg"});
  CHECK(carried->vesselsPressed == std::vector<std::string>{"left tibial artery"});
  const auto stiff = carryNetwork(*network, from, ofOneBone, "a.vasa");
  if (!stiff.ok()) FAIL(stiff.error().message);
  CHECK(stiff->limbsMissing.empty());
  CHECK(worstAway(stiff->points, network->points()) < 0.01f);
  const auto whole = carryNetwork(*network, from, from, "a.vasa");
  REQUIRE(whole.ok());
  CHECK(whole->limbsMissing.empty());
  CHECK(whole->vesselsPressed.empty());
}

TEST_CASE("a body that lies at rest, whichever way, takes vessels as one that stands") {
  const Body standing = person();
  const vec3 head(standing.skeleton.joints[standing.skeleton.find("head").value].restWorld[3]);
  NetworkBuilder builder;
  builder.addVessel({"in the head"}, straightVessel(head + vec3(-0.03f, 0.08f, 0.05f),
                                                    head + vec3(0.04f, 0.12f, 0.02f), 0.002f, 8));
  builder.addVessel({"in the trunk"}, straightVessel({0.1f, 1.0f, 0.05f}, {0.1f, 1.3f, 0.05f}, 0.005f, 8));
  builder.addVessel({"in the foot"}, straightVessel({0.09f, 0.03f, 0}, {0.09f, 0.03f, 0.1f}, 0.002f, 8));
  const auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  const auto there = carryNetwork(*network, standing, standing, "a.vasa");
  REQUIRE(there.ok());
  CHECK(worstAway(there->points, network->points()) < 0.01f);
  for (const vec3 axis : {vec3(1, 0, 0), vec3(0, 0, 1), vec3(-1, 0, 0), vec3(0, 0, -1)}) {
    const mat4 turn = mat4(mat3_cast(glm::angleAxis(kPi / 2, axis)));
    Body lying = standing;
    lying.skeleton.rootTransform = turn * lying.skeleton.rootTransform;
    for (auto& joint : lying.skeleton.joints)
      joint.restWorld = turn * joint.restWorld, joint.inverseBind = glm::inverse(joint.restWorld);
    for (vec3& p : lying.meshes[0].mesh.positions) p = vec3(turn * vec4(p, 1));
    for (vec3& n : lying.meshes[0].normals) n = vec3(turn * vec4(n, 0));
    CHECK(lying.height() == doctest::Approx(standing.height()).epsilon(1e-4));
    const auto carried = carryNetwork(*network, standing, lying, "a.vasa");
    if (!carried.ok()) FAIL(carried.error().message);
    CHECK(carried->bodyHeight == doctest::Approx(there->bodyHeight).epsilon(1e-4));
    std::vector<vec4> wanted;
    for (const vec4& p : there->points) wanted.push_back(vec4(vec3(turn * vec4(vec3(p), 1)), p.w));
    CHECK_MESSAGE(worstAway(carried->points, wanted) < 0.005f, axis.x << ' ' << axis.z);
    // And back, out of the lying one.
    std::vector<vec4> points(carried->points);
    NetworkBuilder again;
    for (const Vessel& vessel : network->vessels()) {
      const auto own = Network::pointsOf(vessel, std::span<const vec4>(points));
      again.addVessel({vessel.name}, {own.begin(), own.end()});
    }
    const auto lain = again.build(1.75f);
    REQUIRE(lain.ok());
    const auto back = carryNetwork(*lain, lying, standing, "a.vasa");
    if (!back.ok()) FAIL(back.error().message);
    CHECK_MESSAGE(worstAway(back->points, there->points) < 0.01f, axis.x << ' ' << axis.z);
  }
}

TEST_CASE(
    "a trunk's surface is found in a body wherever it stands and whatever it faces, and its vessels follow") {
  const Body body = person();
  const SkinShell skin(skinAtRest(body));
  const Network network = archNetwork();
  for (const auto& [degrees, times] :
       {std::pair(0.0f, 1.0f), {90.0f, 0.9f}, {180.0f, 1.0f}, {-90.0f, 1.15f}}) {
    const float turn = degrees, size = times;
    // Someone else's trunk, which is where the body's would be by `by`.
    Similarity by{size, glm::angleAxis(turn * kPi / 180, vec3(0, 1, 0)), vec3(-0.4f, 0.7f, 1.3f)};
    TriangleMesh trunk = stacked({personTrunk().begin(), personTrunk().end() - 1}, 0);
    for (vec3& p : trunk.positions) p = by(p);
    std::vector<vec4> points;
    for (const vec4& p : network.points()) points.push_back(vec4(by(vec3(p)), size * p.w));
    NetworkBuilder builder;
    for (const Vessel& vessel : network.vessels()) {
      const auto own = Network::pointsOf(vessel, std::span<const vec4>(points));
      builder.addVessel({vessel.name, {}, vessel.kind}, {own.begin(), own.end()});
    }
    const auto elsewhere = builder.build(1.75f);
    REQUIRE(elsewhere.ok());
    const auto carried = carryBySurface(*elsewhere, trunk, body, "arch.vasa", "trunk.stl");
    if (!carried.ok()) FAIL(carried.error().message);
    CHECK_MESSAGE(carried->fit.share > 0.8f, turn);
    CHECK_MESSAGE(carried->fit.by.scale == doctest::Approx(1 / size).epsilon(0.05), turn);
    const float away = worstAway(carried->network.points, network.points());
    CHECK_MESSAGE(away < 0.015f, turn);
    CHECK(carried->network.points[0].w == doctest::Approx(network.points()[0].w).epsilon(0.06));
  }
}

TEST_CASE("a limb's surface is found in its own limb, and a mirror image by what its vessels are called") {
  const Body body = person();
  const TriangleMesh whole = skinAtRest(body);
  const auto at = [&](const char* joint) {
    return vec3(body.skeleton.joints[body.skeleton.find(joint).value].restWorld[3]);
  };
  const auto carried = [&](TriangleMesh surface, float x, vec3 move) {
    NetworkBuilder builder;
    for (const float side : {1.0f, -1.0f}) {
      if (side < 0 && surface.triangles.size() < whole.triangles.size()) continue;  // of the left arm alone
      const vec3 sign(side * x, 1, 1);
      builder.addVessel(
          {side > 0 ? "left ulnar artery" : "right ulnar artery", {}, VesselKind::artery},
          straightVessel(sign * at("leftLowerArm") + move, sign * at("leftHand") + move, 0.002f, 8));
    }
    for (vec3& p : surface.positions) p = vec3(x, 1, 1) * p + move;
    if (x < 0)
      for (uvec3& t : surface.triangles) std::swap(t.y, t.z);
    const auto network = builder.build(1.75f);
    REQUIRE(network.ok());
    return carryBySurface(*network, surface, body, "arm.vasa", "arm.stl");
  };
  TriangleMesh arm{whole.positions, {}};
  for (const uvec3& t : whole.triangles)
    if (std::min({whole.positions[t.x].x, whole.positions[t.y].x, whole.positions[t.z].x}) >
        at("leftUpperArm").x)
      arm.triangles.push_back(t);
  const auto placed = carried(weld(arm, 0), 1, {0.5f, -0.3f, 1.2f});
  if (!placed.ok()) FAIL(placed.error().message);
  CHECK(placed->fit.share > 0.95f);
  CHECK(glm::distance(vec3(placed->network.points.front()), at("leftLowerArm")) < 0.01f);
  CHECK(glm::distance(vec3(placed->network.points.back()), at("leftHand")) < 0.01f);
  const auto refused = carried(whole, -1, vec3(0));
  REQUIRE_FALSE(refused);
  CHECK_MESSAGE(refused.error().message.find("arm.stl and arm.vasa are mirror images") != std::string::npos,
                refused.error().message);
}

TEST_CASE("surfaces that are no skin of the vessels or of a person are refused with what helps") {
  const Body body = person();
  const Network network = archNetwork();
  TriangleMesh away = stacked(personTrunk(), 2);
  auto refused = carryBySurface(network, away, body, "arch.vasa", "trunk.stl");
  REQUIRE_FALSE(refused);
  CHECK(refused.error().message.find("100 % of these vessels lie outside trunk.stl") != std::string::npos);
  CHECK(refused.error().message.find("--unit, --up") != std::string::npos);
  // A flat slab around the vessels.
  TriangleMesh slab = stacked({{0.9f, 1.5f, 0.5f, 0.5f}, {1.45f, 1.5f, 0.5f, 0.5f}}, 0);
  refused = carryBySurface(network, slab, body, "arch.vasa", "slab.stl");
  REQUIRE_FALSE(refused);
  CHECK(refused.error().message.find("slab.stl is not found in the skin of doll.glb") != std::string::npos);
  CHECK(refused.error().message.find("vasa place") != std::string::npos);
  Body bare = dollBody("vrm");
  refused = carryBySurface(network, stacked(personTrunk(), 0), bare, "arch.vasa", "trunk.stl");
  REQUIRE_FALSE(refused);
  CHECK(refused.error().message.find("has no skin") != std::string::npos);
}

TEST_CASE("strain is held to what the surroundings do") {
  NetworkBuilder builder;
  for (int i = 0; i < 6; ++i)
    builder.addVessel({"around " + std::to_string(i)},
                      straightVessel({0.01f * float(i), 0, 0}, {0.01f * float(i), 0.2f, 0}, 0.002f, 20));
  builder.addVessel({"torn"}, straightVessel({0.02f, 0.05f, 0.01f}, {0.02f, 0.09f, 0.01f}, 0.001f, 8));
  const auto made = builder.build(1.75f);
  REQUIRE(made.ok());
  const Network& network = *made;
  // All twice as large, as a larger head; of one vessel the last quarter is drawn away by 15 cm.
  std::vector<vec4> after(network.points().begin(), network.points().end());
  const Vessel& torn = network.vessels()[6];
  for (std::size_t i = 0; i < after.size(); ++i) {
    const bool drawn = i >= torn.firstPoint + torn.pointCount - 3;
    after[i] = vec4(2.0f * vec3(after[i]) + (drawn ? vec3(0, 0.15f, 0) : vec3(0)), after[i].w);
  }
  const std::vector<vec4> before = after;
  const StrainLimitReport report = limitStrain(network, network.points(), after);
  CHECK(report.held > 0);
  CHECK(report.beyond == 0);
  for (const VesselStrain& strain : measureStrain(network, network.points(), after, 2)) {
    CHECK(strain.most < kMostUnevenStrain + 0.05f);
    CHECK(strain.least > 1 / kMostUnevenStrain - 0.05f);
  }
  // What was even stays as it was, to the bit; a second run finds nothing to do.
  for (std::uint32_t i = 0; i < torn.firstPoint; ++i) CHECK(after[i] == before[i]);
  CHECK(limitStrain(network, network.points(), after).held == 0);
}
