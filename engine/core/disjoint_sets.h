#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace vasa {

/// Disjoint sets over 0 .. n-1. The root of a set is its smallest member, so results do not depend on the
/// order of the unions.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// @return whether they were in two sets
  bool unite(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }
  /// One more, in a set of its own.
  void add() { parent_.push_back(std::uint32_t(parent_.size())); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace vasa
