#pragma once
#include <span>
#include <vector>

#include "collide/contact.h"

namespace vasa {

/// The pairs of tubes that are not to be tested because they belong together (they share an end, or lie close
/// to one another along the network). Immutable; each pair is kept once a direction, partners sorted.
class Exclusions {
 public:
  explicit Exclusions(std::uint32_t tubeCount) : Exclusions(tubeCount, {}) {}
  /// @param pairs  any order, repeated or not, i != j, both below tubeCount
  Exclusions(std::uint32_t tubeCount, std::span<const TubePair> pairs);

  std::uint32_t tubeCount() const { return std::uint32_t(first_.size() - 1); }
  /// Different pairs.
  std::size_t pairCount() const { return partners_.size() / 2; }
  std::span<const std::uint32_t> partnersOf(std::uint32_t tube) const {
    return std::span(partners_).subspan(first_[tube], first_[tube + 1] - first_[tube]);
  }
  bool contains(std::uint32_t a, std::uint32_t b) const;

 private:
  std::vector<std::uint32_t> first_;  // tubeCount + 1 offsets into partners_
  std::vector<std::uint32_t> partners_;
};

}  // namespace vasa
