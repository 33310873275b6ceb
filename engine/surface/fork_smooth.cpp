#include "surface/fork_smooth.h"

#include "surface/fork_template.h"
#include "surface/reference.h"

// The specification of shaders/lib/fork_smooth.glsl: same operations in the same order. Vertices move one
// after the other, those behind see where those before have gone (Gauss-Seidel): so no second copy is needed.
namespace vasa {
namespace {

constexpr float kStep = 0.5f;  // of the way to the neighbours' mean
// Weight of the surface's own normal: within, and beside other parts.
constexpr float kNormalStep = 1.0f, kSeamStep = 0.3f;

// Rows of a part, each with its own number of vertices.
struct Rows {
  const ForkShape& shape;
  std::uint32_t first, last;

  // The vertex of a row beside place k of m.
  std::uint32_t beside(std::uint32_t row, std::uint32_t k, std::uint32_t m) const {
    const std::uint32_t own = shape.rowSize(row), at = own == m ? k : (k * own + m / 2) / m;
    return shape.rowStart(row) + (at == own ? 0 : at);
  }
};

void moveTo(vec3& p, vec3 a, vec3 b, vec3 c, vec3 d) { p = p + kStep * (0.25f * (a + b + c + d) - p); }

void smoothRow(const Rows& rows, std::uint32_t row, std::span<SurfacePoint> vertices) {
  const std::uint32_t m = rows.shape.rowSize(row), start = rows.shape.rowStart(row);
  for (std::uint32_t k = 0; k < m; ++k)
    moveTo(vertices[start + k].position, vertices[start + (k + 1 == m ? 0 : k + 1)].position,
           vertices[start + (k == 0 ? m : k) - 1].position, vertices[rows.beside(row - 1, k, m)].position,
           vertices[rows.beside(row + 1, k, m)].position);
}

void turnNormals(const Rows& rows, std::span<SurfacePoint> vertices) {
  for (std::uint32_t row = rows.first; row <= rows.last; ++row) {
    const std::uint32_t m = rows.shape.rowSize(row), start = rows.shape.rowStart(row);
    const std::uint32_t before = row == rows.first ? row : row - 1, after = row == rows.last ? row : row + 1;
    const float step = before == row || after == row ? kSeamStep : kNormalStep;
    for (std::uint32_t k = 0; k < m; ++k) {
      const vec3 around = vertices[start + (k + 1 == m ? 0 : k + 1)].position -
                          vertices[start + (k == 0 ? m : k) - 1].position;
      const vec3 along =
          vertices[rows.beside(after, k, m)].position - vertices[rows.beside(before, k, m)].position;
      vec3& normal = vertices[start + k].normal;
      const vec3 own = unitOr(glm::cross(around, along), normal);
      normal = unitOr(normal + step * own, normal);
    }
  }
}

}  // namespace

void smoothTrunk(const ForkShape& shape, std::span<SurfacePoint> vertices) {
  const Rows rows{shape, 0, shared::kTrunkRows - 1};
  for (std::uint32_t row = rows.first + 1; row < rows.last; ++row) smoothRow(rows, row, vertices);
  turnNormals(rows, vertices);
}

void smoothCollar(const ForkShape& shape, const ForkLayout& layout, std::uint32_t branch,
                  std::span<SurfacePoint> vertices) {
  const Rows rows{shape, holeRow(branch), branchRow(branch)};
  const std::uint32_t m = shape.branch[branch], hole = shape.rowStart(rows.first),
                      outline = outlineSize(layout.window[branch]);
  for (std::uint32_t k = 0; k < m; ++k) {
    const std::uint32_t outer = (k * outline + m / 2) / m;
    moveTo(vertices[hole + k].position, vertices[hole + (k + 1 == m ? 0 : k + 1)].position,
           vertices[hole + (k == 0 ? m : k) - 1].position,
           vertices[outlineVertex(shape, layout.window[branch], outer == outline ? 0 : outer)].position,
           vertices[hole + m + k].position);
  }
  for (std::uint32_t row = rows.first + 1; row < rows.last; ++row) smoothRow(rows, row, vertices);
  turnNormals(rows, vertices);
}

void smoothParts(const ForkShape& shape, const ForkLayout& layout, std::span<SurfacePoint> vertices) {
  for (std::uint32_t step = 0; step < shared::kMostSmoothings; ++step) {
    if (step < layout.steps.trunk) smoothTrunk(shape, vertices);
    for (std::uint32_t i = 0; i < shape.branchCount; ++i)
      if (step < layout.steps.collar[i]) smoothCollar(shape, layout, i, vertices);
  }
}

}  // namespace vasa
