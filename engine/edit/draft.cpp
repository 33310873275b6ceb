#include "edit/draft.h"

#include <algorithm>

#include "core/letters.h"
#include "core/nearest_names.h"
#include "curve/arc_length.h"
#include "curve/fit.h"
#include "edit/bump.h"

namespace vasa {
namespace {

constexpr float kLeastMove = 1e-7f;  // [m] below which an end counts as where it was
constexpr int kMostFollowers = 100;  // generations of branches on branches that move along

// Moves an end by `way`, and the course behind it ever less. The other end stays.
void bendEnd(std::vector<vec4>& points, bool last, vec3 way) {
  const ArcLength arc(points);
  const float reach = std::min(arc.length(), 3 * glm::length(way));
  const std::uint32_t spans = spanCount(points);
  const std::vector<vec4> before = points;
  for (std::uint32_t j = 0; j < points.size(); ++j) {
    const bool fixed = j == (last ? 0 : points.size() - 1);
    const float along = arc.along(float(greville(j, spans)));
    const float off = last ? arc.length() - along : along;
    const float share = fixed || !(reach > 0) ? 0 : bump(off / reach);
    points[j] = before[j] + vec4(share * way, 0);
  }
  vec4& end = last ? points.back() : points.front();
  end = (last ? before.back() : before.front()) + vec4(way, 0);
}

}  // namespace

const vec4& endPoint(const Draft::Line& line, bool last) {
  return last ? line.points.back() : line.points.front();
}

Draft::Draft(const Network& network) : bodyHeight(network.bodyHeight()) {
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const auto own = network.pointsOf(vessel);
    lines.push_back({{vessel.name, vessel.ontologyId, vessel.kind}, {own.begin(), own.end()}, {v}});
  }
  for (const Node& node : network.nodes()) {
    const auto ends = network.ends(node);
    joints.push_back({node.host, {ends.begin(), ends.end()}});
  }
  patches.assign(network.patches().begin(), network.patches().end());
}

Result<Network> Draft::build(std::vector<VesselId>* origins) const {
  NetworkBuilder builder;
  std::vector<VesselId> number(lines.size());
  if (origins) origins->clear();
  for (std::size_t v = 0; v < lines.size(); ++v) {
    if (lines[v].gone) continue;
    number[v] = builder.addVessel(lines[v].label, lines[v].points);
    if (origins) origins->push_back(lines[v].origin);
  }
  for (const Joint& joint : joints) {
    std::optional<Host> host = joint.host;
    if (host) host->vessel = number[host->vessel.value];
    std::vector<VesselEnd> ends = joint.ends;
    for (VesselEnd& end : ends) end.vessel = number[end.vessel.value];
    builder.addNode(host, std::move(ends));
  }
  auto built = builder.build(bodyHeight);
  if (!built || patches.empty()) return built;
  std::vector<ForkPatch> kept = patches;
  for (ForkPatch& patch : kept)
    for (PatchRing& ring : patch.rings) ring.vessel = number[ring.vessel.value];
  return withPatches(std::move(*built), std::move(kept));
}

bool Draft::hasName(const std::string& name) const {
  return std::ranges::any_of(lines, [&](const Line& line) { return !line.gone && line.label.name == name; });
}

Result<VesselId> Draft::find(const std::string& name) const {
  const auto matching = [&](auto same) {
    std::vector<VesselId> found;
    for (std::uint32_t v = 0; v < lines.size(); ++v)
      if (!lines[v].gone && same(lines[v].label.name)) found.push_back({v});
    return found;
  };
  auto found = matching([&](const std::string& each) { return each == name; });
  if (found.empty())
    found =
        matching([wanted = lowerCase(name)](const std::string& each) { return lowerCase(each) == wanted; });
  if (found.size() == 1) return found.front();
  if (found.size() > 1)
    return badInput(std::to_string(found.size()) +
                    " vessels have this name; rename them in the source so that one is meant");
  std::vector<std::string> names;
  for (const Line& line : lines)
    if (!line.gone) names.push_back(line.label.name);
  return badInput("no vessel has this name; " +
                  didYouMean(name, names, "vasa info NET.vasa --vessels lists all"));
}

const Draft::Joint* Draft::jointOf(VesselEnd end) const {
  for (const Joint& joint : joints)
    if (std::ranges::find(joint.ends, end) != joint.ends.end()) return &joint;
  return nullptr;
}

Draft::Joint* Draft::jointOf(VesselEnd end) { return const_cast<Joint*>(std::as_const(*this).jointOf(end)); }

std::vector<std::string> Draft::hangingOn(VesselId vessel, float from, float to) const {
  std::vector<std::string> names;
  for (const Joint& joint : joints)
    if (joint.host && joint.host->vessel == vessel && joint.host->parameter >= from &&
        joint.host->parameter <= to)
      for (const VesselEnd& end : joint.ends) names.push_back(line(end.vessel).label.name);
  return names;
}

void Draft::redraw(VesselId vessel, std::vector<vec4> points, const PlaceMap& map, float changedFrom,
                   float changedTo) {
  std::erase_if(patches, [&](const ForkPatch& patch) {
    return std::ranges::any_of(patch.rings, [&](const PatchRing& ring) {
      return ring.vessel == vessel &&
             ((ring.parameter >= changedFrom && ring.parameter <= changedTo) || !map(ring.parameter));
    });
  });
  for (ForkPatch& patch : patches)
    for (PatchRing& ring : patch.rings)
      if (ring.vessel == vessel) {
        const Place place = *map(ring.parameter);
        ring.vessel = place.vessel, ring.parameter = place.parameter;
      }
  for (Joint& joint : joints)
    if (joint.host && joint.host->vessel == vessel)
      if (const auto place = map(joint.host->parameter)) joint.host = Host{place->vessel, place->parameter};
  line(vessel).points = std::move(points);
  line(vessel).touched = true;
  // What hangs on what has moved, generation after generation.
  std::vector<char> moved(lines.size(), 0);
  moved[vessel.value] = 1;
  bool any = true;
  for (int round = 0; any && round < kMostFollowers; ++round) {
    any = false;
    std::vector<char> next(lines.size(), 0);
    for (const Joint& joint : joints) {
      if (!joint.host || !moved[joint.host->vessel.value]) continue;
      const vec3 at(evaluate(line(joint.host->vessel).points, joint.host->parameter));
      for (const VesselEnd& end : joint.ends) {
        Line& branch = line(end.vessel);
        const vec3 way = at - vec3(endPoint(branch, end.last));
        if (!(glm::length(way) > kLeastMove)) continue;
        bendEnd(branch.points, end.last, way);
        branch.touched = true;
        dropPatchesOn(end.vessel);
        next[end.vessel.value] = 1, any = true;
      }
    }
    moved = std::move(next);
  }
}

void Draft::remove(VesselId vessel) {
  for (Joint& joint : joints)
    std::erase_if(joint.ends, [&](const VesselEnd& end) { return end.vessel == vessel; });
  std::erase_if(joints, [&](const Joint& joint) { return joint.host && joint.host->vessel == vessel; });
  dropPatchesOn(vessel);
  line(vessel).gone = true;
  dropEmptyJoints();
}

void Draft::dropPatchesOn(VesselId vessel) {
  std::erase_if(patches, [&](const ForkPatch& patch) {
    return std::ranges::find(patch.rings, vessel, &PatchRing::vessel) != patch.rings.end();
  });
}

void Draft::dropEmptyJoints() {
  std::erase_if(joints, [](const Joint& joint) {
    return joint.ends.empty() || (!joint.host && joint.ends.size() < 2);
  });
}

}  // namespace vasa
