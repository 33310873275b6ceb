#pragma once
#include "make_human/table.h"
#include "math/types.h"

namespace vasa::human {

/// A joint, or a named point that hangs on one (a finger's tip, a toe's).
struct RigPoint {
  std::string name;
  int parent = -1;   ///< into Rig::points
  int towards = -1;  ///< the point that ends this link; -1 at a landmark
  int joint = -1;    ///< number among the joints; at a landmark, its joint's number
  bool landmark = false;
  bool right = false;   ///< a mirrored row
  vec3 position{0};     ///< [m] rest pose
  vec3 bendTowards{0};  ///< where flexion takes the link
  float skinBlend = 0;  ///< [m] the skin passes from the parent's link to this one within +- this length
};

enum class Side { middle, left, right };

/// The skeleton at rest, read from joints.csv. Rows of the left side are mirrored to the right.
class Rig {
 public:
  static Result<Rig> read(const std::filesystem::path& path);

  std::vector<RigPoint> points;
  std::vector<int> joints;  ///< points that are joints, parents first

  int find(std::string_view name) const;  ///< -1: none
  vec3 linkDirection(int point) const;    ///< unit, from a joint to the end of its link
  /// A place on the body, `Joint[>Point][:fraction[:(dx dy dz)]]`: a share of the way along a joint's link
  /// (or to the given point), then an offset in millimetres in body axes. On the right side the names and dx
  /// are mirrored.
  Result<vec3> place(std::string_view text, Side side) const;
  /// Such places, separated by `;`.
  Result<std::vector<vec3>> places(std::string_view text, Side side) const;
};

/// "LeftHand" -> "RightHand", "LThumb" -> "RThumb"; other names stay.
std::string mirroredName(std::string_view name);
inline vec3 mirrored(vec3 v) { return {-v.x, v.y, v.z}; }
/// `LR` -> left and right, `L`, `R`, anything else -> middle.
std::vector<Side> sidesOf(std::string_view cell);

}  // namespace vasa::human
