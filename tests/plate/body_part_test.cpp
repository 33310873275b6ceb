#include "plate/body_part.h"

#include <doctest/doctest.h>

#include "body/doll.h"

using namespace vasa;
using namespace vasa::plate;
using namespace vasa::test;

TEST_CASE("joints belong to parts and sides by their names, in any convention") {
  for (const char* family : {"vrm", "mixamo", "cmu"}) {
    const Body body = dollBody(family);
    const auto parts = partsOfJoints(body);
    REQUIRE_MESSAGE(parts.ok(), parts.error().message);
    const auto partOf = [&](const char* word) {
      return (*parts)[body.skeleton.find(dollName(word, family)).value];
    };
    CHECK(partOf("hips") == SidedPart{BodyPart::abdomen, 0});
    CHECK(partOf("head") == SidedPart{BodyPart::head, 0});
    CHECK(partOf("leftHand") == SidedPart{BodyPart::hand, 1});
    CHECK(partOf("rightLowerLeg") == SidedPart{BodyPart::lowerLeg, -1});
    CHECK(partOf("rightToes") == SidedPart{BodyPart::foot, -1});
  }
}

TEST_CASE("a joint without a known name goes with its parent; a body without names is refused") {
  Body body = dollBody("vrm");
  Skeleton::Joint extra;
  extra.name = "Bone.042";
  extra.parent = body.skeleton.find(dollName("leftHand", "vrm"));
  body.skeleton.joints.push_back(extra);
  const auto parts = partsOfJoints(body);
  REQUIRE(parts.ok());
  CHECK(parts->back() == SidedPart{BodyPart::hand, 1});
  for (std::size_t j = 0; j < body.skeleton.joints.size(); ++j)
    body.skeleton.joints[j].name = "node" + std::to_string(j);
  const auto unknown = partsOfJoints(body);
  REQUIRE_FALSE(unknown.ok());
  CHECK(unknown.error().fault == Fault::badInput);
  CHECK(unknown.error().message.find("not all recognised") != std::string::npos);
}

TEST_CASE("a vertex belongs to the joint with the largest weight") {
  SkinnedMesh mesh;
  mesh.influences = {{.joints = {3, 5, 7, 9}, .weights = {0.2f, 0.1f, 0.6f, 0.1f}},
                     {.joints = {4}, .weights = {1, 0, 0, 0}}};
  CHECK(mainJoints(mesh) == std::vector<std::uint16_t>{7, 4});
}
