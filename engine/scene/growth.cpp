#include "scene/growth.h"

#include <algorithm>
#include <cmath>

#include "body/point_tree.h"
#include "body/skin_field.h"
#include "curve/bezier.h"
#include "growth/random.h"
#include "surface/tessellate.h"

namespace vasa {
namespace {

constexpr float kTableHeight = 1.75f;  // [m] of the body that the tables' lengths are for
constexpr float kBelowSkin = 0.8f;     // share of the way to the skin that capillaries may take
constexpr float kFan = 0.1f;          // cosine of the angle about the hub that a tree may spread to
constexpr float kMargin = 0.03f;       // and this share of kFarFromSkin less
constexpr float kSunken = 0.6f;        // share of the way to the hub that a tree may be kept below its vessel
constexpr float kThickTip = 1.6f;      // most radii of a stem that a free end may go on in: thicker ones were cut off
constexpr float kReach = 3.0f;         // of a tree, in distances between vessel and skin
constexpr float kFarFromSkin = 0.06f;  // [m] room where the body has no skin

// How far the skin is.
class SkinDepth {
 public:
  explicit SkinDepth(const Body& body) {
    if (const SkinnedMesh* skin = skinOf(body)) cloud_.points = skin->mesh.positions;
    if (!cloud_.points.empty()) {
      tree_.emplace(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(16));
      tree_->buildIndex();
    }
  }
  // From a vessel at p outwards from the hub. Growing knows one depth of skin about the hub, and a limb is not round: it is
  // the least within a tree's reach. Below 0 where that lies deeper than the vessel.
  float room(vec3 p, vec3 hub, float otherwise) const {
    if (!tree_) return otherwise;
    std::size_t index = 0;
    float distance2 = 0;
    nanoflann::KNNResultSet<float> nearest(1);
    nearest.init(&index, &distance2);
    tree_->findNeighbors(nearest, &p.x, nanoflann::SearchParams());
    const float nearby = std::sqrt(distance2), reach = kReach * nearby + 0.2f * otherwise;
    const vec3 arm = p - hub;
    const float shell = glm::length(arm);
    float depth = shell + nearby;
    std::vector<std::pair<unsigned, float>> around;
    tree_->radiusSearch(&p.x, reach * reach, around, nanoflann::SearchParams());
    for (const auto& [vertex, unused] : around) {
      const vec3 to = cloud_.points[vertex] - hub;
      const float height = glm::length(to);
      if (glm::dot(to, arm) > kFan * height * shell) depth = std::min(depth, height);
    }
    return std::max(kBelowSkin * (depth - shell) - kMargin * otherwise, -kSunken * shell);
  }

 private:
  PointCloud cloud_;
  std::optional<PointTree> tree_;
};

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
  const float along = std::clamp(glm::dot(p - link->centre, link->axis), 0.0f, tip ? 2 * link->link : link->link);
  return {link->centre + along * link->axis, link->axis};
}

std::vector<std::uint8_t> freeEndsOf(const Network& network, const SweepTable& table) {
  std::vector<std::uint8_t> ends(table.sweeps.size());
  for (const CapEnd& cap : table.caps) {
    const Vessel& vessel = network.vessels()[table.vesselOfSweep[cap.sweep]];
    const shared::SweepRecord& record = table.sweeps[cap.sweep];
    const bool atEnd = cap.last ? record.nextClass == shared::kNoSpan && record.to == 1
                                : record.point == record.firstPoint && record.from == 0;
    const NodeId node = cap.last ? vessel.end : vessel.start;
    if (atEnd && !node.valid()) ends[cap.sweep] = std::uint8_t(ends[cap.sweep] | (cap.last ? 2u : 1u));
  }
  return ends;
}

}  // namespace

CapillarySites growthSites(const Scene& scene, const GrowthRules& rules, const std::vector<GrowthRegion>& regions) {
  const Network& network = scene.network;
  const SpineSet& spines = scene.binding.spines;
  const SweepTable table = makeSweepTable(network);
  std::vector<quat> frames(table.knotCount);
  const auto references = restReferences(network);
  networkFrames(network, network.points(), references, frames);
  const PosedNetwork rest{table, network.points(), frames};
  const std::vector<Station> stations = mainStations(scene.binding);
  const SkinDepth skin(scene.body);
  const float scale = scene.body.height() / kTableHeight;
  CapillarySites sites;
  sites.freeEnds = freeEndsOf(network, table);
  const std::size_t count = table.sweeps.size();
  sites.sites.resize(count);
  sites.sprouts.resize(count);
  sites.region.assign(count, 255);
  for (std::uint32_t sweep = 0; sweep < count; ++sweep) {
    const Vessel& vessel = network.vessels()[table.vesselOfSweep[sweep]];
    const std::uint32_t middle = table.sweeps[sweep].point + 1;
    const JointId joint = stations[middle].joint;
    const GrowthRegion* region = regionOf(regions, {vessel.name, vessel.ontologyId, scene.body.skeleton.joints[joint.value].name, vessel.kind});
    const Section section = sectionOn(rest, sweep, 0.5f);
    const bool grows = region && region->system != GrowthRegion::kNoSystem &&
                       section.radius >= region->thinnest * scale && section.radius <= region->thickest * scale;
    if (!grows) {
      sites.freeEnds[sweep] = 0;
      continue;
    }
    const shared::GrowthSystem& system = rules.tables.system[region->system];
    for (const std::uint8_t last : {0, 1})
      if (sectionOn(rest, sweep, last).radius * system.tipRadius > kThickTip * system.mostRadius)
        sites.freeEnds[sweep] = std::uint8_t(sites.freeEnds[sweep] & ~(1u << last));
    const Limb limb = limbAt(spines, joint, section.centre);
    vec3 hub = limb.centre;
    if (const JointId anchor = scene.body.skeleton.find(region->hubJoint); anchor.valid() && !region->hubJoint.empty())
      hub = vec3(scene.body.skeleton.joints[anchor.value].restWorld[3]) + scale * region->hubOffset;
    const mat3 axes(section.frame.u, section.frame.v, section.frame.tangent);
    const auto points = network.pointsOf(vessel);
    shared::GrowthSite& site = sites.sites[sweep];
    site.hub = glm::transpose(axes) * (hub - section.centre);
    site.axis = glm::transpose(axes) * limb.axis;
    site.room = skin.room(section.centre, hub, kFarFromSkin * scale);
    site.system = region->system | (points.front().w < points.back().w ? 0x100u : 0u);
    sites.region[sweep] = std::uint8_t(region - regions.data());
    const vec4 chord = rest.points[table.sweeps[sweep].point + 2] - rest.points[table.sweeps[sweep].point + 1];
    const shared::SweepRecord& record = table.sweeps[sweep];
    const float length = std::max(glm::length(vec3(chord)), 1e-5f) * (record.to - record.from);
    // What is left of a tree over the whole ones grows in as many sweeps as its share says.
    sites.sprouts[sweep] = std::uint16_t(std::min(length / (region->spacing * scale) + unitFloat(scramble(keyOf(7, sweep))), 4000.0f));
  }
  return sites;
}

Result<SceneGrowth> loadGrowth(const Scene& scene, const std::filesystem::path& folder) {
  SceneGrowth growth;
  auto rules = readGrowthRules(folder / "capillaries.lsys");
  if (!rules) return rules.error();
  auto regions = readRegions(folder / "regions.csv", *rules);
  if (!regions) return regions.error();
  growth.rules = std::move(*rules);
  growth.regions = std::move(*regions);
  const float scale = scene.body.height() / kTableHeight;
  for (shared::GrowthSystem& system : growth.rules.tables.system) system.mostRadius *= scale;
  growth.sites = growthSites(scene, growth.rules, growth.regions);
  return growth;
}

}  // namespace vasa
