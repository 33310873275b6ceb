#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "collide/contact.h"
#include "core/large_pages.h"
#include "core/result.h"
#include "curve/bezier.h"

namespace vasa {

/// A plain list of tubes in two poses, for trials of detection alone. Text: first line `n m`; n lines of 32
/// numbers (4 control points x y z r in pose 0, then in pose 1); m lines `i j`, tubes that share an end.
struct TubeList {
  std::array<std::vector<Bezier>, 2> poses;
  std::vector<TubePair> excluded;

  /// The tubes part of the way from pose 0 (share 0) to pose 1 (share 1), control point by control point.
  void blend(float share, LargeVector<Bezier>& tubes) const;
};

/// Largest coordinate and radius a tube list may hold: beyond it, single precision has nothing left to
/// measure.
constexpr float kLargestTubeCoordinate = 1e6f;

/// Reads and checks a tube list: counts, 32 finite numbers a line, radii above zero, pairs of two different
/// tubes that exist. Fails with badInput that names file, line, cause and remedy, or io.
Result<TubeList> readTubeList(const std::filesystem::path& path);

/// Writes atomically, with as many digits as bring back the same numbers.
Result<void> writeTubeList(const std::filesystem::path& path, const TubeList& list);

/// A line `i j` a pair, as given.
Result<void> writePairs(const std::filesystem::path& path, std::span<const TubePair> pairs);

}  // namespace vasa
