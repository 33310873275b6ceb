#include "atlas/body_region.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "body/doll.h"

using namespace vasa;
using namespace vasa::atlas;
using namespace vasa::test;

TEST_CASE("joints belong to parts and sides by their names, in any convention") {
  for (const char* family : {"vrm", "mixamo", "cmu"}) {
    const Body body = dollBody(family);
    const RegionFinder regions(body.skeleton);
    CHECK(regions.knowsPerson());
    const auto partOf = [&](const char* word) {
      return regions.of(body.skeleton.find(dollName(word, family)));
    };
    CHECK(partOf("hips") == BodyRegion{BodyPart::pelvis, 0});
    CHECK(partOf("head") == BodyRegion{BodyPart::head, 0});
    CHECK(partOf("leftHand") == BodyRegion{BodyPart::hand, 1});
    CHECK(partOf("rightLowerLeg") == BodyRegion{BodyPart::leg, -1});
    CHECK(partOf("rightToes") == BodyRegion{BodyPart::foot, -1});
  }
}

TEST_CASE("a joint that is not known goes with its parent, and a body without names or shape is no person") {
  Body body = dollBody("vrm");
  Skeleton::Joint extra;
  extra.name = "Bone.042";
  extra.parent = body.skeleton.find(dollName("leftHand", "vrm"));
  body.skeleton.joints.push_back(extra);
  const JointId last{std::uint32_t(body.skeleton.joints.size() - 1)};
  CHECK(RegionFinder(body.skeleton).of(last) == BodyRegion{BodyPart::hand, 1});
  for (std::size_t j = 0; j < body.skeleton.joints.size(); ++j) {
    body.skeleton.joints[j].name = "node" + std::to_string(j);
    body.skeleton.joints[j].restWorld[3] = vec4(0, 0, 0, 1);
  }
  CHECK_FALSE(RegionFinder(body.skeleton).knowsPerson());
}

TEST_CASE("every region has a rank and a name of its own") {
  std::vector<std::string> names;
  for (std::size_t r = 0; r < bodyRegions().size(); ++r) {
    CHECK(rankOf(bodyRegions()[r]) == r);
    names.push_back(nameOf(bodyRegions()[r]));
  }
  CHECK(names.front() == "Head");
  CHECK(nameOf({BodyPart::forearm, 1}) == "Left forearm");
  std::ranges::sort(names);
  CHECK(std::ranges::adjacent_find(names) == names.end());
}
