#include "collide/neighbours.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace vasa {
namespace {

Exclusions wholePairs(std::uint32_t tubes, std::span<const NeighbourPair> pairs) {
  std::vector<TubePair> plain;
  for (const NeighbourPair& pair : pairs) plain.push_back(pair.tubes);
  return Exclusions(tubes, plain);
}

}  // namespace

Neighbours::Neighbours(std::span<const float> lengths, std::vector<TubeLink> links, float reach)
    : reach_(reach), links_(std::move(links)), exclusions_(0) {
  std::sort(links_.begin(), links_.end(), [](const TubeLink& a, const TubeLink& b) {
    return std::tie(a.i, a.j, a.gap, a.s, a.t) < std::tie(b.i, b.j, b.gap, b.s, b.t);
  });
  for (std::uint32_t k = 0; k < links_.size(); ++k) {
    const TubeLink& link = links_[k];
    assert(link.i < link.j && link.j < lengths.size());
    if (pairs_.empty() || pairs_.back().tubes != TubePair{link.i, link.j})
      pairs_.push_back({{link.i, link.j}, lengths[link.i], lengths[link.j], k, 0});
    ++pairs_.back().linkCount;
  }
  exclusions_ = wholePairs(std::uint32_t(lengths.size()), pairs_);
}

const NeighbourPair* Neighbours::find(TubePair pair) const {
  const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), pair,
                                      [](const NeighbourPair& a, TubePair b) { return a.tubes < b; });
  return found != pairs_.end() && found->tubes == pair ? &*found : nullptr;
}

}  // namespace vasa
