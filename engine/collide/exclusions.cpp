#include "collide/exclusions.h"

#include <algorithm>
#include <cassert>

namespace vasa {

Exclusions::Exclusions(std::uint32_t tubeCount, std::span<const TubePair> pairs) : first_(tubeCount + 1, 0) {
  std::vector<TubePair> directed;
  directed.reserve(2 * pairs.size());
  for (const TubePair& pair : pairs) {
    assert(pair.i != pair.j && pair.i < tubeCount && pair.j < tubeCount);
    directed.push_back({pair.i, pair.j});
    directed.push_back({pair.j, pair.i});
  }
  std::sort(directed.begin(), directed.end());
  directed.erase(std::unique(directed.begin(), directed.end()), directed.end());
  partners_.reserve(directed.size());
  for (const TubePair& pair : directed) {
    ++first_[pair.i + 1];
    partners_.push_back(pair.j);
  }
  for (std::uint32_t i = 0; i < tubeCount; ++i) first_[i + 1] += first_[i];
}

bool Exclusions::contains(std::uint32_t a, std::uint32_t b) const {
  for (const std::uint32_t partner : partnersOf(a))
    if (partner >= b) return partner == b;
  return false;
}

}  // namespace vasa
