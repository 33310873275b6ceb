#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "body/joint_angles.h"

namespace vasa {

/// What is measured of a stretch of vessels.
enum class PoseMetric : std::uint8_t {
  lengthChange,        ///< [%] of the length in the first pose
  lengthChangeMm,      ///< [mm]
  greatestShortening,  ///< [%] of the 10 mm that shortened most since rest
  twist,               ///< [degrees] of the whole stretch since rest, without sign
  twistPerCm,          ///< [degrees/cm] the same by its length
  greatestTwistPerCm,  ///< [degrees/cm] of the 10 mm that twisted most
  curvatureChange,     ///< [1/cm] of the mean curvature
  curvatureChangePercent,
  leastBendRadius,     ///< [mm] in the second pose
  chordByArc,          ///< [%] in the second pose
  boneDistanceChange,  ///< [mm] from the wall to the nearest bone, at a level of the shin or, without one,
                       ///< where it is least
  forkAngleChange,     ///< [%] of the angle between two branches
  radiusChange,        ///< [%] of the mean lumen
};

/// One published figure and how to take it here.
struct ProtocolRow {
  std::string id;
  std::string from, to;                 ///< landmarks (realism/vessel_path.h)
  float firstShare = 0, lastShare = 1;  ///< of the stretch between them
  std::string firstPose, lastPose;
  PoseMetric metric = PoseMetric::lengthChange;
  std::optional<float> level;  ///< [m] boneDistanceChange: up from the knee's joint line, along the shin
  float mean = 0;
  std::optional<float> deviation;  ///< standard deviation among people
  std::optional<float> low, high;  ///< range that was seen
  bool blind = false;              ///< not looked at while the model was tuned
  std::string source, note;
};

/// A joint's angle from one end to the other, and what is drawn over it.
struct ProtocolSweep {
  std::string name, pose, from, to;
  PoseMetric metric = PoseMetric::lengthChange;
  float degrees = 0;  ///< the angle that the pose ends with
};

/// The readable tables of data/realism.
struct Protocol {
  std::map<std::string, std::vector<JointAngles>, std::less<>> poses;
  std::vector<ProtocolRow> rows;
  std::vector<ProtocolSweep> sweeps;
};

std::string_view metricName(PoseMetric metric);
std::string_view unitOf(PoseMetric metric);

/// Reads poses.csv, protocol.csv and sweeps.csv of a folder. Fails with io or badInput that names file, line
/// and cause.
Result<Protocol> readProtocol(const std::filesystem::path& folder);

}  // namespace vasa
