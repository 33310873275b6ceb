#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "body/rig.h"
#include "core/ids.h"

namespace vasa {

/// A rig's trunk, by how its joints hang together: what lies between hips and neck, whatever it is called.
struct Trunk {
  std::uint32_t hips = kNone;
  std::vector<std::uint32_t> joints;  ///< above the hips and below the neck, from low to high
  std::vector<std::uint32_t> ends;    ///< where it ends is the mean of these: the neck, or both shoulders
  std::vector<float> shares;          ///< of each joint: how far from hips to end it lies, along the joints

  void leaveOut(std::size_t index) {
    joints.erase(joints.begin() + std::ptrdiff_t(index)),
        shares.erase(shares.begin() + std::ptrdiff_t(index));
  }
  bool known() const { return hips != kNone && !ends.empty(); }
  vec3 end(std::span<const vec3> places) const;
  /// From hips to end.
  vec3 way(std::span<const vec3> places) const { return end(places) - places[hips]; }
};

/// Goes down from the neck, where there is none from where the arms meet, from the head, or from what names
/// call a spine, to the joint on which hips or legs hang. O(joints)
Trunk findTrunk(const Rig& rig);

/// The axis (0 to 2) along which the trunk lies at rest: 1, which is up, also where there is no trunk.
/// Patients lie at rest, and so does what was exported with another axis up.
int uprightAxis(const Rig& rig);

/// Names hips, spine, neck and head by how they hang together, where arms and legs are known and names tell
/// nothing of them, or only some of the spine. O(joints²)
void nameTrunk(Rig& rig);

}  // namespace vasa
