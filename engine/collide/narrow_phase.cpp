#include "collide/narrow_phase.h"

#include "collide/closest_tubes.h"

namespace vasa {
namespace {

constexpr int kVectorLevels = 7;         // halvings in single precision
constexpr std::size_t kMostPieces = 64;  // a candidate; beyond, the search in double takes over
constexpr std::uint8_t kMeets = 1, kSearched = 2;

}  // namespace

void NarrowPhase::settle(const Kernels& kernels, const BoxTreeView& tree, std::span<const TubePair> tubes,
                         double tolerance, std::vector<TubePair>& pairs) {
  if (pieces_.size() < tubes.size() + 1) pieces_.resize(tubes.size() + 1);
  const std::size_t candidates = kernels.meetCapsules(tree, tubes.data(), tubes.size(), pieces_.data());
  statistics.boxPairs += tubes.size();
  meeting_.resize(candidates);
  for (std::size_t c = 0; c < candidates; ++c) meeting_[c] = {pieces_[c].i, pieces_[c].j};
  settled_.assign(candidates, 0);
  std::size_t open = candidates;
  for (int level = 0; level < kVectorLevels && open > 0 && open <= kMostPieces * candidates; ++level) {
    statistics.pieces[std::size_t(level)] += open;
    if (halves_.size() < 4 * open + 4) halves_.resize(4 * open + 4);
    open = kernels.narrow(tree, level, pieces_.data(), open, settled_.data(), halves_.data());
    pieces_.swap(halves_);
  }
  for (const PiecePair& piece : std::span(pieces_.data(), open)) {
    std::uint8_t& settled = settled_[piece.candidate];
    if (settled) continue;
    ++statistics.searched;
    const Bezier &a = tree.tubes[piece.i], &b = tree.tubes[piece.j];
    settled = tubesIntersect(a, b, tolerance, 2 * double(tree.grow)) ? kMeets : kSearched;
  }
  for (std::size_t c = 0; c < candidates; ++c)
    if (settled_[c] == kMeets) pairs.push_back(orderedPair(meeting_[c].i, meeting_[c].j));
}

}  // namespace vasa
