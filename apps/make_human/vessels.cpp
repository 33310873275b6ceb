#include "make_human/vessels.h"

#include "core/log.h"
#include "make_human/layout.h"
#include "make_human/rest_faults.h"

namespace vasa::human {
namespace {

constexpr int kSinkings = 2, kPrunings = 6, kRefinements = 10;
constexpr float kAllowedOut = 0.2e-3f;   // [m] of a centre line, in the poses looked at
constexpr float kAllowedInBone = 4e-3f;  // [m] of a grown one's; less is put right as the vessels move
// Chord over length of a grown one: straighter ones look like hairs. 0.98 once coordinates are rounded.
constexpr float kStraightest = 0.979f;
constexpr float kDeeper = 2.5e-3f;     // [m] than would just do
constexpr float kDeepestSink = 6e-3f;  // at a time

Result<void> sinkEscapes(VesselLayout& layout, const MotionProbe& probe, float bodyHeight) {
  layout.settle();
  for (int round = 0; round < kSinkings; ++round) {
    const Result<Network> network = joinVessels(layout.fitted(), bodyHeight);
    if (!network.ok()) return network.error();
    const Result<std::vector<Escape>> escapes = probe.escapes(*network);
    if (!escapes.ok()) return escapes.error();
    bool any = false;
    for (const Escape& escape : *escapes)
      if (escape.excess > kAllowedOut) {
        layout.sink(escape.vessel, escape.share, std::min(escape.excess + kDeeper, kDeepestSink));
        any = true;
      }
    if (!any) break;
    layout.settle();
  }
  return {};
}

/// Fits anew, more closely, what the fit to the courses made to run through another.
Result<std::vector<LaidVessel>> fittedApart(VesselLayout& layout, float bodyHeight) {
  for (int round = 0;; ++round) {
    std::vector<LaidVessel> vessels = layout.fitted();
    const Result<Network> network = joinVessels(vessels, bodyHeight);
    if (!network.ok()) return network.error();
    bool any = false;
    if (round < kRefinements)
      for (const VesselId vessel : restFaults(*network)) any |= layout.refine(vessel.value);
    if (!any) return vessels;
  }
}

/// As fitted and joined: a short branch's curve can be lost within the fit's tolerance, or as its end moves
/// onto its host. What grew on it goes with it.
bool isStraight(std::span<const vec4> points) {
  return glm::distance(vec3(points.front()), vec3(points.back())) > kStraightest * lengthOf(points);
}

Result<void> prune(Grower& grower, const std::vector<LaidVessel>& vessels, const MotionProbe& probe,
                   float bodyHeight) {
  for (int round = 0; round < kPrunings; ++round) {
    grower.run();
    const Result<Network> network = joinVessels(vessels, bodyHeight);
    if (!network.ok()) return network.error();
    const Result<std::vector<Escape>> escapes = probe.escapes(*network);
    if (!escapes.ok()) return escapes.error();
    bool any = false;
    for (const Escape& escape : *escapes)
      if (escape.excess > kAllowedOut) any |= grower.remove(int(escape.vessel));
    const Result<std::vector<VesselId>> throughBones = probe.throughBones(*network, kAllowedInBone);
    if (!throughBones.ok()) return throughBones.error();
    for (const VesselId vessel : *throughBones) any |= grower.remove(int(vessel.value));
    for (const VesselId vessel : restFaults(*network)) any |= grower.remove(int(vessel.value));
    for (std::size_t i = 0; i < vessels.size(); ++i)
      any |= isStraight(network->pointsOf(network->vessels()[i])) && grower.remove(int(i));
    if (!any) break;
  }
  return {};
}

/// What the table's vessels could not be freed of.
void warnOfFaults(const Network& network) {
  for (const VesselId vessel : restFaults(network))
    logWarning("vessels.csv: '" + network.vessel(vessel).name +
               "' kinks or touches another vessel at rest; move its waypoints");
}

}  // namespace

Result<Network> makeVessels(const std::filesystem::path& tables, const Rig& rig, const Surroundings& around,
                            std::span<const BoneForm> organs, const MotionProbe& probe, float bodyHeight,
                            const GrowOptions& options) {
  Result<VesselRows> rows = VesselRows::read(tables / "vessels.csv", rig);
  if (!rows.ok()) return rows.error();
  const Result<std::vector<Region>> regions = readRegions(tables / "growth.csv", *rows, rig, organs);
  if (!regions.ok()) return regions.error();
  Result<VesselLayout> layout = VesselLayout::make(*rows, around);
  if (!layout.ok()) return layout.error();
  if (const Result<void> sunk = sinkEscapes(*layout, probe, bodyHeight); !sunk.ok()) return sunk.error();
  Result<std::vector<LaidVessel>> fitted = fittedApart(*layout, bodyHeight);
  if (!fitted.ok()) return fitted.error();
  std::vector<LaidVessel> vessels = std::move(fitted).value();
  Grower grower(vessels, *regions, around, options);
  if (const Result<void> pruned = prune(grower, vessels, probe, bodyHeight); !pruned.ok())
    return pruned.error();
  Result<Network> network = joinVessels(grower.finish(), bodyHeight);
  if (network.ok()) warnOfFaults(*network);
  return network;
}

}  // namespace vasa::human
