#include <doctest/doctest.h>

#include "scene/frame.h"
#include "support/real_scene.h"
#include "support/shared_data.h"

using namespace vasa;

TEST_CASE("a real body's vessels part in its motions, none changes sides, and few stay in bone") {
  VASA_REQUIRE_SHARED_DATA(data);
  const test::TemporaryFolder folder;
  const auto scene = test::realScene(data, folder.path());
  REQUIRE(scene.ok());
  FrameMaker maker(*scene, {.avoid = true});
  struct Motion {
    const char* clip;
    std::uint32_t mostInBone;  // tubes of a frame, of 14,149
  };
  for (const auto& [name, mostInBone] : {Motion{"elbow_flex", 0}, Motion{"knee_squat", 3}, Motion{"fist", 6}, Motion{"neck_turn", 0}}) {
    CAPTURE(std::string(name));
    const auto clip = findClip(scene->body, name);
    REQUIRE(clip.ok());
    std::uint32_t most = 0;
    for (std::uint32_t frame = 7; frame < (*clip)->frameCount(); frame += 15) {
      CAPTURE(frame);
      maker.make(*clip, (*clip)->timeOfFrame(frame));
      const AvoidReport& report = maker.report().avoid;
      most = std::max(most, report.before.contacts);
      CHECK(report.after.holds());
      CHECK(report.sidesChangedAfter == 0);
      CHECK(report.bonesAfter.contacts <= mostInBone);
    }
    CHECK(most > 10);
  }
}
