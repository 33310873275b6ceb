#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "math/types.h"

namespace vasa {

/// The longest step of anything near a place: how fast what is there may be moved aside without seeming to
/// jump. A grid that is never laid out: places are sorted by the number of their cell, and within it by their
/// step, so that the first one near enough is all that a cell has to say.
class NearbySteps {
 public:
  /// @param near  [m] <= 0.0625: places are near that differ by less along each axis
  explicit NearbySteps(float near) : near_(near) {}

  /// From anew. @param least  [m] shorter steps are not told  @param stepOf  index -> (where it ends, its
  /// length [m]) O(count log count)
  template <class StepOf>
  void set(float least, std::size_t count, const StepOf& stepOf) {
    least_ = least;
    steps_.clear();
    for (std::size_t i = 0; i < count; ++i)
      if (const auto [place, length] = stepOf(i); length > least) add(place, length);
    sort();
  }
  /// The longest step near a place, or some part of it that is `enough`; at least the least step.
  float longest(vec3 place, float enough) const;

 private:
  struct Step {
    std::uint64_t key;  // of its cell and its length
    float length;
    vec3 place;
  };
  void add(vec3 place, float length);
  void sort();

  float near_, least_ = 0;
  std::vector<Step> steps_;
};

}  // namespace vasa
