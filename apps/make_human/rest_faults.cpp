#include "make_human/rest_faults.h"

#include <algorithm>

#include "collide/network_tubes.h"
#include "collide/tube_detector.h"
#include "network/kinks.h"

namespace vasa::human {
namespace {

constexpr float kMargin = 0.05e-3f;  // [m] between walls, so that rounding does not close the gap

}  // namespace

std::vector<VesselId> restFaults(const Network& network) {
  const NetworkTubes layout(network);
  std::vector<Bezier> tubes(layout.count());
  layout.shape(network.points(), tubes);
  TubeDetector detector(tubes, layout.neighbours());
  detector.update(tubes, kMargin);
  std::vector<VesselId> found;
  for (const TubePair& pair : detector.detect()) {
    found.push_back(layout.address(pair.i).vessel);
    found.push_back(layout.address(pair.j).vessel);
  }
  for (std::uint32_t i = 0; i < layout.count(); ++i)
    if (kinks(tubes[i])) found.push_back(layout.address(i).vessel);
  std::sort(found.begin(), found.end(), [](VesselId a, VesselId b) { return a.value < b.value; });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace vasa::human
