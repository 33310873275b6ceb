#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "body/skin_shell.h"
#include "growth/regions.h"
#include "mesh/triangle_tree.h"
#include "mesh/winding_number.h"
#include "scene_human.h"

using namespace vasa;

namespace {

// [m] below an organ's surface: what lies deeper goes through it, the rest lies in a groove
// (make_human/organs.cpp).
constexpr float kGroove = 9e-3f;

const char* const kSolid[] = {"left lung", "right lung",       "liver",        "spleen",
                              "kidney",    "suprarenal gland", "stomach",      "oesophagus",
                              "windpipe",  "pancreas",         "gall bladder", "bladder"};

// An organ, and what runs through it all the same.
const std::pair<std::string, std::string> kThrough[] = {
    {"left lung", "left superior intercostal vein"},  // lies on the aortic arch; the lung has no notch there
    {"liver", "cystic artery"},                       // the gall bladder's neck lies in the liver
    {"liver", "cystic vein"},
    {"liver", "right suprarenal vein"}};  // the liver lies on the gland

// How deep a vessel lies in a mesh at most; 0: nowhere.
float deepest(const Network& network, const Vessel& vessel, const TriangleMesh& mesh,
              const WindingNumber& inside, const TriangleTree& surface) {
  const Aabb bounds = mesh.bounds();
  const auto points = network.pointsOf(vessel);
  float deepest = 0;
  for (float u = 0; u <= float(spanCount(points)); u += 0.1f) {
    const vec3 p(evaluate(points, u));
    if (bounds.distance(p) > 0 || std::abs(inside.at(p)) < 0.5f) continue;
    deepest = std::max(deepest, surface.nearest(p).distance);
  }
  return deepest;
}

}  // namespace

TEST_CASE("of the human's vessels none goes through a solid organ that it does not feed") {
  const std::filesystem::path folder = VASA_GROWTH_DATA;
  const auto rules = readGrowthRules(folder / "capillaries.lsys");
  REQUIRE(rules.ok());
  const auto regions = readRegions(folder / "regions.csv", *rules);
  REQUIRE_MESSAGE(regions.ok(), (regions.ok() ? "" : regions.error().message));
  const Network& network = human().network;
  std::size_t through = 0;
  for (const std::string name : kSolid) {
    CAPTURE(name);
    const auto mesh = std::ranges::find(human().body.meshes, "organ: " + name, &SkinnedMesh::name);
    REQUIRE(mesh != human().body.meshes.end());
    const GrowthRegion* region = regionOfOrgan(*regions, mesh->name);
    REQUIRE(region);
    const TriangleMesh atRest = meshAtRest(human().body, *mesh);
    const WindingNumber inside(atRest.positions, atRest.triangles);
    const TriangleTree surface(atRest);
    for (const Vessel& vessel : network.vessels()) {
      if (!region->vessels.empty() && namesVessel(*region, vessel.name, vessel.ontologyId)) continue;
      const float depth = deepest(network, vessel, atRest, inside, surface);
      if (depth < kGroove) continue;
      CAPTURE(vessel.name);
      CAPTURE(depth);
      CHECK(std::ranges::find(kThrough, std::pair(name, vessel.name)) != std::end(kThrough));
      ++through;
    }
  }
  CHECK(through == std::size(kThrough));  // none that is known to is free by now
}

TEST_CASE("inferior phrenic arteries run below the diaphragm, outside of what lies there") {
  const Network& network = human().network;
  for (const char* name : {"left inferior phrenic artery", "right inferior phrenic artery"})
    for (const char* organ : {"liver", "stomach", "spleen", "left lung", "right lung", "heart"}) {
      CAPTURE(std::string(name));
      CAPTURE(std::string(organ));
      const auto vessel = std::ranges::find(network.vessels(), name, &Vessel::name);
      const auto mesh =
          std::ranges::find(human().body.meshes, "organ: " + std::string(organ), &SkinnedMesh::name);
      REQUIRE(vessel != network.vessels().end());
      REQUIRE(mesh != human().body.meshes.end());
      const TriangleMesh atRest = meshAtRest(human().body, *mesh);
      CHECK(deepest(network, *vessel, atRest, WindingNumber(atRest.positions, atRest.triangles),
                    TriangleTree(atRest)) < 1e-3f);
    }
}
