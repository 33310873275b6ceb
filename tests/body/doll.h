#pragma once
#include <optional>
#include <string>
#include <vector>

#include "body/body.h"

namespace vasa::test {

/// A person of twenty-three joints and what it does, told as others' files would: by their names, from their
/// zero pose, in their unit, with their axis up.
struct DollDialect {
  std::string family =
      "vrm";  ///< "cmu", "biovision", "mixamo", "vrm", "makehuman", "bip", "daz", "smpl", "numbered"
  enum class Zero { t, a, i, oneAxis, toesHang } zero = Zero::t;
  double unitsAMetre = 1;
  bool zUp = false;          ///< the whole file, rest and motion
  bool rootTurnsUp = false;  ///< the zero pose stands along +Y, the root's turns lay it along +Z
  float facing = 0;          ///< degrees about +Y by which the zero pose looks aside
  /// Without joints at the wrists: an End Site is there, or not even that.
  enum class Arms { whole, endAtWrist, endAtElbow } arms = Arms::whole;
  bool sword = false;  ///< two more joints in the right hand
  /// Its lower foot stays where it stands, but for this part of the way; else it glides along.
  std::optional<float> glides = {};
  double rootTimes = 1;  ///< the root's places are so many times as large as in the unit
};

struct DollPart {
  std::string part;  ///< "hips", "leftUpperArm" ... (body/humanoid.h); ends of tips have none
  int parent;
  vec3 place;  ///< in the T pose [m]
};
const std::vector<DollPart>& dollParts();
std::string dollName(const std::string& part, const std::string& family);

/// Which way a limb's bone points in a frame of the performance: walking, turning, leaning, arms that swing
/// and bend.
vec3 dollDirection(const std::string& part, int frame);
constexpr int kDollFrames = 24;

/// The performance as a .bvh file.
std::string dollMotion(const DollDialect& dialect, int frames = kDollFrames);

/// A body that stands with its arms lowered by 40 degrees, with these names; no meshes.
Body dollBody(const std::string& family);

}  // namespace vasa::test
