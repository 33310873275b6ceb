#pragma once
#include <span>
#include <vector>

#include "solids/bones.h"

namespace vasa {

/// A body's skin as a wall that vessels stay inside of. Places of tubes that lay near the skin at rest are
/// held by the triangle that was nearest then, wherever the pose has it: as deep below its plane as their
/// radius, or as they were at rest where that was less. The skin is linearly blended, as it is drawn.
class SkinWall {
 public:
  /// @param restTubes  of the network
  /// O(tubes log triangles), in parallel
  SkinWall(const Body& body, std::span<const Bezier> restTubes);

  /// @param jointMatrices  a joint's world · inverseBind
  void pose(std::span<const mat4> jointMatrices);

  /// Appends the places that are through the skin, sorted by tube and parameter.
  /// O(places)
  /// @param part  what to call the skin in BoneContact::part
  void addContacts(std::span<const Bezier> tubes, std::uint32_t part,
                   std::vector<BoneContact>& contacts) const;

 private:
  struct Place {
    std::uint32_t tube;
    float s, allowed;
    uvec3 triangle;
    vec3 point{0}, inwards{0};  // of the plane, in the pose
  };
  SkinnedMesh skin_;  // positions and influences
  std::vector<Place> places_;
};

}  // namespace vasa
