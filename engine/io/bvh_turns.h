#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "body/motion.h"

namespace vasa {

enum class BvhChannel : std::uint8_t { x, y, z, turnX, turnY, turnZ };

/// A way to read a joint's three turns.
struct BvhTurns {
  std::array<int, 3> axes;  ///< 0 x, 1 y, 2 z
  bool columns;             ///< the columns are about these axes; false: each is as named, in this order
};

/// Adds a joint's turn and place in a frame to a motion.
/// @param channels  six at most
/// @param values  one each
/// @param other  read its turns so, if they are three; nothing: as the channels are named, one after the
/// other
void addBvhPose(std::span<const BvhChannel> channels, std::span<const double> values, const BvhTurns* other,
                Motion& motion, std::size_t joint);

/// Some steps of a motion as they were recorded, by which the feet tell whether its turns are read in the
/// order that was meant: a foot that stands moves little while the hips go on.
class BvhSteps {
 public:
  /// @param motion  its frames and their rate
  explicit BvhSteps(const Motion& motion);
  /// Each frame in turn. @param values  one a channel of the whole hierarchy
  void take(std::uint32_t frame, std::span<const double> values);
  /// What to say of a motion whose feet slide as it is, and would stand in another order; empty where they
  /// stand, or in no other one, or the hips do not go anywhere.
  std::string otherTurns(const Motion& motion, std::span<const std::vector<BvhChannel>> channels) const;

 private:
  std::vector<std::uint32_t> frames_;                // each once, as they come
  std::vector<std::array<std::uint32_t, 2>> steps_;  // from which to which of them
  std::vector<double> values_;                       // row by row
};

}  // namespace vasa
