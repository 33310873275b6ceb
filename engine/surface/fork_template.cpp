#include "surface/fork_template.h"

// Two rows of as many vertices are joined by quads, others by stepping along both at like shares of the way. The wall
// between window and hole is triangulated as between a circle and a rectangle around it, by the directions of their
// vertices from the middle. That stays a triangulation for any rectangle that holds the circle with some margin: a
// triangle on the rectangle's side holds no part of the circle's inside, and one on the circle's side has its tip beyond
// the chord. Directions are compared by where they cut the square |x| + |y| = 1, which needs no arc tangent.
namespace vasa {
namespace {

constexpr float kNominalWide = 1.4f, kNominalHigh = 1.2f;  // half sides of the rectangle, the circle's radius being 1

// Way along the square |x| + |y| = 1 from (1, 0), counter-clockwise, in sides.
float squareWay(vec2 d) {
  if (d.y >= 0) return d.x >= 0 ? d.y / (d.x + d.y) : 1.0f - d.x / (d.y - d.x);
  return d.x < 0 ? 2.0f + d.y / (d.x + d.y) : 3.0f + d.x / (d.x - d.y);
}

class Writer {
 public:
  Writer(const ForkShape& shape, std::uint32_t window) : shape_(shape), window_(window) {
    triangles.reserve(forkTriangleCount(shape, window));
  }

  void quads(std::uint32_t row, std::uint32_t firstColumn) {
    const std::uint32_t m = shape_.rowSize(row), low = shape_.rowStart(row), high = shape_.rowStart(row + 1);
    for (std::uint32_t k = firstColumn; k < m; ++k) {
      const std::uint32_t next = k + 1 == m ? 0 : k + 1;
      add(low + k, low + next, high + next);
      add(low + k, high + next, high + k);
    }
  }

  void strip(std::uint32_t row) {
    const std::uint32_t p = shape_.rowSize(row), q = shape_.rowSize(row + 1);
    if (p == q) return quads(row, 0);
    const std::uint32_t low = shape_.rowStart(row), high = shape_.rowStart(row + 1);
    for (std::uint32_t i = 0, k = 0; i < p || k < q;) {
      const std::uint32_t a = low + (i == p ? 0 : i), b = high + (k == q ? 0 : k);
      if (k == q || (i < p && (2 * i + 1) * q <= (2 * k + 1) * p)) {
        ++i;
        add(a, low + (i == p ? 0 : i), b);
      } else {
        ++k;
        add(a, high + (k == q ? 0 : k), b);
      }
    }
  }

  void wall() {
    const std::uint32_t outline = 2 * window_ + 4, hole = shape_.branch, first = shape_.rowStart(kHoleRow);
    const std::vector<vec2> directions = ringDirections(hole);
    const auto holeWay = [&](std::uint32_t i) { return i == hole ? 4.0f : squareWay(directions[i]); };
    const auto outerWay = [&](std::uint32_t i) { return i == outline ? 4.0f : squareWay(outlineDirection(i)); };
    for (std::uint32_t o = 0, h = 0; o < outline || h < hole;) {
      const std::uint32_t outer = outlineVertex(o == outline ? 0 : o), inner = first + (h == hole ? 0 : h);
      // By the middles of the next steps: both fronts keep abreast.
      if (h == hole || (o < outline && outerWay(o) + outerWay(o + 1) <= holeWay(h) + holeWay(h + 1))) {
        ++o;
        add(inner, outer, outlineVertex(o == outline ? 0 : o));
      } else {
        ++h;
        add(inner, outer, first + (h == hole ? 0 : h));
      }
    }
  }

  std::vector<uvec3> triangles;

 private:
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles.push_back({a, b, c}); }

  // The window's outline from the middle of its right side on: up, to the left along row 3, down, along row 1.
  uvec2 outlinePlace(std::uint32_t i) const {
    if (i == 0) return {2, window_};
    if (i <= window_ + 1) return {3, window_ + 1 - i};
    if (i == window_ + 2) return {2, 0};
    return {1, i - window_ - 3};
  }
  std::uint32_t outlineVertex(std::uint32_t i) const {
    const uvec2 place = outlinePlace(i);
    return shape_.rowStart(place.x) + place.y;
  }
  vec2 outlineDirection(std::uint32_t i) const {
    const uvec2 place = outlinePlace(i);
    return {kNominalWide * (2.0f * float(place.y) / float(window_) - 1.0f), kNominalHigh * (float(place.x) - 2.0f)};
  }

  const ForkShape& shape_;
  std::uint32_t window_;
};

}  // namespace

std::vector<uvec3> forkTriangles(const ForkShape& shape, std::uint32_t window) {
  Writer writer(shape, window);
  writer.quads(0, 0);
  writer.quads(1, window);
  writer.quads(2, window);
  writer.strip(3);
  if (window == 0) return std::move(writer.triangles);
  writer.wall();
  for (std::uint32_t row = kHoleRow; row < kBranchRow; ++row) writer.quads(row, 0);
  return std::move(writer.triangles);
}

std::uint32_t forkTriangleCount(const ForkShape& shape, std::uint32_t window) {
  const std::uint32_t trunk = 2 * shape.a + 4 * (shape.a - window) + shape.a + shape.b;
  return window == 0 ? trunk : trunk + 2 * window + 4 + shape.branch + 2 * shared::kCollarRows * shape.branch;
}

}  // namespace vasa
