#pragma once
#include <optional>

#include "avoid/interference.h"
#include "network/network.h"

namespace vasa {

/// What can be measured of one vessel in one shape.
struct VesselMeasures {
  float length = 0;                                           ///< [m]
  float volume = 0;                                           ///< [m³]
  float leastRadius = 0, meanRadius = 0, greatestRadius = 0;  ///< [m], the mean along the length
  float greatestCurvature = 0;                                ///< [1/m] of the centre line
  std::optional<float> clearance;  ///< [m] to the nearest tube of another vessel that is no neighbour
                                   ///< along the network (collide/neighbours.h); negative: into it
};

/// Of one vessel's de Boor points; clearance is not looked for. O(spans).
VesselMeasures measureVessel(std::span<const vec4> points);

/// Measures every vessel of a network, frame after frame.
class VesselMeter {
 public:
  /// @param network  must outlive this
  /// @param within   [m] clearances beyond this are not looked for
  VesselMeter(const Network& network, float within);

  /// @param points  as Network::points()
  std::vector<VesselMeasures> run(std::span<const vec4> points);

 private:
  const Network* network_;
  float within_;
  Interference interference_;
};

}  // namespace vasa
