#include "support/tube_network.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace vasa::test {
namespace {

struct Limb {
  vec3 from, to;
  float radius;
};
constexpr int kTubesPerVessel = 3;
const Limb kLimbs[] = {
    {{0, 0, 0.5f}, {0, 0, 0.82f}, 0.075f},         {{0, 0, 0.85f}, {0, 0, 0.94f}, 0.05f},
    {{0.05f, 0, 0.5f}, {0.07f, 0, 0.04f}, 0.035f}, {{-0.05f, 0, 0.5f}, {-0.07f, 0, 0.04f}, 0.035f},
    {{0.1f, 0, 0.8f}, {0.2f, 0, 0.46f}, 0.025f},   {{-0.1f, 0, 0.8f}, {-0.2f, 0, 0.46f}, 0.025f}};

// A hash of a counter, so that the same seed gives the same network with every standard library; braces and
// names of their own keep the order of calls with every compiler.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 0x1234567) {}
  float between(float low, float high) {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return low + (high - low) * float((z ^ (z >> 31)) >> 40) / float(1 << 24);
  }
  vec3 direction() {
    for (;;) {
      const vec3 v{between(-1, 1), between(-1, 1), between(-1, 1)};
      const float length = glm::length(v);
      if (length > 0.1f && length <= 1) return v / length;
    }
  }

 private:
  std::uint64_t state_;
};

struct Sprout {
  vec3 position, direction;
  float radius;
  int limb;
  std::uint32_t node;
};

class Grower {
 public:
  Grower(std::uint32_t tubes, std::uint32_t seed)
      : wanted_(tubes), scale_(std::cbrt(4030.0f / float(std::max(tubes, 1u)))), random_(seed) {}

  TubeList run() {
    while (tubes_.size() < wanted_) {
      if (sprouts_.empty()) plant();
      const Sprout sprout = sprouts_.front();
      sprouts_.pop_front();
      grow(sprout);
    }
    return finish();
  }

 private:
  struct Tube {
    Bezier shape;
    std::uint32_t from, to;  // nodes
  };

  void plant() {
    const int limb = int(random_.between(0, 5.999f));
    const Limb& where = kLimbs[limb];
    const float along = random_.between(0, 1), aside = random_.between(0, 0.8f);
    const vec3 position = glm::mix(where.from, where.to, along) + where.radius * aside * random_.direction();
    const float share = random_.between(0, 1);
    sprouts_.push_back({position, random_.direction(), scale_ * (0.0006f + 0.0042f * share * share * share),
                        limb, nodes_++});
  }

  vec3 turned(vec3 position, vec3 direction, const Limb& limb, float wander) {
    const vec3 axis = limb.to - limb.from;
    const float along = glm::clamp(glm::dot(position - limb.from, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
    const vec3 inward = limb.from + along * axis - position;
    const float outside = glm::length(inward) / limb.radius;
    return glm::normalize(direction + wander * random_.direction() +
                          (outside > 0.85f ? inward / limb.radius : vec3(0)));
  }

  void grow(Sprout at) {
    const Limb& limb = kLimbs[at.limb];
    std::vector<vec4> sections{vec4(at.position, at.radius)};
    vec3 direction = at.direction;
    for (int k = 0; k < kTubesPerVessel; ++k) {
      direction = turned(vec3(sections.back()), direction, limb, 0.35f);
      const float radius = sections.back().w;
      sections.emplace_back(vec3(sections.back()) + direction * radius * random_.between(4, 9.5f),
                            radius * 0.97f);
    }
    std::uint32_t node = at.node;
    for (int k = 0; k < kTubesPerVessel && tubes_.size() < wanted_; ++k) {
      const vec4& p0 = sections[std::size_t(k)];
      const vec4& p1 = sections[std::size_t(k) + 1];
      const vec4 before = k > 0 ? sections[std::size_t(k) - 1] : p0,
                 after = k + 2 <= kTubesPerVessel ? sections[std::size_t(k) + 2] : p1;
      tubes_.push_back({{{p0, p0 + (p1 - before) / 6.0f, p1 - (after - p0) / 6.0f, p1}}, node, nodes_});
      node = nodes_++;
    }
    const vec4 tip = sections.back();
    for (const float ratio : {random_.between(0.72f, 0.9f), random_.between(0.5f, 0.75f)})
      if (tip.w * ratio > 0.0005f * scale_)
        sprouts_.push_back(
            {vec3(tip), turned(vec3(tip), direction, limb, 0.9f), tip.w * ratio, at.limb, node});
  }

  TubeList finish() const {
    TubeList list;
    std::map<std::uint32_t, std::vector<std::uint32_t>> at;
    for (std::uint32_t i = 0; i < tubes_.size(); ++i) {
      list.poses[0].push_back(tubes_[i].shape);
      list.poses[1].push_back(bent(tubes_[i].shape));
      at[tubes_[i].from].push_back(i);
      at[tubes_[i].to].push_back(i);
    }
    for (const auto& [node, tubes] : at)
      for (std::size_t a = 0; a < tubes.size(); ++a)
        for (std::size_t b = a + 1; b < tubes.size(); ++b)
          list.excluded.push_back(orderedPair(tubes[a], tubes[b]));
    std::sort(list.excluded.begin(), list.excluded.end());
    return list;
  }

  // Turns what lies below `height` about the x axis through (0, 0, height), smoothly over the joint.
  static vec3 hinge(vec3 p, float height, float angle) {
    const float a = angle * glm::smoothstep(-0.05f, 0.05f, height - p.z);
    const float y = p.y, z = p.z - height;
    return {p.x, std::cos(a) * y - std::sin(a) * z, height + std::sin(a) * y + std::cos(a) * z};
  }

  static Bezier bent(const Bezier& tube) {
    Bezier moved = tube;
    for (vec4& point : moved.b) {
      vec3 p(point);
      const float side = p.x > 0 ? 1.0f : -1.0f;
      const bool arm = std::abs(p.x) > 0.09f && p.z > 0.4f;
      if (arm) p = hinge(p, 0.64f, 1.2f);
      if (!arm && p.z < 0.5f) p = hinge(hinge(p, 0.27f, -1.3f), 0.48f, side * 0.5f);
      const float twist = 0.5f * glm::smoothstep(0.5f, 0.9f, p.z);
      p = {std::cos(twist) * p.x - std::sin(twist) * p.y, std::sin(twist) * p.x + std::cos(twist) * p.y, p.z};
      point = vec4(p, point.w * (0.97f + 0.05f * glm::smoothstep(0.0f, 1.0f, p.z)));
    }
    return moved;
  }

  std::uint32_t wanted_;
  float scale_;
  Random random_;
  std::deque<Sprout> sprouts_;
  std::vector<Tube> tubes_;
  std::uint32_t nodes_ = 0;
};

}  // namespace

TubeList makeTubeNetwork(std::uint32_t tubes, std::uint32_t seed) { return Grower(tubes, seed).run(); }

}  // namespace vasa::test
