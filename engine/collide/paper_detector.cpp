#include "collide/paper_detector.h"

#include <algorithm>

#include "math/segment_distance.h"

namespace vasa {
namespace {

// One tube as its tree of line-swept spheres sees it: nothing is stored, a node is (level, index).
struct SweptTree {
  const Bezier& tube;
  float filip, filipRadius, largestRadius;

  explicit SweptTree(const Bezier& b)
      : tube(b),
        filip(filipConstant(b)),
        filipRadius(filipRadiusConstant(b)),
        largestRadius(radiusBound(b)) {}

  vec4 sample(int level, int index) const {
    const vec4& w = bernsteinTable()[std::size_t(index) << (kBernsteinLevels - level)];
    return w.x * tube.b[0] + w.y * tube.b[1] + w.z * tube.b[2] + w.w * tube.b[3];
  }
  // Radius bound of the piece itself: its ends and Filip's bound of r(t), never above the whole tube's.
  float radius(const vec4& start, const vec4& end, int level) const {
    return std::min(largestRadius, std::max(start.w, end.w) + filipBound(filipRadius, level));
  }
};

struct Node {
  vec4 start, end;
  int level, index;
  float epsilon, radius;  // the swept sphere's radius is their sum

  float reach() const { return epsilon + radius; }
  float size() const { return glm::distance(vec3(start), vec3(end)) + 2 * reach(); }
};

Node root(const SweptTree& tree) {
  Node node{tree.tube.b[0], tree.tube.b[3], 0, 0, filipBound(tree.filip, 0), 0};
  node.radius = tree.radius(node.start, node.end, 0);
  return node;
}

// One curve point opens a node.
std::pair<Node, Node> open(const SweptTree& tree, const Node& node) {
  const int level = node.level + 1;
  const vec4 middle = tree.sample(level, 2 * node.index + 1);
  const float epsilon = 0.25f * node.epsilon;
  return {{node.start, middle, level, 2 * node.index, epsilon, tree.radius(node.start, middle, level)},
          {middle, node.end, level, 2 * node.index + 1, epsilon, tree.radius(middle, node.end, level)}};
}

// Squared distance of two segments by the inner stationary point, kept inside the square, as usual for this
// test (Ericson 2005, 5.1.9); less its slack, so that near-parallel segments are not missed.
float squaredDistance(const vec3& p0, const vec3& p1, const vec3& q0, const vec3& q1) {
  const vec3 u = p1 - p0, v = q1 - q0, w = p0 - q0;
  const float uu = std::max(glm::dot(u, u), 1e-37f), vv = std::max(glm::dot(v, v), 1e-37f),
              uv = glm::dot(u, v);
  const float uw = glm::dot(u, w), vw = glm::dot(v, w), determinant = uu * vv - uv * uv;
  float s = determinant > 0 ? glm::clamp((uv * vw - vv * uw) / determinant, 0.0f, 1.0f) : 0.0f;
  const float t = glm::clamp((s * uv + vw) / vv, 0.0f, 1.0f);
  s = glm::clamp((t * uv - uw) / uu, 0.0f, 1.0f);
  const vec3 gap = w + s * u - t * v;
  return glm::dot(gap, gap) - kSegmentSlack<float> * (uu + vv + glm::dot(w, w));
}

bool meet(const SweptTree& ta, const Node& a, const SweptTree& tb, const Node& b, float tolerance) {
  const float reach = a.reach() + b.reach();
  if (squaredDistance(vec3(a.start), vec3(a.end), vec3(b.start), vec3(b.end)) > reach * reach) return false;
  if (a.epsilon + b.epsilon < tolerance) return true;
  const bool aCanOpen = a.level < kBernsteinLevels, bCanOpen = b.level < kBernsteinLevels;
  if (!aCanOpen && !bCanOpen) return true;
  if (aCanOpen && (!bCanOpen || a.size() >= b.size())) {
    const auto [low, high] = open(ta, a);
    return meet(ta, low, tb, b, tolerance) || meet(ta, high, tb, b, tolerance);
  }
  const auto [low, high] = open(tb, b);
  return meet(ta, a, tb, low, tolerance) || meet(ta, a, tb, high, tolerance);
}

bool overlap(const Sphere& a, const Sphere& b) {
  const vec3 between = a.centre - b.centre;
  const float reach = a.radius + b.radius;
  return glm::dot(between, between) <= reach * reach;
}

}  // namespace

bool sweptSpheresMeet(const Bezier& a, const Bezier& b, float tolerance) {
  const SweptTree ta(a), tb(b);
  return meet(ta, root(ta), tb, root(tb), tolerance);
}

PaperDetector::PaperDetector(std::span<const Bezier> rest, const Exclusions& exclusions, float tolerance)
    : exclusions_(exclusions), tolerance_(tolerance), tree_(rest) {}

void PaperDetector::update(std::span<const Bezier> tubes) {
  tubes_ = tubes;
  tree_.refit(tubes);
}

void PaperDetector::meet(std::uint32_t a, std::uint32_t b) {
  const TubePair pair = orderedPair(tree_.tube(a), tree_.tube(b));
  if (exclusions_.contains(pair.i, pair.j)) return;
  if (sweptSpheresMeet(tubes_[pair.i], tubes_[pair.j], tolerance_)) pairs_.push_back(pair);
}

// Nodes of one level against one another, themselves included: equal depth keeps the walk simple, and all
// leaves lie at the same depth.
std::span<const TubePair> PaperDetector::detect() {
  pairs_.clear();
  stack_.clear();
  if (tree_.levels() > 1) stack_.push_back({tree_.levels() - 1, 0, 0});
  while (!stack_.empty()) {
    const auto [level, a, b] = stack_.back();
    stack_.pop_back();
    const std::uint32_t below = level - 1;
    const std::uint32_t endA = std::min(tree_.count(below), (a + 1) * SphereTree::kArity);
    const std::uint32_t endB = std::min(tree_.count(below), (b + 1) * SphereTree::kArity);
    for (std::uint32_t i = a * SphereTree::kArity; i < endA; ++i) {
      const Sphere own = tree_.sphere(below, i);
      for (std::uint32_t j = a == b ? i + (below == 0) : b * SphereTree::kArity; j < endB; ++j) {
        if (!overlap(own, tree_.sphere(below, j))) continue;
        if (below > 0) {
          stack_.push_back({below, i, j});
        } else {
          meet(i, j);
        }
      }
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace vasa
