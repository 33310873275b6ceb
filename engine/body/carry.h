#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "body/body.h"
#include "body/humanoid.h"
#include "core/result.h"
#include "network/network.h"

namespace vasa {

/// A network in another body.
struct CarriedNetwork {
  std::vector<vec4> points;  ///< as Network::points(), ends on their nodes
  float bodyHeight = 0;      ///< [m] of the other body
  std::uint32_t jointsMatched = 0;
  std::vector<std::string> jointsFree;  ///< of the first body: they go with the joint before them
  /// "left leg", "head": of the first body, where no joint of the second answers; and the vessels of which
  /// a quarter or more lies there. They are pressed into what is next to it.
  std::vector<std::string> limbsMissing, vesselsPressed;
  float radiusFactor = 1;  ///< all radii were multiplied by this
  /// Points that the skin's shape alone would have left outside, or too near.
  std::uint32_t pushedIn = 0;
};

/// Carries a network from the body it lies in to another with matching joints (matched as in
/// body/retarget.h).
///
/// Method: the first body is bound to its vessels and posed as the other one stands at rest, so that limbs
/// bend as in any motion. Then each joint's surroundings are stretched along its link and across it so that
/// joints come to lie on joints, blended by the same shares; joints of the trunk, of a limb and of a palm
/// that would stretch a part of it by over 15 % beside the whole are left out, and a pelvis is where the legs
/// hang on it, wherever the joint of the hips is. Where the bones of both bodies tell twelve pairs of ribs,
/// their heads come to lie near one another's height, with what is around them (inverse distances, Shepard
/// 1968). Last, where both have a skin, what lies between the first one's (carried the same way) and the
/// other's nearest skin is spread into the body, more the nearer a point is to it, and points that are then
/// less deep below it than they were (and than their radius) are moved in, their neighbours along the vessel
/// with them. Radii change as the skeletons' sizes do.
///
/// Fails with badInput as binding does, and where the joints do not match.
/// @param name  of the network, for messages
/// @param map   joints of the second body -> joints of the first
/// O(points · (joints + skin samples)).
Result<CarriedNetwork> carryNetwork(const Network& network, const Body& from, const Body& to,
                                    std::string_view name, const JointMap& map = {});

/// How much of a network's length lies outside a body's skin at rest.
struct SkinReport {
  struct VesselShare {
    VesselId vessel;
    double length = 0, outside = 0;  ///< [m]
    float farthest = 0;              ///< [m]
  };
  double length = 0, outside = 0;    ///< [m] of centre lines
  double outside5mm = 0;             ///< [m] of it by more than 5 mm
  std::vector<VesselShare> vessels;  ///< those with a part outside, the longest part first
};

/// Looks at each span in four places. Empty where the body has no skin.
SkinReport measureOutside(const Network& network, std::span<const vec4> points, const Body& body);
SkinReport measureOutside(const Network& network, std::span<const vec4> points, TriangleMesh skin);

}  // namespace vasa
