#pragma once
#include <span>
#include <vector>

#include "plate/seen_map.h"

namespace vasa::plate {

/// The hollow that bones of a head enclose. A place lies in it where bone is between it and the outside in
/// all but a sixth of the directions, as everywhere in the braincase, through whose holes little is seen, and
/// neither in an orbit nor under the base of the skull, and no bone between it and the hollow's middle, as
/// there is of the jaw's canals. Without bones no place does.
///
///   const Braincase braincase(skull.mesh.positions, skull.mesh.triangles);
///   if (braincase.holds(place)) ...
class Braincase {
 public:
  /// @param triangles  counter-clockwise from outside. O(directions x triangles): 0.2 s
  Braincase(std::span<const vec3> positions, std::span<const uvec3> triangles);
  /// O(directions)
  bool holds(vec3 place) const;

 private:
  int directionsHidden(vec3 place) const;
  std::vector<SeenMap> fromOutside_, fromMiddle_;
};

}  // namespace vasa::plate
