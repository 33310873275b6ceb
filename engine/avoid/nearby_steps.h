#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "math/types.h"

namespace vasa {

/// The longest step of anything near a place: how fast what is there may be moved aside without seeming to
/// jump. A grid of cells that share some buckets, for a few questions among many steps.
class NearbySteps {
 public:
  /// @param near  [m] > 0: places are near that differ by less along each axis
  explicit NearbySteps(float near) : near_(near) {}

  /// From anew. @param least  [m] shorter steps are not told  @param stepOf  index -> (where it ends, its
  /// length [m]) O(count)
  template <class StepOf>
  void set(float least, std::size_t count, const StepOf& stepOf) {
    least_ = least;
    given_.clear();
    for (std::size_t i = 0; i < count; ++i)
      if (const auto [place, length] = stepOf(i); length > least) given_.push_back({place, length});
    fillBuckets();
  }
  /// The longest step near a place, or some part of it that is `enough`; at least the least step.
  float longest(vec3 place, float enough) const;

 private:
  struct Step {
    vec3 place;
    float length;
  };
  ivec3 cellOf(vec3 place) const;
  void fillBuckets();

  float near_, least_ = 0;
  std::vector<Step> given_, steps_;    // the same, by bucket
  std::vector<std::uint32_t> firsts_;  // of each bucket, and the end
};

}  // namespace vasa
