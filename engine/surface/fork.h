#pragma once
#include <algorithm>
#include <array>

#include "surface/tessellate.h"

// The surface of one fork: a piece of trunk whose wall opens into collars.
//
// The trunk follows the cubic in (x, y, z, r) that meets its two rings in place and direction; its columns
// begin at the vertices of ring a. A hole lies where a branch's axis pierces the wall, between columns of its
// own: its window. The collar is a cubic from each of the hole's vertices along the wall, then around a
// fillet and into the branch's ring along the branch's wall: tangent planes agree at both ends. Which columns
// are a hole's window, and which of a ring's vertices a row begins at, is found anew in each pose, so that
// nothing twists.
//
// Where a pose makes a collar or the trunk fold, it is smoothed, step by step, until it does not
// (surface/fork_smooth.h): a fork that begins to fold moves by a part of its radius at most. Few go on
// folding. Then a branch becomes a stump: its tube runs straight on to the trunk's axis and is closed there,
// and the wall has no hole; where it is the trunk, its two tubes and all branches are stumps. A stump cannot
// fold: surface/fork_stump.h.
namespace vasa {

/// Rows of a fork: kTrunkRows of trunk, of which the first and the last are the tubes' rings; then for each
/// branch the hole and kCollarRows of collar, of which the last is the branch's ring. Vertices lie row after
/// row.
constexpr std::uint32_t kBranchRows = 1 + shared::kCollarRows;
inline std::uint32_t holeRow(std::uint32_t branch) { return shared::kTrunkRows + branch * kBranchRows; }
inline std::uint32_t branchRow(std::uint32_t branch) { return holeRow(branch) + shared::kCollarRows; }

/// Vertices of a fork's rows: each ring has as many as its vessel's tube.
struct ForkShape {
  std::uint32_t a = 8, b = 8, branchCount = 0;
  std::array<std::uint32_t, shared::kMostBranches> branch{};

  std::uint32_t rowSize(std::uint32_t row) const {
    if (row < shared::kTrunkRows) return row + 1 < shared::kTrunkRows ? a : b;
    return branch[(row - shared::kTrunkRows) / kBranchRows];
  }
  std::uint32_t rowStart(std::uint32_t row) const {
    if (row < shared::kTrunkRows) return row * a;
    std::uint32_t start = (shared::kTrunkRows - 1) * a + b, rest = row - shared::kTrunkRows;
    for (std::uint32_t i = 0; rest > 0; ++i) {
      const std::uint32_t rows = rest < kBranchRows ? rest : kBranchRows;
      start += rows * branch[i];
      rest -= rows;
    }
    return start;
  }
  std::uint32_t vertices() const { return rowStart(holeRow(branchCount)); }
};
/// @param aroundOf  m of a vessel's tube
template <class AroundOf>
ForkShape forkShape(const SweepTable& table, const shared::ForkRecord& fork, const AroundOf& aroundOf) {
  ForkShape shape{aroundOf(fork.vesselA), aroundOf(fork.vesselB), fork.branchCount, {}};
  for (std::uint32_t i = 0; i < fork.branchCount; ++i)
    shape.branch[i] = aroundOf(table.branches[fork.firstBranch + i].vessel);
  return shape;
}

/// Columns of the trunk between which a hole lies: `count` from column `first` on. And how it lies there.
struct ForkWindow {
  std::uint32_t first = 0, count = 0;
  vec2 hole{1, 0};      ///< its middle's direction, column 0 being (1, 0)
  float wide = 1;       ///< sine of its half angle
  vec3 rows{-1, 0, 1};  ///< the trunk's inner rows, seen from the hole's middle, in its half lengths
  bool holds(std::uint32_t column, std::uint32_t around) const {
    return (column + around - first) % around < count;
  }
};
/// How many, of `around`: at least 1, and all of a fork's windows leave or fill the circle.
std::uint32_t windowColumns(const shared::ForkBranch& branch, std::uint32_t branchCount,
                            std::uint32_t around);

/// Which of a ring's vertices stands at place k of a fork's row: (first + k) or (first - k) mod m.
struct ForkSeam {
  std::uint32_t first = 0;
  bool backwards = false;
  std::uint32_t direction(std::uint32_t k, std::uint32_t around) const {
    return backwards ? (first + around - k) % around : (first + k) % around;
  }
};

/// How often a fork's trunk is smoothed, and each of its collars (surface/fork_smooth.h).
struct ForkSteps {
  std::uint8_t trunk = 0;
  std::array<std::uint8_t, shared::kMostBranches> collar{};
  std::uint8_t most() const { return std::max(trunk, *std::max_element(collar.begin(), collar.end())); }
};

/// What a pose settles of a fork besides its vertices.
struct ForkLayout {
  ForkSeam a, b;
  std::array<ForkSeam, shared::kMostBranches> branch;
  std::array<ForkWindow, shared::kMostBranches> window;
  ForkSteps steps;
  std::array<bool, shared::kMostBranches> stump{};  ///< the branch is one
  bool cut = false;                                 ///< the trunk's ends are, and all branches
};

/// The CPU reference of shaders/forks.comp. Vertices at rings are the tubes' own, bit for bit.
/// @param vertices  shape.vertices()
/// @param fixed     none: parts that fold in this pose are smoothed, those that fold yet become stumps. Else
///                  parts are smoothed so often whether they fold or not: triangles belong to the same parts
///                  in all poses, and move with the pose without a step
/// @param turns     a quad that folds along one diagonal does not, if it does not along the other
///                  (forkTriangles() of surface/fork_template.h)
ForkLayout evaluateFork(const PosedNetwork& network, const shared::ForkRecord& fork, const ForkShape& shape,
                        std::span<SurfacePoint> vertices, const ForkSteps* fixed = nullptr,
                        bool turns = true);

}  // namespace vasa
