#pragma once
#include <span>
#include <vector>

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
  /// @param body  its first mesh is the skin, its second the bones
  explicit MotionProbe(Body body);

  /// Where centre lines leave the skin, at every half span; sorted by vessel, then share.
  Result<std::vector<Escape>> escapes(const Network& network) const;

  /// Vessels that a pose brings deeper into a bone than `depth` [m], with their centre lines, at every half
  /// span; by number, each once.
  Result<std::vector<VesselId>> throughBones(const Network& network, float depth) const;

 private:
  struct Place {
    std::uint32_t vessel;
    float share;  // along it
  };
  static std::vector<Place> halfSpans(const Network& network);
  /// visit(place's number, where it is, what the mesh encloses then, the mesh's corners then), in each pose;
  /// parallel.
  template <class Visit>
  Result<void> visitPoses(const Network& network, std::span<const Place> places, std::size_t mesh,
                          Visit visit) const;

  Body body_;
  std::vector<Pose> poses_;
};

}  // namespace vasa::human
