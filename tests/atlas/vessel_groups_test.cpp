#include "atlas/vessel_groups.h"

#include "atlas/human_scene.h"

using namespace vasa;
using namespace vasa::atlas;
using namespace vasa::test;

TEST_CASE("every vessel is in one system and one region, where an anatomist looks for it") {
  const VesselGroups groups = groupsOf(humanScene());
  const auto is = [&](const char* name, VesselSystem system, BodyRegion region) {
    const std::size_t v = vesselNamed(humanScene().network, name);
    CHECK_MESSAGE(groups.system[v] == system, name);
    CAPTURE(std::string(name));
    CAPTURE(nameOf(groups.region[v]));
    CHECK(groups.region[v] == region);
  };
  is("left femoral artery", VesselSystem::arteries, {BodyPart::thigh, 1});
  is("right great saphenous vein", VesselSystem::veins, {BodyPart::leg, -1});
  is("left radial artery", VesselSystem::arteries, {BodyPart::forearm, 1});
  is("right brachial artery", VesselSystem::arteries, {BodyPart::upperArm, -1});
  is("abdominal aorta", VesselSystem::arteries, {BodyPart::abdomen});
  is("portal vein", VesselSystem::portal, {BodyPart::abdomen});
  is("pulmonary trunk", VesselSystem::pulmonary, {BodyPart::chest});
  is("left posterior tibial artery", VesselSystem::arteries, {BodyPart::leg, 1});
  is("celiac trunk", VesselSystem::arteries, {BodyPart::abdomen});
  is("left renal vein", VesselSystem::veins, {BodyPart::abdomen});
  is("thoracic aorta", VesselSystem::arteries, {BodyPart::chest});
  is("left external iliac artery", VesselSystem::arteries, {BodyPart::pelvis});
  is("left common carotid artery", VesselSystem::arteries, {BodyPart::neck});
}
