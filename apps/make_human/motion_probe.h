#pragma once
#include "body/body.h"
#include "make_human/rig.h"
#include "network/network.h"

namespace vasa::human {

/// The body in memory as its file will have it.
Body bodyOf(const Rig& rig, std::vector<SkinnedMesh> meshes, std::vector<Clip> clips);

/// A place on a vessel that some pose brings out of the skin.
struct Escape {
  std::uint32_t vessel = 0;
  float share = 0;   ///< along the vessel, by its parameter
  float excess = 0;  ///< [m] from the nearest of the skin's vertices, the most in any pose
};

/// Looks at vessels in the poses of each of the body's clips that differ most from one another.
class MotionProbe {
 public:
  /// @param body  its first mesh is the skin
  explicit MotionProbe(Body body);

  /// Where centre lines leave the skin, at every half span; sorted by vessel, then share.
  Result<std::vector<Escape>> escapes(const Network& network) const;

 private:
  Body body_;
  std::vector<Pose> poses_;
};

}  // namespace vasa::human
