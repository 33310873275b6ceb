#include "body/humanoid_shape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "body/humanoid.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr float kEqual = 0.12f;  // a pair's lengths differ by no more than this share
constexpr float kShortLimb =
    0.15f;  // of the longest way from the root to a tip: fingers, eyes and ribs are no limbs
constexpr std::size_t kMostJoints = 1000;

struct Pair {
  std::uint32_t at, a, b;  // the joint they leave, the first joint of each
  float length;            // of either
};

class Shape {
 public:
  Shape(std::span<const std::uint32_t> parents, std::span<const vec3> places, std::span<const vec3> tips)
      : parents_(parents),
        places_(places),
        tips_(tips),
        children_(parents.size()),
        reach_(parents.size()),
        count_(parents.size(), 1),
        out_(parents.size()) {
    for (std::uint32_t j = 0; j < parents.size(); ++j)
      if (parents[j] != kNone) children_[parents[j]].push_back(j);
    for (std::uint32_t j = std::uint32_t(parents.size()); j-- > 0;) {
      reach_[j] = glm::distance(places[j], tips[j]);
      for (const std::uint32_t child : children_[j])
        reach_[j] = std::max(reach_[j], reach_[child] + link(child)), count_[j] += count_[child];
    }
  }

  std::vector<std::string_view> run() {
    if (!find()) return std::vector<std::string_view>(parents_.size());
    return std::move(out_);
  }

 private:
  float link(std::uint32_t joint) const {
    return parents_[joint] == kNone ? 0.0f : glm::distance(places_[joint], places_[parents_[joint]]);
  }

  // Equal limbs that leave one joint, or two joints at one place after it (hip joints without length).
  std::optional<Pair> pairAt(std::uint32_t joint, float least) const {
    std::optional<Pair> best;
    const auto& own = children_[joint];
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t k = i + 1; k < own.size(); ++k) {
        const float a = reach_[own[i]] + link(own[i]), b = reach_[own[k]] + link(own[k]);
        if (std::min(a, b) < least || std::abs(a - b) > kEqual * std::max(a, b)) continue;
        if (!sameCounts(own[i], own[k])) continue;
        if (!best || std::min(a, b) > best->length) best = Pair{joint, own[i], own[k], std::min(a, b)};
      }
    return best;
  }
  bool sameCounts(std::uint32_t a, std::uint32_t b) const {
    return std::max(count_[a], count_[b]) <= std::min(count_[a], count_[b]) + 2;
  }

  bool find() {
    if (parents_.size() > kMostJoints) return false;
    float whole = 0;
    for (std::uint32_t j = 0; j < parents_.size(); ++j)
      if (parents_[j] == kNone) whole = std::max(whole, reach_[j]);
    std::vector<Pair> pairs;
    for (std::uint32_t j = 0; j < parents_.size(); ++j)
      if (const auto pair = pairAt(j, kShortLimb * whole)) pairs.push_back(*pair);
    // Of pairs inside a limb (two bones of a forearm) only those along the trunk count: a limb's joint is
    // below a pair.
    std::erase_if(pairs, [&](const Pair& p) {
      return std::ranges::any_of(
          pairs, [&](const Pair& q) { return q.at != p.at && (isBelow(p.at, q.a) || isBelow(p.at, q.b)); });
    });
    if (pairs.size() < 2) return false;
    std::ranges::stable_sort(pairs, std::greater{}, &Pair::length);
    Pair legs = pairs[0], arms = pairs[1];
    // The joint nearer to the root has the legs, as a rule; where the other pair has the feet, that one has.
    if (isBelow(legs.at, arms.at)) std::swap(legs, arms);
    const auto armLimb = limb(arms.a), legLimb = limb(legs.a);
    if (!armLimb || !legLimb || !isBelow(arms.at, legs.at)) return false;
    nameTrunk(legs, arms);
    const std::optional<bool> leftIsA = sideOf(legs, arms);
    if (!leftIsA) return false;
    for (const auto& [pair, arm] : {std::pair(legs, false), std::pair(arms, true)}) {
      const bool same = glm::dot(across(pair), left_) > 0;
      if (!nameLimb(same ? pair.a : pair.b, "left", arm) || !nameLimb(same ? pair.b : pair.a, "right", arm))
        return false;
    }
    return true;
  }

  bool isBelow(std::uint32_t joint, std::uint32_t above) const {
    for (; joint != kNone; joint = parents_[joint])
      if (joint == above) return true;
    return false;
  }

  std::uint32_t longest(std::uint32_t joint) const {
    std::uint32_t best = kNone;
    for (const std::uint32_t child : children_[joint])
      if (best == kNone || reach_[child] + link(child) > reach_[best] + link(best)) best = child;
    return best;
  }

  struct Limb {
    std::vector<std::uint32_t> chain;
    std::size_t upper;  // in the chain
  };
  std::optional<Limb> limb(std::uint32_t first) const {
    Limb limb{{}, 0};
    for (std::uint32_t j = first; j != kNone; j = longest(j)) limb.chain.push_back(j);
    float most = 0;
    for (std::size_t i = 0; i + 2 < limb.chain.size() && i < 4; ++i) {
      const float upper = link(limb.chain[i + 1]), lower = link(limb.chain[i + 2]);
      if (const float both = std::min(upper, lower); both > most) most = both, limb.upper = i;
    }
    return most > 0 ? std::optional(limb) : std::nullopt;
  }

  vec3 end(const Pair& pair, bool ofA) const {
    std::uint32_t j = ofA ? pair.a : pair.b;
    while (longest(j) != kNone) j = longest(j);
    return tips_[j];
  }
  vec3 across(const Pair& pair) const {
    const vec3 apart = places_[pair.a] - places_[pair.b];
    const auto a = limb(pair.a), b = limb(pair.b);
    if (glm::length(apart) > 1e-4f * pair.length || !a || !b) return apart;
    return places_[a->chain[a->upper]] - places_[b->chain[b->upper]];
  }

  // Where the feet point, seen from their ankles, with up from legs to arms; +X where there are none.
  std::optional<bool> sideOf(const Pair& legs, const Pair& arms) {
    vec3 up = places_[arms.at] - places_[legs.at], forward(0);
    if (!(glm::length(up) > 0)) return std::nullopt;
    up = glm::normalize(up);
    for (const bool a : {true, false}) {
      const auto leg = limb(a ? legs.a : legs.b);
      if (!leg) return std::nullopt;
      const std::size_t ankle = leg->upper + 2;
      forward += end(legs, a) - places_[leg->chain[ankle]];
    }
    forward -= glm::dot(forward, up) * up;
    left_ =
        glm::length(forward) > 0.05f * legs.length ? glm::cross(up, glm::normalize(forward)) : vec3(1, 0, 0);
    const float side = glm::dot(across(legs), left_);
    if (side == 0) return std::nullopt;
    return side > 0;
  }

  void name(std::uint32_t joint, const std::string& part) { out_[joint] = humanoidPart(part); }

  void nameTrunk(const Pair& legs, const Pair& arms) {
    name(legs.at, "hips");
    std::vector<std::uint32_t> between;
    for (std::uint32_t j = arms.at; j != legs.at; j = parents_[j]) between.push_back(j);
    std::ranges::reverse(between);
    static constexpr const char* kNames[] = {"spine", "chest", "upperChest"};
    if (!between.empty()) name(between.front(), kNames[0]);
    if (between.size() > 2) name(between[between.size() / 2], kNames[1]);
    if (between.size() > 1) name(between.back(), between.size() > 2 ? kNames[2] : kNames[1]);
    std::uint32_t neck = kNone;
    for (const std::uint32_t child : children_[arms.at])
      if (child != arms.a && child != arms.b && (neck == kNone || reach_[child] > reach_[neck])) neck = child;
    if (neck == kNone) return;
    const std::uint32_t head = longest(neck);
    if (head == kNone) return name(neck, "head");
    name(neck, "neck"), name(head, "head");
  }

  bool nameLimb(std::uint32_t first, const std::string& side, bool arm) {
    const auto own = limb(first);
    if (!own || own->chain.size() < own->upper + 3) return false;
    const auto at = [&](std::size_t k) { return own->chain[own->upper + k]; };
    name(at(0), side + (arm ? "UpperArm" : "UpperLeg"));
    name(at(1), side + (arm ? "LowerArm" : "LowerLeg"));
    name(at(2), side + (arm ? "Hand" : "Foot"));
    if (arm && own->upper > 0) name(own->chain[own->upper - 1], side + "Shoulder");
    if (!arm && own->chain.size() > own->upper + 3) name(at(3), side + "Toes");
    return true;
  }

  std::span<const std::uint32_t> parents_;
  std::span<const vec3> places_, tips_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<float> reach_;          // of the longest way from a joint to a tip
  std::vector<std::uint32_t> count_;  // of a joint and those behind it
  std::vector<std::string_view> out_;
  vec3 left_{1, 0, 0};
};

}  // namespace

std::vector<std::string_view> humanoidShape(std::span<const std::uint32_t> parents,
                                            std::span<const vec3> places, std::span<const vec3> tips) {
  return Shape(parents, places, tips).run();
}

}  // namespace vasa
