#include "make_human/rest_faults.h"

#include <algorithm>

#include "collide/network_tubes.h"
#include "collide/tube_detector.h"
#include "network/kinks.h"

namespace vasa::human {
namespace {

constexpr float kMargin = 0.05e-3f;  // [m] between walls, so that rounding does not close the gap

bool shareFork(const Network& network, VesselId a, VesselId b) {
  if (a == b) return true;
  for (const Node& node : network.nodes()) {
    const auto ends = network.ends(node);
    const auto there = [&](VesselId vessel) {
      return (node.host && node.host->vessel == vessel) ||
             std::any_of(ends.begin(), ends.end(), [&](const VesselEnd& end) { return end.vessel == vessel; });
    };
    if (there(a) && there(b)) return true;
  }
  return false;
}

}  // namespace

std::vector<VesselId> restFaults(const Network& network) {
  const NetworkTubes layout(network);
  std::vector<Bezier> tubes(layout.count());
  layout.shape(network.points(), tubes);
  TubeDetector detector(tubes, layout.neighbours().exclusions());
  detector.update(tubes, kMargin);
  std::vector<VesselId> found;
  for (const TubePair& pair : detector.detect()) {
    const VesselId a = layout.address(pair.i).vessel, b = layout.address(pair.j).vessel;
    if (!shareFork(network, a, b)) found.insert(found.end(), {a, b});
  }
  for (std::uint32_t i = 0; i < layout.count(); ++i)
    if (kinks(tubes[i])) found.push_back(layout.address(i).vessel);
  std::sort(found.begin(), found.end(), [](VesselId a, VesselId b) { return a.value < b.value; });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace vasa::human
