#include "scene/tissue.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "support/meshes.h"

using namespace vasa;

namespace {

constexpr float kCell = 4e-3f;

// A body of ten centimetres with two organs of four that overlap by two.
Body bodyWithOrgans() {
  Body body;
  body.skeleton.joints.resize(1);
  body.meshes = {test::boxMesh("skin: all", vec3(-0.05f), vec3(0.05f)),
                 test::boxMesh("organ: left", {-0.03f, -0.03f, -0.03f}, {0.01f, 0.03f, 0.03f}),
                 test::boxMesh("organ: right", {-0.01f, -0.03f, -0.03f}, {0.03f, 0.03f, 0.03f})};
  return body;
}

Tissue tissueWith(const Body& body, float wall) {
  const std::array organs{OrganRoom{&body.meshes[1], wall}, OrganRoom{&body.meshes[2], 0}};
  return tissueOf(body, kCell, {}, 0, organs);
}

std::uint8_t roomAt(const Tissue& tissue, vec3 p) { return tissue.rooms[std::size_t(tissue.numberAt(p))]; }

}  // namespace

TEST_CASE("what lies in an organ is a room; where organs overlap the first counts") {
  const Body body = bodyWithOrgans();
  const Tissue tissue = tissueWith(body, 0);
  CHECK(roomAt(tissue, {-0.02f, 0, 0}) == 1);
  CHECK(roomAt(tissue, {0, 0, 0}) == 1);
  CHECK(roomAt(tissue, {0.02f, 0, 0}) == 2);
  CHECK(roomAt(tissue, {0.04f, 0, 0}) == Tissue::kCommon);
  const Tissue plain = tissueOf(body, kCell, {}, 0);
  CHECK(std::ranges::count(plain.rooms, Tissue::kCommon) == std::ptrdiff_t(plain.count()));
}

TEST_CASE("an organ with a wall is hollow, however thin the wall is") {
  const Body body = bodyWithOrgans();
  for (const float wall : {0.5e-3f, 7e-3f}) {
    CAPTURE(wall);
    const Tissue tissue = tissueWith(body, wall);
    const std::int32_t middle = tissue.numberAt(vec3(-0.01f, 0, 0));
    CHECK(tissue.rooms[std::size_t(middle)] == Tissue::kHollow);
    CHECK(tissue.kinds[std::size_t(middle)] == Tissue::Kind::lumen);
    CHECK(roomAt(tissue, {-0.01f, 0.027f, 0}) == 1);  // the outermost cubes
    CHECK((roomAt(tissue, {-0.01f, 0.023f, 0}) == 1) == (wall > kCell));
    CHECK(roomAt(tissue, {0.02f, 0, 0}) == 2);
  }
}

TEST_CASE("a way into an organ costs the toll, one beside it does not") {
  const Body body = bodyWithOrgans();
  const Tissue tissue = tissueWith(body, 0);
  const std::vector<char> all(tissue.count(), 1);
  const std::vector<TissueWays::Source> sources{{tissue.numberAt(vec3(0.04f, 0, 0)), 0}};
  const TissueWays free = waysFrom(tissue, sources, all), tolled = waysFrom(tissue, sources, all, 400);
  const auto extra = [&](vec3 p) {
    const auto cube = std::size_t(tissue.numberAt(p));
    return tolled.length[cube] - free.length[cube];
  };
  CHECK(extra({0.02f, 0, 0}) == 400);
  CHECK(extra({0.04f, 0.04f, 0}) == 0);
  CHECK(free.length[std::size_t(tissue.numberAt(vec3(0.04f, 0.02f, 0)))] == 50);  // five cubes
}
