#pragma once
#include <span>
#include <vector>

#include "body/body.h"
#include "body/rig.h"
#include "body/skin_shell.h"

namespace vasa {

/// A body's skin without some limbs, as the boundary of the flesh that another limb should stay out of. It is
/// looked up at rest: a place in a pose is taken back by each of the joints that the skin follows, and the
/// skin that is nearest there counts where that joint moves it.
class Flesh {
 public:
  /// @param leftOut  one a joint: 1 where what follows it is none of the flesh
  Flesh(const Body& body, const SkinnedMesh& skin, const std::vector<char>& leftOut);

  /// From a pose back to rest, as each of the joints moves the flesh.
  std::vector<mat4> toRest(const Pose& pose) const;

  struct Depth {
    float depth = -1e9f;  ///< [m] below the skin; outside it is negative, and at least as far away
    vec3 outwards{0};     ///< from there, unit, in the pose
  };
  /// O(log triangles) where a joint's skin is near.
  Depth look(std::span<const mat4> toRest, vec3 place) const;
  /// Depths of places that lie near one another: joints far from all of them are looked at once.
  std::vector<float> depths(std::span<const mat4> toRest, std::span<const vec3> places) const;

 private:
  struct Host {
    std::uint32_t joint;
    Aabb box;  // of what it moves, at rest
    mat4 restWorld{1};
  };
  float weightOf(std::uint32_t joint, std::uint32_t triangle) const;
  void lookFrom(std::size_t host, const mat4& toRest, vec3 place, Depth& found) const;

  std::vector<SkinInfluence> influences_;
  SkinShell shell_;
  std::vector<Host> hosts_;
};

/// A limb as places on its skin, and the joint at shoulder or hip that moves all of them: lower arm and hand;
/// lower leg, foot and the half of the thigh at the knee (the other half touches the other thigh in most
/// people).
struct LimbPlaces {
  struct Place {
    uvec3 corners;  ///< of a triangle of the skin
    vec3 shares;
  };
  JointId top, other;  ///< other: of the limb on the other side
  std::vector<Place> places;
  std::vector<float> atRest;  ///< [m] how deep each is in the flesh there

  std::vector<vec3> posed(const SkinnedMesh& skin, std::span<const mat4> skinMatrices) const;
};

/// Left and right; without those that the rig does not know (body/rig.h).
std::vector<LimbPlaces> armPlaces(const Body& body, const SkinnedMesh& skin, const Rig& rig);
std::vector<LimbPlaces> legPlaces(const Body& body, const SkinnedMesh& skin, const Rig& rig);

/// One a joint: 1 where it hangs on one of these.
std::vector<char> hangingOn(const Rig& rig, std::span<const LimbPlaces> limbs);

}  // namespace vasa
