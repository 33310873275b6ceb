#include "scene/growth.h"

#include <algorithm>
#include <cmath>

#include "body/point_tree.h"
#include "core/parallel.h"
#include "growth/random.h"
#include "scene/growth_room.h"
#include "surface/tessellate.h"

namespace vasa {
namespace {

constexpr float kTableHeight = 1.75f;  // [m] of the body that the tables' lengths are for
// Most radii of a stem that a free end may go on in: thicker ones were cut off.
constexpr float kThickTip = 1.6f;
constexpr float kMostReach = 0.08f;    // [m] of a tree
constexpr float kPartnerFar = 0.025f;  // [m] between an artery and the vein that its trees run into

// The limb around a place: the nearest point of its link, and its direction.
struct Limb {
  vec3 centre, axis;
};

Limb limbAt(const SpineSet& spines, JointId joint, vec3 p) {
  const SpineJoint* link = &spines.joints[joint.value];
  while (link->link <= 0 && link->parent.valid()) link = &spines.joints[link->parent.value];
  if (link->link <= 0) return {link->centre, vec3(0, 1, 0)};
  // A tip's link goes on behind its joint, hence no end there.
  const bool tip = !spines.joints[joint.value].next.valid();
  const float along =
      std::clamp(glm::dot(p - link->centre, link->axis), 0.0f, tip ? 2 * link->link : link->link);
  return {link->centre + along * link->axis, link->axis};
}

// Spans of vessels that are drawn at all: not those that others run in the place of.
std::vector<bool> drawnSpans(const SweepTable& table) {
  std::vector<bool> drawn(table.spanCount);
  for (const std::uint32_t span : table.spanOfSweep) drawn[span] = true;
  return drawn;
}

// From where to where each vessel is a tube or a fork's trunk: the rest lies in the collars that its ends
// leave by.
std::vector<vec2> shownStretches(const Network& network, const SweepTable& table) {
  std::vector<vec2> shown;
  for (const Vessel& vessel : network.vessels()) shown.emplace_back(0, vessel.spanCount());
  for (const shared::ForkBranch& branch : table.branches) {
    const float u = float(branch.ring.point - branch.ring.firstPoint) + branch.ring.t;
    vec2& stretch = shown[branch.vessel];
    if (branch.ring.turn > 0)
      stretch.x = std::max(stretch.x, u);
    else
      stretch.y = std::min(stretch.y, u);
  }
  return shown;
}

std::uint8_t freeEndsOf(const Network& network, const shared::SweepRecord& span) {
  const Vessel& vessel = network.vessels()[span.vessel];
  const bool first = span.point == span.firstPoint && !vessel.start.valid();
  const bool last = span.nextClass == shared::kNoSpan && !vessel.end.valid();
  return std::uint8_t((first ? 1u : 0u) | (last ? 2u : 0u));
}

// The nearest span of the other kind with trees, arteries' of veins' and the other way round.
void findPartners(const Network& network, const PosedNetwork& rest, float farthest, CapillarySites& sites) {
  const auto kindOf = [&](std::size_t span) { return network.vessels()[sites.spans[span].vessel].kind; };
  std::vector<vec3> middles(sites.spans.size());
  for (std::size_t i = 0; i < middles.size(); ++i) middles[i] = sectionOn(rest, sites.spans[i], 0.5f).centre;
  for (const auto& [own, other] :
       {std::pair(VesselKind::artery, VesselKind::vein), std::pair(VesselKind::vein, VesselKind::artery)}) {
    PointCloud cloud;
    std::vector<std::uint32_t> spans;
    for (std::uint32_t i = 0; i < middles.size(); ++i)
      if (sites.sites[i].sprouts > 0 && kindOf(i) == other)
        spans.push_back(i), cloud.points.push_back(middles[i]);
    if (spans.empty()) continue;
    PointTree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    tree.buildIndex();
    for (std::size_t i = 0; i < middles.size(); ++i) {
      if (sites.region[i] == 255 || kindOf(i) != own) continue;
      std::size_t index = 0;
      float distance2 = 0;
      nanoflann::KNNResultSet<float> nearest(1);
      nearest.init(&index, &distance2);
      tree.findNeighbors(nearest, &middles[i].x, nanoflann::SearchParams());
      if (distance2 < farthest * farthest) sites.sites[i].partner = spans[index];
    }
  }
}

}  // namespace

CapillarySites growthSites(const Scene& scene, const GrowthRules& rules,
                           const std::vector<GrowthRegion>& regions, const SweepTable& table, GrowthUse use) {
  const Network& network = scene.network;
  const SpineSet& spines = scene.binding.spines;
  std::vector<quat> frames(table.knotCount);
  networkFrames(network, network.points(), restReferences(network), frames);
  const PosedNetwork rest{table, network.points(), frames};
  const std::vector<Station> stations = mainStations(scene.binding);
  const float scale = scene.body.height() / kTableHeight;
  const std::vector<bool> drawn = drawnSpans(table);
  const std::vector<vec2> shown = shownStretches(network, table);
  CapillarySites sites{.spans = wholeSpans(network), .sites = {}, .freeEnds = {}, .region = {}};
  const std::size_t count = sites.spans.size();
  sites.sites.resize(count, {.partner = shared::kNoPartner});
  sites.freeEnds.resize(count);
  sites.region.assign(count, 255);
  parallelFor(count, 16, [&](std::size_t i) {
    const shared::SweepRecord& span = sites.spans[i];
    const Vessel& vessel = network.vessels()[span.vessel];
    const JointId joint = stations[span.point + 1].joint;
    const GrowthRegion* region = regionOf(
        regions, {vessel.name, vessel.ontologyId, scene.body.skeleton.joints[joint.value].name, vessel.kind});
    const Section section = sectionOn(rest, span, 0.5f);
    const bool grows = drawn[i] && region && region->system != GrowthRegion::kNoSystem &&
                       section.radius >= region->thinnest * scale &&
                       section.radius <= region->thickest * scale;
    const vec2 stretch = glm::clamp(shown[span.vessel] - float(span.point - span.firstPoint), 0.0f, 1.0f);
    if (!grows || stretch.y <= stretch.x) return;
    const shared::GrowthSystem& system = rules.tables.system[region->system];
    sites.freeEnds[i] = freeEndsOf(network, span);
    for (const std::uint8_t last : {0, 1})
      if (sectionOn(rest, span, last).radius * system.tipRadius > kThickTip * system.mostRadius)
        sites.freeEnds[i] = std::uint8_t(sites.freeEnds[i] & ~(1u << last));
    const Limb limb = limbAt(spines, joint, section.centre);
    vec3 hub = limb.centre;
    if (const JointId anchor = scene.body.skeleton.find(region->hubJoint);
        anchor.valid() && !region->hubJoint.empty())
      hub = vec3(scene.body.skeleton.joints[anchor.value].restWorld[3]) + scale * region->hubOffset;
    const mat3 axes(section.frame.u, section.frame.v, section.frame.tangent);
    const auto points = network.pointsOf(vessel);
    shared::GrowthSite& site = sites.sites[i];
    site.hub = glm::transpose(axes) * (hub - section.centre);
    site.axis = glm::transpose(axes) * limb.axis;
    site.system = region->system | (points.front().w < points.back().w ? 0x100u : 0u);
    site.stretch = stretch;
    site.key = keyOf(span.vessel, span.point - span.firstPoint);
    sites.region[i] = std::uint8_t(region - regions.data());
    const vec4 chord = rest.points[span.point + 2] - rest.points[span.point + 1];
    const float length = std::max(glm::length(vec3(chord)), 1e-5f) * (stretch.y - stretch.x);
    // What is left of a tree over the whole ones grows in as many spans as its share says.
    site.sprouts = std::uint32_t(
        std::min(length / (region->spacing * scale) + unitFloat(scramble(keyOf(7, site.key))), 4000.0f));
  });
  if (use == GrowthUse::drawn) {
    std::vector<std::uint8_t> grows(count);
    for (std::size_t i = 0; i < count; ++i) grows[i] = sites.region[i] != 255;
    measureRooms(scene.body, kMostReach * scale, rest, sites.spans, grows, sites.sites);
  }
  findPartners(network, rest, kPartnerFar * scale, sites);
  return sites;
}

Result<SceneGrowth> loadGrowth(const Scene& scene, const std::filesystem::path& folder) {
  return loadGrowth(scene, folder, makeSweepTable(scene.network));
}

Result<SceneGrowth> loadGrowth(const Scene& scene, const std::filesystem::path& folder,
                               const SweepTable& table, GrowthUse use) {
  auto growth = readGrowth(scene, folder);
  if (growth) settleGrowth(*growth, scene, table, use);
  return growth;
}

Result<SceneGrowth> readGrowth(const Scene& scene, const std::filesystem::path& folder) {
  SceneGrowth growth;
  auto rules = readGrowthRules(folder / "capillaries.lsys");
  if (!rules) return rules.error();
  auto regions = readRegions(folder / "regions.csv", *rules);
  if (!regions) return regions.error();
  growth.rules = std::move(*rules);
  growth.regions = std::move(*regions);
  const float scale = scene.body.height() / kTableHeight;
  for (shared::GrowthSystem& system : growth.rules.tables.system) system.mostRadius *= scale;
  return growth;
}

void settleGrowth(SceneGrowth& growth, const Scene& scene, const SweepTable& table, GrowthUse use) {
  growth.sites = growthSites(scene, growth.rules, growth.regions, table, use);
}

}  // namespace vasa
