#pragma once
#include <optional>
#include <vector>

#include "network/network.h"

namespace vasa {

/// A vessel that leaves a fork.
struct ForkArm {
  VesselId vessel;
  bool last = false;  ///< it is the vessel's end that is here
  bool host = false;  ///< the part of the host that goes on behind the fork
  float radius = 0;   ///< [m]
  float angle = 0;    ///< [radians] that it turns off the trunk's course
};

/// Where three arms and more meet: the trunk and what leaves it. All is taken a trunk's diameter away from
/// the node, where the vessels have parted, or in the middle of shorter ones.
struct ForkMeasures {
  NodeId node;
  VesselId trunk;            ///< the host, or the vessel that ends here; of several the widest
  float trunkParameter = 0;  ///< u of the node on it
  float trunkRadius = 0;     ///< [m]
  std::vector<ForkArm> arms;
  /// x of trunk^x = sum of arms^x (Murray 1926: 3); none where an arm is as wide as the trunk.
  std::optional<float> murray;
};

/// The forks of a network, in the order of its nodes. O(nodes), and what the forks take
/// @param points  as Network::points()
/// @param trunk   those alone that this vessel is the trunk of
std::vector<ForkMeasures> measureForks(const Network& network, std::span<const vec4> points,
                                       std::optional<VesselId> trunk = {});

/// The exponent alone, to a thousandth; none where there is none from 0.5 to 20.
std::optional<float> murrayExponent(float trunk, std::span<const float> arms);

}  // namespace vasa
