#include "convert/without_folds.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "math/closest_point.h"

namespace vasa {
namespace {

// Radius by radius of curvature of the axis at a section between two others; of no end where two are in one
// place.
float bendAt(vec4 before, vec4 at, vec4 after) {
  const vec3 in = vec3(at) - vec3(before), out = vec3(after) - vec3(at);
  const float a = glm::length(in), b = glm::length(out);
  const bool apart = a > 0 && b > 0;
  return apart ? 2 * at.w * glm::distance(in / a, out / b) / (a + b) : std::numeric_limits<float>::infinity();
}

// Sections at which a tube would fold are left out, the sharpest bend first.
class FoldRemoval {
 public:
  FoldRemoval(const Sections& all, std::span<const vec3> hosted) : all_(all), kept_(all.size()) {
    for (const vec3 place : hosted) {
      const Along at = nearestAlong(all, place);
      hung_.push_back({place, at.segment, at.distance});
    }
    std::iota(kept_.begin(), kept_.end(), std::size_t(0));
    for (std::size_t k = 0; k < kept_.size(); ++k) bends_.push_back(bendOf(k));
  }

  Sections run() {
    for (auto worst = std::ranges::max_element(bends_); *worst > kFolds;
         worst = std::ranges::max_element(bends_)) {
      const auto k = std::size_t(worst - bends_.begin());
      if (!canGo(k)) {
        *worst = 0;
        continue;
      }
      kept_.erase(kept_.begin() + std::ptrdiff_t(k));
      bends_.erase(worst);
      bends_[k - 1] = bendOf(k - 1), bends_[k] = bendOf(k);
    }
    Sections sections;
    for (const std::size_t at : kept_) sections.push_back(all_[at]);
    return sections;
  }

 private:
  static constexpr float kFolds = 1;  // on the inside of the bend

  float bendOf(std::size_t k) const {
    const bool inner = k > 0 && k + 1 < kept_.size();
    return inner ? bendAt(all_[kept_[k - 1]], all_[kept_[k]], all_[kept_[k + 1]]) : 0;
  }

  // Whether all that was told from the section before to the one behind lies within a diameter of the
  // straight way, and what hangs on it within its tube or no farther off than before.
  bool canGo(std::size_t k) const {
    const std::size_t from = kept_[k - 1], to = kept_[k + 1];
    const vec3 a(all_[from]), b(all_[to]);
    const auto offWay = [&](vec3 p) { return glm::distance(p, a + closestOnSegment(p, a, b) * (b - a)); };
    if (kept_.size() == 3 && glm::distance(a, b) < all_[kept_[k]].w)
      return false;  // a loop, its ends side by side
    for (std::size_t at = from + 1; at < to; ++at)
      if (offWay(vec3(all_[at])) > 2 * all_[at].w) return false;
    return std::ranges::none_of(hung_, [&](const Hung& hung) {
      return hung.segment >= from && hung.segment < to &&
             offWay(hung.place) > std::max(hung.distance, all_[kept_[k]].w);
    });
  }

  struct Hung {
    vec3 place;
    std::uint32_t segment;
    float distance;  // from it
  };
  const Sections& all_;
  std::vector<Hung> hung_;
  std::vector<std::size_t> kept_;
  std::vector<float> bends_;
};

}  // namespace

Sections withoutFolds(const Sections& sections, std::span<const vec3> hosted) {
  return FoldRemoval(sections, hosted).run();
}

}  // namespace vasa
