#include "body/humanoid_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "body/humanoid.h"
#include "body/skeleton.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr float kEqual = 0.12f;  // a pair's lengths differ by no more than this share
constexpr float kShortLimb =
    0.15f;  // of the longest way from the root to a tip: fingers, eyes and ribs are no limbs
constexpr int kLimbJoints = 3;
constexpr std::size_t kMostJoints = 1000;
constexpr std::size_t kLongestChain = 24, kMostBefore = 4, kMostTwists = 4;

// A person's limbs: upper by lower bone; both of an arm by both of a leg, both of a leg by the way from the
// hips to its tip (which may be the ankle or the toes). Spreads are of the logarithm.
struct Proportions {
  float ratio, ratioSpread, share, shareSpread;
};
constexpr Proportions kArm{1.15f, 0.2f, 0.67f, 0.25f}, kLeg{1.02f, 0.15f, 0.9f, 0.2f};
// What else counts as much as one spread, squared: a bone shorter by this share than the way through its
// joints; some joints passed over; a wrist where fingers begin; a limb that ends at a tip and not at a joint.
constexpr float kBentBone = 0.02f, kSkippedJoint = 0.3f, kHandSeen = 1.5f, kEndsAtTip = 1;

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

  // How far two limbs go on alike, joint by joint: one of two hands may hold something. Nothing where that
  // are fewer than the three joints of a limb.
  float alike(std::uint32_t a, std::uint32_t b) const {
    float length = 0;
    int joints = 0;
    for (; a != kNone && b != kNone; a = longest(a), b = longest(b), ++joints) {
      const float most = std::max(link(a), link(b));
      if (std::abs(link(a) - link(b)) > kEqual * most) break;
      length += most;
    }
    return joints >= kLimbJoints ? length : 0.0f;
  }

  // Equal limbs that leave one joint, or two joints at one place after it (hip joints without length).
  std::optional<Pair> pairAt(std::uint32_t joint, float least) const {
    std::optional<Pair> best;
    const auto& own = children_[joint];
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t k = i + 1; k < own.size(); ++k) {
        const float a = reach_[own[i]] + link(own[i]), b = reach_[own[k]] + link(own[k]);
        const bool equal = std::abs(a - b) <= kEqual * std::max(a, b) && sameCounts(own[i], own[k]);
        const float length = equal ? std::min(a, b) : alike(own[i], own[k]);
        if (length < least) continue;
        if (!best || length > best->length) best = Pair{joint, own[i], own[k], length};
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
      return std::ranges::any_of(pairs, [&](const Pair& q) {
        return q.at != p.at && (hangsOn(parents_, p.at, q.a) || hangsOn(parents_, p.at, q.b));
      });
    });
    if (pairs.size() < 2) return false;
    std::ranges::stable_sort(pairs, std::greater{}, &Pair::length);
    Pair legs = pairs[0], arms = pairs[1];
    // The joint nearer to the root has the legs, as a rule; where the other pair has the feet, that one has.
    if (hangsOn(parents_, legs.at, arms.at)) std::swap(legs, arms);
    if (!hangsOn(parents_, arms.at, legs.at)) return false;
    const auto leg = limb(legs.a, false);
    if (!leg) return false;
    legBones_ = straight(leg->chain, leg->upper, leg->lower) + straight(leg->chain, leg->lower, leg->end);
    name(legs.at, "hips");
    const std::optional<bool> leftIsA = sideOf(legs, arms);
    if (!leftIsA) return false;
    for (const auto& [pair, arm] : {std::pair(legs, false), std::pair(arms, true)}) {
      const bool same = glm::dot(across(pair, arm), left_) > 0;
      if (!nameLimb(same ? pair.a : pair.b, "left", arm) || !nameLimb(same ? pair.b : pair.a, "right", arm))
        return false;
    }
    return true;
  }

  std::uint32_t longest(std::uint32_t joint) const {
    std::uint32_t best = kNone;
    for (const std::uint32_t child : children_[joint])
      if (best == kNone || reach_[child] + link(child) > reach_[best] + link(best)) best = child;
    return best;
  }

  // A limb's longest chain, and where in it its upper bone begins, its lower bone, and what comes behind: a
  // joint, or behind the last one its tip.
  struct Limb {
    std::vector<std::uint32_t> chain;
    std::size_t upper, lower, end;

    bool endsAtJoint() const { return end < chain.size(); }
  };
  vec3 placeIn(const std::vector<std::uint32_t>& chain, std::size_t i) const {
    return i < chain.size() ? places_[chain[i]] : tips_[chain.back()];
  }

  // Bones may be divided by joints that only twist them, so any three joints of the chain may be the limb's:
  // the three that look most like a person's, each bone straight, are.
  std::optional<Limb> limb(std::uint32_t first, bool arm) const {
    Limb best{{}, 0, 0, 0};
    for (std::uint32_t j = first; j != kNone && best.chain.size() < kLongestChain; j = longest(j))
      best.chain.push_back(j);
    const auto& chain = best.chain;
    const bool tip = tips_[chain.back()] != places_[chain.back()];
    const std::size_t ends = chain.size() + (tip ? 1 : 0);
    float least = 1e30f;
    for (std::size_t i = 0; i < chain.size() && i <= kMostBefore; ++i)
      for (std::size_t j = i + 1; j < chain.size() && j - i <= kMostTwists + 1; ++j)
        for (std::size_t k = j + 1; k < ends && k - j <= kMostTwists + 1; ++k)
          if (const float cost = unlikeness(chain, {i, j, k}, arm); cost < least)
            least = cost, best.upper = i, best.lower = j, best.end = k;
    return least < 1e30f ? std::optional(best) : std::nullopt;
  }

  float unlikeness(const std::vector<std::uint32_t>& chain, const std::array<std::size_t, 3>& at,
                   bool arm) const {
    const float upper = straight(chain, at[0], at[1]), lower = straight(chain, at[1], at[2]);
    if (!(upper > 0) || !(lower > 0)) return 1e30f;
    const float bend = upper / along(chain, at[0], at[1]) + lower / along(chain, at[1], at[2]);
    const Proportions& person = arm ? kArm : kLeg;
    const float whole = arm ? legBones_ : reach_[chain.front()] + link(chain.front());
    const auto off = [](float value, float wanted, float spread) {
      const float ratio = std::log(value / wanted) / spread;
      return ratio * ratio;
    };
    float cost = off(upper / lower, person.ratio, person.ratioSpread) +
                 off((upper + lower) / whole, person.share, person.shareSpread) + (2 - bend) / kBentBone +
                 kSkippedJoint * float(at[2] - at[0] - 2);
    if (at[2] == chain.size())
      cost += kEndsAtTip;
    else if (arm && hasFingers(chain[at[2]]))
      cost -= kHandSeen;
    return cost;
  }
  float straight(const std::vector<std::uint32_t>& chain, std::size_t a, std::size_t b) const {
    return glm::distance(placeIn(chain, a), placeIn(chain, b));
  }
  float along(const std::vector<std::uint32_t>& chain, std::size_t a, std::size_t b) const {
    float sum = 0;
    for (std::size_t i = a + 1; i <= b; ++i) sum += straight(chain, i - 1, i);
    return sum;
  }
  bool hasFingers(std::uint32_t joint) const {
    return std::ranges::count_if(children_[joint], [&](std::uint32_t child) { return count_[child] > 1; }) >
           1;
  }

  vec3 end(const Pair& pair, bool ofA) const {
    std::uint32_t j = ofA ? pair.a : pair.b;
    while (longest(j) != kNone) j = longest(j);
    return tips_[j];
  }
  vec3 across(const Pair& pair, bool arm) const {
    const vec3 apart = places_[pair.a] - places_[pair.b];
    const auto a = limb(pair.a, arm), b = limb(pair.b, arm);
    if (glm::length(apart) > 1e-4f * pair.length || !a || !b) return apart;
    return places_[a->chain[a->upper]] - places_[b->chain[b->upper]];
  }

  // Where the feet point, seen from their ankles, with up from legs to arms; +X where there are none.
  std::optional<bool> sideOf(const Pair& legs, const Pair& arms) {
    vec3 up = places_[arms.at] - places_[legs.at], forward(0);
    if (!(glm::length(up) > 0)) return std::nullopt;
    up = glm::normalize(up);
    for (const bool a : {true, false}) {
      const auto leg = limb(a ? legs.a : legs.b, false);
      if (!leg) return std::nullopt;
      forward += end(legs, a) - placeIn(leg->chain, leg->end);
    }
    forward -= glm::dot(forward, up) * up;
    left_ =
        glm::length(forward) > 0.05f * legs.length ? glm::cross(up, glm::normalize(forward)) : vec3(1, 0, 0);
    const float side = glm::dot(across(legs, false), left_);
    if (side == 0) return std::nullopt;
    return side > 0;
  }

  void name(std::uint32_t joint, const std::string& part) { out_[joint] = humanoidPart(part); }

  bool nameLimb(std::uint32_t first, const std::string& side, bool arm) {
    const auto own = limb(first, arm);
    if (!own) return false;
    const auto& chain = own->chain;
    name(chain[own->upper], side + (arm ? "UpperArm" : "UpperLeg"));
    name(chain[own->lower], side + (arm ? "LowerArm" : "LowerLeg"));
    if (own->endsAtJoint()) name(chain[own->end], side + (arm ? "Hand" : "Foot"));
    if (arm && own->upper > 0) {  // of a collar bone and what follows it the longest
      std::size_t collar = 0;
      for (std::size_t i = 1; i < own->upper; ++i)
        if (link(chain[i + 1]) > link(chain[collar + 1])) collar = i;
      name(chain[collar], side + "Shoulder");
    }
    if (!arm && own->end + 1 < chain.size()) name(chain[own->end + 1], side + "Toes");
    return true;
  }

  std::span<const std::uint32_t> parents_;
  std::span<const vec3> places_, tips_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<float> reach_;          // of the longest way from a joint to a tip
  std::vector<std::uint32_t> count_;  // of a joint and those behind it
  std::vector<std::string_view> out_;
  float legBones_ = 0;  // [m] a thigh and a shin
  vec3 left_{1, 0, 0};
};

}  // namespace

std::vector<std::string_view> humanoidShape(std::span<const std::uint32_t> parents,
                                            std::span<const vec3> places, std::span<const vec3> tips) {
  return Shape(parents, places, tips).run();
}

}  // namespace vasa
