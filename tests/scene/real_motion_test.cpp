#include <doctest/doctest.h>

#include "avoid/sides.h"
#include "collide/passages.h"
#include "scene/frame.h"
#include "support/real_scene.h"
#include "support/shared_data.h"

using namespace vasa;

TEST_CASE("a real body's vessels part in its motions, none passes through another, and few stay in bone") {
  VASA_REQUIRE_SHARED_DATA(data);
  const auto scene = test::realScene(data);
  REQUIRE(scene.ok());
  CHECK(Interference(scene->network).restPairCount() <=
        39);  // a hundredth of those that overlap in the source
  FrameMaker maker(*scene, {.avoid = true});
  Interference interference(scene->network);
  RestSides sides(scene->network, interference);
  PassageSearch search(interference.restTubes(), interference.layout().neighbours());
  std::vector<Bezier> tubes(interference.layout().count()), last;
  std::vector<RestSides::Turned> changed;
  struct Motion {
    const char* clip;
    std::uint32_t mostInBone;  // tubes of a frame, of 14,149
  };
  for (const Motion& motion : {Motion{"elbow_flex", 0}, Motion{"fist", 6}, Motion{"neck_turn", 0}}) {
    const char* name = motion.clip;
    CAPTURE(std::string(name));
    const auto clip = findClip(scene->body, name);
    REQUIRE(clip.ok());
    std::uint32_t most = 0;
    for (std::uint32_t frame = 0; frame < (*clip)->frameCount(); ++frame) {
      CAPTURE(frame);
      maker.make(*clip, (*clip)->timeOfFrame(frame));
      const AvoidReport& report = maker.report().avoid;
      CHECK(report.after.holds());
      CHECK(report.bonesAfter.contacts <= motion.mostInBone);
      interference.layout().shape(maker.points(), tubes);
      if (frame > 0) CHECK(search.find(last, tubes).empty());
      last = tubes;
      if (frame % 15 != 7) continue;
      most = std::max(most, maker.lookAtPosed().vessels.contacts);
      sides.findChanged(tubes, maker.rotations(), changed);
      CHECK(changed.empty());
    }
    CHECK(most > 3);
  }
}
