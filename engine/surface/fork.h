#pragma once
#include "shared/fork.h"
#include "surface/tessellate.h"

// The surface of one fork: a piece of trunk whose wall opens into a collar.
//
// The trunk follows the cubic in (x, y, z, r) that meets its two rings in place and direction. Its hole looks towards
// the place where the branch's axis pierces the wall; columns turn with it, so that the trunk's inner rows stay what
// they are around the hole however the frames of the tubes lie, and only which of a ring's vertices a column ends at
// changes from pose to pose. The collar is a cubic from each of the hole's vertices along the wall, then
// around a fillet and into the branch's ring along the branch's wall: tangent planes agree at both ends.
namespace vasa {

/// Rows of a fork: kTrunkRows of trunk, of which the first and the last are the tubes' rings; the hole; kCollarRows of
/// collar, of which the last is the branch's ring. Vertices lie row after row.
constexpr std::uint32_t kHoleRow = shared::kTrunkRows;
constexpr std::uint32_t kBranchRow = shared::kTrunkRows + shared::kCollarRows;
constexpr std::uint32_t kForkRows = kBranchRow + 1;

/// Vertices of a fork's rows: each ring has as many as its vessel's tube.
struct ForkShape {
  std::uint32_t a = 8, b = 8, branch = 8;

  std::uint32_t rowSize(std::uint32_t row) const { return row < kHoleRow - 1 ? a : row == kHoleRow - 1 ? b : branch; }
  std::uint32_t rowStart(std::uint32_t row) const {
    return row < kHoleRow ? row * a : (kHoleRow - 1) * a + b + (row - kHoleRow) * branch;
  }
  std::uint32_t vertices() const { return rowStart(kForkRows); }
};

/// Columns of the trunk between which the hole lies, 1 to m - 1; 0 without a branch.
std::uint32_t forkWindow(const shared::ForkRecord& fork, std::uint32_t around);

/// Which of a ring's vertices stands at place k of a fork's row: (first + k) or (first - k) mod m.
struct ForkSeam {
  std::uint32_t first = 0;
  bool backwards = false;
  std::uint32_t direction(std::uint32_t k, std::uint32_t around) const {
    return backwards ? (first + around - k) % around : (first + k) % around;
  }
};
struct ForkSeams {
  ForkSeam a, b, branch;
};

/// The CPU reference of shaders/forks.comp. Vertices at rings are the tubes' own, bit for bit. Without a branch the
/// hole and the collar are left alone.
/// @param vertices  shape.vertices()
ForkSeams evaluateFork(const PosedNetwork& network, const shared::ForkRecord& fork, const ForkShape& shape,
                       std::span<SurfacePoint> vertices);

}  // namespace vasa
