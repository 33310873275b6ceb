#pragma once
#include <unordered_map>

#include "surface/fork_exit.h"

namespace vasa {

/// Where a fork folds, in triangles, unless it is smoothed; the lesser of two is the better fork.
struct ForkFolds {
  /// Not to be drawn: smoothed or not, a part is a stump at rest or in a strained shape, 8 quads around.
  bool stump = false;
  std::uint32_t otherStumps = 0;  ///< other numbers of quads around for which it is one
  std::uint32_t steps = 0;        ///< of smoothing, at rest, 8 quads around
  std::uint32_t rest = 0;         ///< at rest, 8 quads around
  std::uint32_t others = 0;       ///< at rest, other numbers of quads around
  std::uint32_t strained = 0;     ///< in strained shapes of the network, 8 quads around
  bool none() const { return rest + others + strained == 0; }
  auto operator<=>(const ForkFolds&) const = default;
};

/// What planning has found out about places of networks, by the shapes of the vessels there and nothing else:
/// of networks that are planned one after the other, as while a vessel is edited, only what has changed is
/// tried anew. Plans are the same with any memory.
struct ForkMemory {
  std::unordered_map<std::uint64_t, ForkExit> exits;
  std::unordered_map<std::uint64_t, ForkFolds> folds;

  /// Forgets everything once it has become much: some 60 bytes an entry, a body's plan adds thousands.
  void trim() {
    constexpr std::size_t kMost = 200'000;
    if (exits.size() > kMost) exits.clear();
    if (folds.size() > kMost) folds.clear();
  }
};

}  // namespace vasa
