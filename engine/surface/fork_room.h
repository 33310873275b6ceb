#pragma once
#include <span>

namespace vasa {

/// What a fork wants of its host's course; ways along it [m].
struct ForkRoom {
  float centre = 0;             ///< where its branch pierces the wall, or where two vessels meet
  float before = 0, after = 0;  ///< the least it needs to either side of `centre`
  float want = 0;               ///< what it likes to have to either side
  float low = 0, high = 0;      ///< given: its rings' ways
  float shift = 0;              ///< given: how far `centre` was moved
  bool operator==(const ForkRoom&) const = default;
};

/// Moves forks apart that need the same room, as little as possible in the sense of least squares, and grants
/// each what it wants as far as there is room; what is left between two forks and smaller than `sliver` is
/// shared out.
/// @param rooms  sorted by centre
/// @return false where [low, high] is too small for them all; nothing is then given
/// O(n).
bool shareRoom(std::span<ForkRoom> rooms, float low, float high, float sliver);

}  // namespace vasa
