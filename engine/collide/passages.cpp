#include "collide/passages.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "collide/spatial_order.h"
#include "core/parallel.h"

namespace vasa {
namespace {

using glm::dvec3;

constexpr int kMostHalvings = 10;  // of a tube without a radius
constexpr int kMostSteps = 40;     // towards a root: to a millionth of a millionth of the way
// Of a chord and of the way: so near to a stretch's end counts for both that meet there, so that rounding
// loses nothing; and what is found twice there is one.
constexpr double kSame = 1e-6;

// A stretch of a moving curve: control points in both shapes, and where it lies on its tube.
struct Stretch {
  std::array<std::array<dvec3, 4>, 2> shapes;
  double from = 0, to = 1;
  double bow = 0;  // [m] its chord strays by less, in both shapes

  Stretch(const Bezier& before, const Bezier& after) {
    for (std::size_t k = 0; k < 4; ++k) shapes[0][k] = vec3(before.b[k]), shapes[1][k] = vec3(after.b[k]);
    bow = largestBow();
  }
  Stretch half(bool second) const {
    Stretch part = *this;
    (second ? part.from : part.to) = 0.5 * (from + to);
    for (std::size_t shape = 0; shape < 2; ++shape) {
      const auto& b = shapes[shape];
      const dvec3 p01 = 0.5 * (b[0] + b[1]), p12 = 0.5 * (b[1] + b[2]), p23 = 0.5 * (b[2] + b[3]),
                  p012 = 0.5 * (p01 + p12), p123 = 0.5 * (p12 + p23), middle = 0.5 * (p012 + p123);
      part.shapes[shape] = second ? std::array{middle, p123, p23, b[3]} : std::array{b[0], p01, p012, middle};
    }
    part.bow = part.largestBow();
    return part;
  }
  double largestBow() const {
    double most = 0;
    for (const auto& b : shapes)
      most = std::max({most, glm::distance(b[1], glm::mix(b[0], b[3], 1.0 / 3)),
                       glm::distance(b[2], glm::mix(b[0], b[3], 2.0 / 3))});
    return most;
  }
};

// Whether all of one lies on one side of all of the other along an axis, in both shapes.
bool separates(dvec3 axis, const Stretch& a, const Stretch& b) {
  bool above = true, below = true;
  for (std::size_t shape = 0; shape < 2; ++shape) {
    const auto range = [&](const Stretch& of) {
      double low = glm::dot(axis, of.shapes[shape][0]), high = low;
      for (std::size_t k = 1; k < 4; ++k) {
        const double along = glm::dot(axis, of.shapes[shape][k]);
        low = std::min(low, along), high = std::max(high, along);
      }
      return std::pair(low, high);
    };
    const auto [lowA, highA] = range(a);
    const auto [lowB, highB] = range(b);
    above &= lowA > highB;
    below &= highA < lowB;
  }
  return above || below;
}

bool apart(const Stretch& a, const Stretch& b) {
  const auto middle = [](const Stretch& of) {
    return of.shapes[0][0] + of.shapes[0][3] + of.shapes[1][0] + of.shapes[1][3];
  };
  return separates({1, 0, 0}, a, b) || separates({0, 1, 0}, a, b) || separates({0, 0, 1}, a, b) ||
         separates(middle(a) - middle(b), a, b);
}

// A cubic by its Bernstein coefficients.
using Cubic = std::array<double, 4>;

// Calls root(t) wherever a cubic changes its sign between `from` and `to`.
template <class Root>
void forEachChange(const Cubic& c, double from, double to, int steps, const Root& root) {
  int changes = 0;
  for (std::size_t k = 0; k + 1 < c.size(); ++k) changes += (c[k] < 0) != (c[k + 1] < 0);
  if (changes == 0) return;
  const double middle = 0.5 * (from + to);
  if (steps == kMostSteps) {
    if ((c[0] < 0) != (c[3] < 0)) root(middle);
    return;
  }
  const double c01 = 0.5 * (c[0] + c[1]), c12 = 0.5 * (c[1] + c[2]), c23 = 0.5 * (c[2] + c[3]),
               c012 = 0.5 * (c01 + c12), c123 = 0.5 * (c12 + c23), half = 0.5 * (c012 + c123);
  forEachChange({c[0], c01, c012, half}, from, middle, steps + 1, root);
  forEachChange({half, c123, c23, c[3]}, middle, to, steps + 1, root);
}

// The product of three vectors that go straight from one value to another: their determinant over time.
Cubic determinantOf(const std::array<dvec3, 2>& a, const std::array<dvec3, 2>& b,
                    const std::array<dvec3, 2>& c) {
  const auto of = [&](std::size_t i, std::size_t j, std::size_t k) {
    return glm::dot(glm::cross(a[i], b[j]), c[k]);
  };
  return {of(0, 0, 0), (of(1, 0, 0) + of(0, 1, 0) + of(0, 0, 1)) / 3,
          (of(0, 1, 1) + of(1, 0, 1) + of(1, 1, 0)) / 3, of(1, 1, 1)};
}

// When and where two chords pass through one another: s and t from 0 to 1 along them.
template <class Passes>
void forEachPassing(const Stretch& a, const Stretch& b, const Passes& passes) {
  std::array<dvec3, 2> u, v, w;
  for (std::size_t shape = 0; shape < 2; ++shape) {
    u[shape] = a.shapes[shape][3] - a.shapes[shape][0];
    v[shape] = b.shapes[shape][3] - b.shapes[shape][0];
    w[shape] = b.shapes[shape][0] - a.shapes[shape][0];
  }
  forEachChange(determinantOf(u, v, w), 0, 1, 0, [&](double time) {
    const dvec3 along = glm::mix(u[0], u[1], time), across = glm::mix(v[0], v[1], time),
                gap = glm::mix(w[0], w[1], time), normal = glm::cross(along, across);
    const double size = glm::dot(normal, normal);
    if (!(size > 0)) return;
    const double s = glm::dot(glm::cross(gap, across), normal) / size,
                 t = glm::dot(glm::cross(gap, along), normal) / size;
    if (std::min({s, t, 1 - s, 1 - t}) > -kSame) passes(s, t, time);
  });
}

template <class Passes>
void search(const Stretch& a, const Stretch& b, double straight, int halvings, const Passes& passes) {
  if (apart(a, b)) return;
  if (halvings == 2 * kMostHalvings || std::max(a.bow, b.bow) <= straight) {
    forEachPassing(a, b, [&](double s, double t, double time) {
      passes(glm::mix(a.from, a.to, s), glm::mix(b.from, b.to, t), time);
    });
    return;
  }
  const bool splitA = a.bow >= b.bow;
  for (const bool second : {false, true})
    if (splitA)
      search(a.half(second), b, straight, halvings + 1, passes);
    else
      search(a, b.half(second), straight, halvings + 1, passes);
}

float leastRadius(const Bezier& before, const Bezier& after) {
  float least = before.b[0].w;
  for (const Bezier* shape : {&before, &after})
    for (const vec4& point : shape->b) least = std::min(least, point.w);
  return least;
}

}  // namespace

PassageSearch::PassageSearch(std::span<const Bezier> rest, const Exclusions& exclusions)
    : exclusions_(&exclusions), own_(rest.size()) {
  std::vector<vec3> centres;
  centres.reserve(rest.size());
  for (const Bezier& tube : rest) centres.push_back(tube.bounds().centre());
  order_ = spatialOrder(centres);
  for (std::size_t nodes = rest.size(); nodes > 0; nodes = nodes > 1 ? (nodes + kArity - 1) / kArity : 0)
    hulls_.emplace_back(nodes);
}

// Of the tube at a slot with those at later ones below a node.
void PassageSearch::meet(std::uint32_t slot, std::size_t level, std::uint32_t node,
                         std::vector<Passage>& found) const {
  const Hull &a = hulls_[0][slot], &b = hulls_[level][node];
  for (int axis = 0; axis < 3; ++axis) {
    bool above = true, below = true;
    for (std::size_t shape = 0; shape < kShapes; ++shape) {
      above &= a[shape].low[axis] > b[shape].high[axis];
      below &= a[shape].high[axis] < b[shape].low[axis];
    }
    if (above || below) return;
  }
  if (level > 0) {
    const auto end = std::min<std::size_t>(hulls_[level - 1].size(), std::size_t(node + 1) * kArity);
    std::size_t last = slot;  // what lies below this level's nodes up to here comes earlier
    for (std::size_t below = 1; below < level; ++below) last /= kArity;
    for (std::size_t child = std::max<std::size_t>(std::size_t(node) * kArity, last); child < end; ++child)
      meet(slot, level - 1, std::uint32_t(child), found);
    return;
  }
  if (node <= slot) return;
  const TubePair pair = orderedPair(order_[slot], order_[node]);
  const std::uint32_t i = pair.i, j = pair.j;
  if (exclusions_->contains(i, j)) return;
  const double straight =
      0.25 * double(leastRadius(before_[i], after_[i]) + leastRadius(before_[j], after_[j]));
  search({before_[i], after_[i]}, {before_[j], after_[j]}, straight, 0, [&](double s, double t, double time) {
    const Passage passage{i, j, float(s), float(t), float(time)};
    const auto isSame = [&](const Passage& other) {
      return other.i == i && other.j == j && std::abs(other.s - passage.s) < kSame &&
             std::abs(other.t - passage.t) < kSame && std::abs(other.time - passage.time) < kSame;
    };
    if (std::ranges::none_of(found, isSame)) found.push_back(passage);
  });
}

std::span<const Passage> PassageSearch::find(std::span<const Bezier> before, std::span<const Bezier> after) {
  found_.clear();
  if (before.empty()) return found_;
  before_ = before;
  after_ = after;
  for (std::size_t slot = 0; slot < order_.size(); ++slot) {
    Hull& hull = hulls_[0][slot] = {};
    for (std::size_t shape = 0; shape < kShapes; ++shape)
      for (const vec4& point : (shape == 0 ? before : after)[order_[slot]].b) hull[shape].add(vec3(point));
  }
  for (std::size_t level = 1; level < hulls_.size(); ++level) {
    std::ranges::fill(hulls_[level], Hull());
    for (std::size_t child = 0; child < hulls_[level - 1].size(); ++child)
      for (std::size_t shape = 0; shape < kShapes; ++shape)
        hulls_[level][child / kArity][shape].add(hulls_[level - 1][child][shape]);
  }
  parallelFor(order_.size(), 64, [&](std::size_t slot) {
    own_[slot].clear();
    meet(std::uint32_t(slot), hulls_.size() - 1, 0, own_[slot]);
  });
  for (const std::vector<Passage>& own : own_) found_.insert(found_.end(), own.begin(), own.end());
  std::ranges::sort(found_, {}, [](const Passage& p) { return std::tuple(p.i, p.j, p.time, p.s, p.t); });
  return found_;
}

}  // namespace vasa
