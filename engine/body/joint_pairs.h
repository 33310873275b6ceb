#pragma once
#include <string>
#include <vector>

#include "body/trunk_spread.h"
#include "core/result.h"

namespace vasa {

/// What of a body follows what of a motion.
struct JointPairs {
  std::vector<std::uint32_t> source;  ///< one a joint of the body: the motion's joint, or JointId::kNone
  TrunkSpread spread;                 ///< joints of the trunk for which that is only the nearest one
};

/// Pairs joints as body/retarget.h says: by the map, the trunk by its order or by shares, the rest by names
/// and parts. Fails with badInput where the map names a joint that does not exist. O(joints²)
Result<JointPairs> pairJoints(const Rig& motion, const Rig& body, const JointMap& map,
                              const std::string& motionName, const std::string& bodyName);

}  // namespace vasa
