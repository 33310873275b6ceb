#include "surface/fork_template.h"

#include <algorithm>

#include "surface/fork_check.h"

// Two rows of as many vertices are joined by quads, others by stepping along both at like shares of the way;
// where the triangle of a step would fold and that of a step along the other row does not, that one is taken.
// The wall between window and hole is triangulated as between a circle and a rectangle around it, by the
// directions of their vertices from the circle's middle, the hole's half length and angle being the units.
// (The angle from the hole is taken as twice the tangent of its half, which rises all the way round.)
// Directions are compared by where they cut the square |x| + |y| = 1, which needs no arc tangent.
namespace vasa {
namespace {

// Way along the square |x| + |y| = 1 from (1, 0), counter-clockwise, in sides.
float squareWay(vec2 d) {
  if (d.y >= 0) return d.x >= 0 ? d.y / (d.x + d.y) : 1.0f - d.x / (d.y - d.x);
  return d.x < 0 ? 2.0f + d.y / (d.x + d.y) : 3.0f + d.x / (d.x - d.y);
}

class Writer {
 public:
  Writer(const ForkShape& shape, const ForkLayout& layout, std::span<const SurfacePoint> vertices)
      : shape_(shape), layout_(layout), vertices_(vertices), columns_(ringDirections(shape.a)) {}

  void trunk() {
    quads(0);
    if (layout_.cut) {
      tipOfFirst(1);
      tipOfLast(shared::kTrunkRows - 2);
    } else {
      quads(1, true);
      quads(2, true);
      strip(3);
    }
  }

  void branch(std::uint32_t index) {
    if (layout_.stump[index]) {
      quads(branchRow(index) - 1);
      tipOfLast(branchRow(index) - 2);
    } else {
      wall(index);
      for (std::uint32_t row = holeRow(index); row < branchRow(index); ++row) quads(row);
    }
  }

  std::vector<uvec3> triangles;

 private:
  // A stump's tip in the row behind its wide one, or before it.
  void tipOfFirst(std::uint32_t row) {
    const std::uint32_t m = shape_.rowSize(row), low = shape_.rowStart(row), tip = shape_.rowStart(row + 1);
    for (std::uint32_t k = 0; k < m; ++k) add(low + k, low + (k + 1 == m ? 0 : k + 1), tip + k);
  }
  void tipOfLast(std::uint32_t row) {
    const std::uint32_t m = shape_.rowSize(row + 1), tip = shape_.rowStart(row),
                        high = shape_.rowStart(row + 1);
    const std::uint32_t tips = shape_.rowSize(row);
    for (std::uint32_t k = 0; k < m; ++k) add(tip + k * tips / m, high + (k + 1 == m ? 0 : k + 1), high + k);
  }

  void quads(std::uint32_t row, bool aroundWindows = false) {
    const std::uint32_t m = shape_.rowSize(row), low = shape_.rowStart(row), high = shape_.rowStart(row + 1);
    for (std::uint32_t k = 0; k < m; ++k) {
      if (aroundWindows && inWindow(k)) continue;
      const std::uint32_t next = k + 1 == m ? 0 : k + 1;
      quad(low + k, low + next, high + next, high + k);
    }
  }

  // Cut in two from a to c, or from b to d where only that does not fold.
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const bool other = !vertices_.empty() && (foldsAt(a, b, c) || foldsAt(a, c, d)) && !foldsAt(b, c, d) &&
                       !foldsAt(b, d, a);
    if (other) {
      add(b, c, d);
      add(b, d, a);
    } else {
      add(a, b, c);
      add(a, c, d);
    }
  }
  // Whether a triangle on an edge from a to b does not fold with its third corner here, but does there.
  bool better(std::uint32_t a, std::uint32_t b, std::uint32_t here, std::uint32_t there) const {
    return !vertices_.empty() && foldsAt(a, b, there) && !foldsAt(a, b, here);
  }
  bool foldsAt(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return folds(vertices_[a], vertices_[b], vertices_[c]);
  }

  void strip(std::uint32_t row) {
    const std::uint32_t p = shape_.rowSize(row), q = shape_.rowSize(row + 1);
    if (p == q) return quads(row);
    const std::uint32_t low = shape_.rowStart(row), high = shape_.rowStart(row + 1);
    for (std::uint32_t i = 0, k = 0; i < p || k < q;) {
      const std::uint32_t a = low + (i == p ? 0 : i), b = high + (k == q ? 0 : k),
                          alongLow = low + (i + 1 >= p ? 0 : i + 1),
                          alongHigh = high + (k + 1 >= q ? 0 : k + 1);
      bool lower = k == q || (i < p && (2 * i + 1) * q <= (2 * k + 1) * p);
      if (i < p && k < q)
        lower = lower != better(b, a, lower ? alongHigh : alongLow, lower ? alongLow : alongHigh);
      add(b, a, lower ? alongLow : alongHigh);
      ++(lower ? i : k);
    }
  }

  void wall(std::uint32_t branch) {
    window_ = layout_.window[branch];
    const std::uint32_t outlined = outlineSize(window_), hole = shape_.branch[branch];
    const std::uint32_t first = shape_.rowStart(holeRow(branch));
    const std::vector<vec2> directions = ringDirections(hole);
    const auto holeWay = [&](std::uint32_t i) { return i == hole ? 4.0f : squareWay(directions[i]); };
    const float start = squareWay(outlineDirection(0)), startWay = start > 2 ? start - 4.0f : start;
    const auto outerWay = [&](std::uint32_t i) {
      return i == 0 ? startWay : i == outlined ? startWay + 4.0f : squareWay(outlineDirection(i));
    };
    for (std::uint32_t o = 0, h = 0; o < outlined || h < hole;) {
      const std::uint32_t outer = outline(o == outlined ? 0 : o), inner = first + (h == hole ? 0 : h);
      // By the middles of the next steps: both fronts keep abreast.
      const std::uint32_t alongOuter = outline(o + 1 >= outlined ? 0 : o + 1),
                          alongInner = first + (h + 1 >= hole ? 0 : h + 1);
      bool outwards =
          h == hole || (o < outlined && outerWay(o) + outerWay(o + 1) <= holeWay(h) + holeWay(h + 1));
      if (o < outlined && h < hole)
        outwards = outwards != better(inner, outer, outwards ? alongInner : alongOuter,
                                      outwards ? alongOuter : alongInner);
      add(inner, outer, outwards ? alongOuter : alongInner);
      ++(outwards ? o : h);
    }
  }

  bool inWindow(std::uint32_t column) const {
    for (std::uint32_t i = 0; i < shape_.branchCount; ++i)
      if (!layout_.stump[i] && layout_.window[i].holds(column, shape_.a)) return true;
    return false;
  }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles.push_back({a, b, c}); }

  std::uint32_t outline(std::uint32_t i) const { return outlineVertex(shape_, window_, i); }
  vec2 outlineDirection(std::uint32_t i) const {
    const uvec2 place = outlinePlace(window_, i);
    const vec2 column = columns_[(window_.first + place.y) % shape_.a];
    const float along = column.x * window_.hole.x + column.y * window_.hole.y;
    const float aside = column.y * window_.hole.x - column.x * window_.hole.y;
    return {2.0f * aside / ((1.0f + std::max(along, -0.99f)) * window_.wide), window_.rows[int(place.x) - 1]};
  }

  const ForkShape& shape_;
  const ForkLayout& layout_;
  std::span<const SurfacePoint> vertices_;
  std::vector<vec2> columns_;
  ForkWindow window_;
};

}  // namespace

uvec2 outlinePlace(const ForkWindow& window, std::uint32_t i) {
  if (i == 0) return {2, window.count};
  if (i <= window.count + 1) return {3, window.count + 1 - i};
  if (i == window.count + 2) return {2, 0};
  return {1, i - window.count - 3};
}

std::uint32_t outlineVertex(const ForkShape& shape, const ForkWindow& window, std::uint32_t i) {
  const uvec2 place = outlinePlace(window, i);
  return shape.rowStart(place.x) + (window.first + place.y) % shape.a;
}

std::vector<uvec3> trunkTriangles(const ForkShape& shape, const ForkLayout& layout,
                                  std::span<const SurfacePoint> vertices) {
  Writer writer(shape, layout, vertices);
  writer.trunk();
  return std::move(writer.triangles);
}

std::vector<uvec3> branchTriangles(const ForkShape& shape, const ForkLayout& layout, std::uint32_t branch,
                                   std::span<const SurfacePoint> vertices) {
  Writer writer(shape, layout, vertices);
  writer.branch(branch);
  return std::move(writer.triangles);
}

std::vector<uvec3> forkTriangles(const ForkShape& shape, const ForkLayout& layout,
                                 std::span<const SurfacePoint> vertices) {
  Writer writer(shape, layout, vertices);
  for (std::uint32_t branch = 0; branch < shape.branchCount; ++branch) writer.branch(branch);
  writer.trunk();
  return std::move(writer.triangles);
}

std::uint32_t forkTriangleCount(const ForkShape& shape, std::uint32_t columns) {
  std::uint32_t count = 7 * shape.a + shape.b - 2 * columns + 4 * shape.branchCount;
  for (std::uint32_t i = 0; i < shape.branchCount; ++i)
    count += (1 + 2 * shared::kCollarRows) * shape.branch[i];
  return count;
}

}  // namespace vasa
