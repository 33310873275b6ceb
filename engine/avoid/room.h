#pragma once
#include <span>
#include <vector>

#include "avoid/bones.h"
#include "avoid/interference.h"

namespace vasa {

/// A stretch of a vessel as places along its centre line, evenly by parameter.
struct StretchLine {
  std::vector<vec3> places;
  std::vector<std::uint32_t> tubes;  ///< on which the places lie
  std::uint32_t nearest(vec3 p) const;  ///< place, by number. O(places)
};

/// How much room bones and other vessels leave for a stretch. Each may come as near as it does at rest.
class Room {
 public:
  /// The vessels are interference.tubes(); those of the stretch and their neighbours along it are not in the way.
  /// @param reach  [m] from the line within which room is asked for
  Room(const Bones& bones, const Interference& interference, const StretchLine& line, float reach);

  /// The radius of the largest ball with room there [m], up to `wanted`; below 0 inside of something.
  /// @param tube  of the stretch that is to go there
  float at(vec3 place, float wanted, std::uint32_t tube) const;
  /// The way to more room, unit; 0 where there is none. Differences over a tenth of a millimetre.
  vec3 slope(vec3 place, float wanted, std::uint32_t tube) const;

 private:
  struct Ball {
    vec3 centre;
    float radius;
  };
  void addTube(const Bezier& tube, float allowed);

  const Bones* bones_;
  std::uint32_t firstTube_ = 0;
  std::vector<std::vector<float>> allowed_;  // of each tube of the stretch, one a part
  std::vector<Ball> balls_;                  // of other vessels
};

}  // namespace vasa
