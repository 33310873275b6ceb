#include "scene/growth_room.h"

#include <doctest/doctest.h>

#include "support/meshes.h"
#include "support/networks.h"

using namespace vasa;

namespace {

// A vessel of one metre along z from the origin, in a box of skin whose near side lies 2 cm off.
struct Room {
  Room()
      : network(test::straightVessel(1, 0.005f, 0.005f, 4)),
        table(makeSweepTable(network)),
        frames(table.knotCount) {
    body.skeleton.joints.resize(2);
    body.meshes = {test::boxMesh("skin", {-0.02f, -0.3f, -0.1f}, {0.3f, 0.3f, 1.1f})};
    // Skin bends.
    for (SkinInfluence& influence : body.meshes[0].influences) influence = {{0, 1}, {0.5f, 0.5f, 0, 0}};
    networkFrames(network, network.points(), restReferences(network), frames);
  }
  PosedNetwork rest() const { return {table, network.points(), frames}; }

  Network network;
  SweepTable table;
  std::vector<quat> frames;
  Body body;
};

bool inside(const shared::GrowthSite& site, vec3 p) {
  for (const vec4& wall : site.wall)
    if (glm::dot(vec3(wall), p) > wall.w) return false;
  return glm::length(p) <= site.reach;
}

}  // namespace

TEST_CASE("without skin a site has its whole reach") {
  Room room;
  room.body.meshes.clear();
  shared::GrowthSite site{};
  GrowthRoom(room.body, 0.08f).measure(room.rest(), wholeSpans(room.network)[0], site);
  CHECK(site.reach == 0.08f);
  CHECK(site.wall[0] == vec4(0));
}

TEST_CASE(
    "no vertex of the skin lies in a site's room, wherever on its span a tree grows, and the vessel does") {
  const Room room;
  const auto spans = wholeSpans(room.network);
  for (const float most : {0.08f, 0.5f}) {
    const GrowthRoom measured(room.body, most);
    for (const shared::SweepRecord& span : spans) {
      shared::GrowthSite site{};
      measured.measure(room.rest(), span, site);
      CHECK(site.reach > 0);
      CHECK(inside(site, vec3(0)));
      for (const float t : {0.0f, 0.25f, 0.5f, 1.0f}) {
        const Section section = sectionOn(room.rest(), span, t);
        const mat3 inverse = glm::transpose(mat3(section.frame.u, section.frame.v, section.frame.tangent));
        for (const vec3 p : room.body.meshes[0].mesh.positions)
          CHECK(!inside(site, inverse * (p - section.centre)));
      }
    }
  }
}
