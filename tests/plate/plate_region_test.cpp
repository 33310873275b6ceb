#include "plate/plate_region.h"

#include <doctest/doctest.h>

using namespace vasa;
using namespace vasa::plate;

TEST_CASE("a vertex belongs to the joint with the largest weight") {
  SkinnedMesh mesh;
  mesh.influences = {{.joints = {3, 5, 7, 9}, .weights = {0.2f, 0.1f, 0.6f, 0.1f}},
                     {.joints = {4}, .weights = {1, 0, 0, 0}}};
  Body body;
  body.skeleton.joints.resize(10);
  CHECK(mainJoints(body, mesh) == std::vector<std::uint16_t>{7, 4});
}

TEST_CASE("a plate that there is not is told with those that there are") {
  CHECK(checkPlateName("hand").ok());
  const auto wrong = checkPlateName("elbow");
  REQUIRE_FALSE(wrong.ok());
  CHECK(wrong.error().fault == Fault::usage);
  CHECK(wrong.error().message.find("foot") != std::string::npos);
}
