#include <doctest/doctest.h>

#include "body/doll.h"
#include "body/retarget.h"
#include "io/bvh.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

const std::string kOwn = "Zrotation Yrotation Xrotation";

// With every joint's turns named otherwise than they were written.
std::string renamed(std::string text, const std::string& turns) {
  for (std::size_t at = text.find(kOwn); at != text.npos; at = text.find(kOwn, at + 1))
    text.replace(at, kOwn.size(), turns);
  return text;
}

Motion read(const std::string& text) {
  auto motion = parseBvh(text, "doll.bvh");
  if (!motion.ok()) FAIL(motion.error().message);
  return std::move(*motion);
}

float sureness(const Motion& motion) {
  const auto done = retargeted(motion, dollBody("cmu"));
  return done.ok() ? done->sureness : 0;
}

constexpr const char* kOthers[] = {"Xrotation Yrotation Zrotation", "Xrotation Zrotation Yrotation",
                                   "Yrotation Xrotation Zrotation", "Yrotation Zrotation Xrotation",
                                   "Zrotation Xrotation Yrotation"};

}  // namespace

TEST_CASE("turns that are named in another order than they were written are doubted: the feet slide") {
  const std::string walk = dollMotion({.family = "cmu", .unitsAMetre = 100, .glides = 0}, 96);
  CHECK_FALSE(read(walk).turnsDoubted);
  CHECK(sureness(read(walk)) == 1);
  for (const char* turns : kOthers) {
    const Motion motion = read(renamed(walk, turns));
    CHECK_MESSAGE(motion.turnsDoubted, turns);
    CHECK(sureness(motion) <= 0.7f);
  }
}

TEST_CASE("feet that slide as they were recorded, or a walk on the spot, cast no doubt on the turns") {
  for (const float glides : {0.5f, 1.0f})
    CHECK_FALSE(read(dollMotion({.family = "cmu", .glides = glides}, 96)).turnsDoubted);
  CHECK_FALSE(read(dollMotion({.family = "cmu"}, 96)).turnsDoubted);
}

TEST_CASE("recorded motions are read in the order that they were written in") {
  VASA_REQUIRE_SHARED_DATA(data);
  for (const char* name : {"cmu_12_01_walk", "cmu_bend_scoop_lift_arm_02_06", "cmu_walk_02_01"}) {
    const std::string text = contentOf(data / "mocap" / (name + std::string(".bvh")));
    CHECK_FALSE(read(text).turnsDoubted);
    for (const char* turns : kOthers) {
      CAPTURE(name);
      CAPTURE(turns);
      CHECK(read(renamed(text, turns)).turnsDoubted);
    }
  }
}
