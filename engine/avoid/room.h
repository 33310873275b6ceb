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
  /// @param aside   [m] from the line, within which room is asked for
  /// @param widest  [m] the most that is asked for
  Room(const Bones& bones, const Interference& interference, const StretchLine& line, float aside, float widest);

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
  struct Part {
    std::uint32_t number;
    std::vector<float> allowed;  // of each tube of the stretch
  };
  void addTube(const Bezier& tube, float allowed);
  void addBall(const Ball& ball);
  std::span<const std::uint32_t> ballsNear(vec3 place) const;

  const Bones* bones_;
  float widest_;
  std::uint32_t firstTube_ = 0;
  std::vector<Part> parts_;
  std::vector<Ball> balls_;  // of other vessels
  // A grid; a cell has the balls that any place in it may be near.
  Aabb box_;
  ivec3 counts_{0};
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace vasa
