#include "collide/sphere_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <nanoflann.hpp>
#include <utility>

// Build: rounds of pairing. In a round every item finds its nearest items, the pairs are taken in the order
// of their merged radius, each item once, and those left over try again among themselves. After three rounds
// an item holds eight of the level below. At most one item of a round is incomplete (holds fewer leaves than
// the others); it stays alone where the count is odd and always comes second, so that it ends up last in the
// leaves' order and all nodes before it are full.
namespace vasa {
namespace {

struct Item {
  Sphere sphere;
  std::uint32_t left, right;  // both kLeaf: a tube; right kLeaf alone cannot be
  std::uint32_t leaves;
};
constexpr std::uint32_t kLeaf = 0xffffffffu;
constexpr std::size_t kNeighbours = 8;

struct Centres {
  const std::vector<Item>& items;
  std::span<const std::uint32_t> which;
  std::size_t kdtree_get_point_count() const { return which.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return items[which[i]].sphere.centre[glm::length_t(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Centres>, Centres, 3,
                                                 std::uint32_t>;

struct Proposal {
  float radius;
  std::uint32_t a, b;
  bool operator<(const Proposal& other) const {
    return std::tie(radius, a, b) < std::tie(other.radius, other.a, other.b);
  }
};

std::vector<Proposal> proposals(const std::vector<Item>& items, std::span<const std::uint32_t> open) {
  const Centres centres{items, open};
  Tree tree(3, centres, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  std::vector<Proposal> found;
  std::uint32_t nearest[kNeighbours + 1];
  float distances[kNeighbours + 1];
  for (const std::uint32_t a : open) {
    const std::size_t count = tree.knnSearch(&items[a].sphere.centre.x, kNeighbours + 1, nearest, distances);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t b = open[nearest[k]];
      if (a != b)
        found.push_back(
            {mergedSphere(items[a].sphere, items[b].sphere).radius, std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

class Builder {
 public:
  explicit Builder(std::span<const Bezier> rest) {
    items_.reserve(2 * rest.size());
    for (const Bezier& tube : rest) items_.push_back({boundingSphere(tube), kLeaf, kLeaf, 1});
  }

  std::vector<std::uint32_t> order() {
    std::vector<std::uint32_t> round(items_.size());
    for (std::uint32_t i = 0; i < round.size(); ++i) round[i] = i;
    for (std::uint32_t full = 1; round.size() > 1; full *= 2) round = pairUp(std::move(round), full);
    return leavesOf(round);
  }

 private:
  std::vector<std::uint32_t> pairUp(std::vector<std::uint32_t> open, std::uint32_t full) {
    std::vector<std::uint32_t> next;
    std::uint32_t alone = kLeaf;
    if (open.size() % 2) {
      auto lone =
          std::find_if(open.begin(), open.end(), [&](std::uint32_t i) { return items_[i].leaves < full; });
      if (lone == open.end()) --lone;
      alone = *lone;
      open.erase(lone);
    }
    std::vector<char> taken(items_.size(), 0);
    while (!open.empty()) {
      for (const auto& [radius, a, b] : proposals(items_, open)) {
        if (taken[a] || taken[b]) continue;
        taken[a] = taken[b] = 1;
        next.push_back(merge(a, b));
      }
      std::erase_if(open, [&](std::uint32_t i) { return taken[i]; });
    }
    if (alone != kLeaf) next.push_back(alone);
    return next;
  }

  std::uint32_t merge(std::uint32_t a, std::uint32_t b) {
    if (items_[a].leaves < items_[b].leaves) std::swap(a, b);
    items_.push_back(
        {mergedSphere(items_[a].sphere, items_[b].sphere), a, b, items_[a].leaves + items_[b].leaves});
    return std::uint32_t(items_.size() - 1);
  }

  std::vector<std::uint32_t> leavesOf(const std::vector<std::uint32_t>& roots) const {
    std::vector<std::uint32_t> order, stack(roots);
    while (!stack.empty()) {
      const std::uint32_t at = stack.back();
      stack.pop_back();
      if (items_[at].left == kLeaf) {
        order.push_back(at);
      } else {
        stack.push_back(items_[at].right);
        stack.push_back(items_[at].left);
      }
    }
    return order;
  }

  std::vector<Item> items_;
};

// Centre of the children's box, which eight near-equal spheres fill well, then the reach to the farthest
// child.
Sphere sphereAround(std::span<const Sphere> children) {
  Aabb box;
  for (const Sphere& child : children) box.add(child.centre, child.radius);
  const vec3 centre = box.centre();
  float reach = 0;
  for (const Sphere& child : children)
    reach = std::max(reach, glm::distance(centre, child.centre) + child.radius);
  return {centre, reach * (1 + 4 * std::numeric_limits<float>::epsilon())};
}

}  // namespace

Sphere mergedSphere(const Sphere& a, const Sphere& b) {
  const vec3 towards = b.centre - a.centre;
  const float distance = glm::length(towards);
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  const float radius = 0.5f * (distance + a.radius + b.radius);
  return {a.centre + towards * ((radius - a.radius) / distance), radius};
}

SphereTree::SphereTree(std::span<const Bezier> rest) : start_{0} {
  if (rest.empty()) return;
  order_ = Builder(rest).order();
  std::uint32_t count = std::uint32_t(rest.size());
  for (;; count = (count + kArity - 1) / kArity) {
    start_.push_back(start_.back() + count);
    if (count == 1) break;
  }
  spheres_.resize(start_.back());
  refit(rest);
}

void SphereTree::refit(std::span<const Bezier> tubes) {
  assert(tubes.size() == order_.size());
  chooseGrid(tubes);
  for (std::size_t leaf = 0; leaf < order_.size(); ++leaf)
    spheres_[leaf] = packed(boundingSphere(tubes[order_[leaf]]));
  std::array<Sphere, kArity> children;
  for (std::uint32_t level = 1; level < levels(); ++level)
    for (std::uint32_t node = 0; node < count(level); ++node) {
      const std::uint32_t first = node * kArity, size = std::min(kArity, count(level - 1) - first);
      for (std::uint32_t k = 0; k < size; ++k) children[k] = sphere(level - 1, first + k);
      spheres_[start_[level] + node] = packed(sphereAround(std::span(children).first(size)));
    }
}

// All centres lie in the box of the leaves' centres, and no sphere reaches farther than twice across it and
// the widest leaf: half the grid's 65,536 steps are the box, so that radii fit too.
void SphereTree::chooseGrid(std::span<const Bezier> tubes) {
  Aabb box;
  for (const Bezier& tube : tubes) {
    const Sphere sphere = boundingSphere(tube);
    box.add(sphere.centre, sphere.radius);
  }
  const vec3 extent = box.empty() ? vec3(1) : box.extent();
  corner_ = box.empty() ? vec3(0) : box.low;
  step_ = std::max({extent.x, extent.y, extent.z, 1e-6f}) / 32000;
}

SphereTree::Packed SphereTree::packed(const Sphere& sphere) const {
  constexpr float kRounding = 1.0f;  // of a centre, in steps: more than half a cell's diagonal
  const vec3 at = glm::round((sphere.centre - corner_) / step_);
  const float radius = std::ceil(sphere.radius / step_ + kRounding);
  assert(radius < 65536);
  return {std::uint16_t(at.x), std::uint16_t(at.y), std::uint16_t(at.z), std::uint16_t(radius)};
}

}  // namespace vasa
