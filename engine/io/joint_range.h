#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "body/joint_angles.h"

namespace vasa {

/// One way in which a part of the body moves, and how far.
struct JointRange {
  enum class Motion : std::uint8_t { flexion, abduction, twist };

  std::string name;  ///< "left knee flexion"
  std::string part;  ///< as JointAngles::part
  Motion motion = Motion::flexion;
  float low = 0, high = 0;  ///< [rad] from rest, which is between them

  JointAngles at(float angle) const;
};

/// Reads a table like data/realism/ranges.csv; what is on the left follows for the right, too. Fails with io
/// or badInput that names file, line and cause.
Result<std::vector<JointRange>> readJointRanges(const std::filesystem::path& path);

}  // namespace vasa
