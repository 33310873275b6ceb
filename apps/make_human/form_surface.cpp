#include "make_human/form_surface.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <map>

#include "make_human/polygonise.h"
#include "make_human/separate_sheets.h"

namespace vasa::human {
namespace {

constexpr float kCertain = 3;           // distances to a form's pieces are off by less than this factor
constexpr float kFineReach = 1.3f;      // how far beyond a leaf a piece's wish for fine polygons counts
constexpr float kLargestCell = 16e-3f;  // [m] largest polygon
constexpr float kKeptShare = 0.3f;      // of the triangles, at least

/// Takes out pairs of triangles that lie on one another back to back: what is left of a fold.
void dropFolds(std::vector<uvec3>& triangles) {
  std::map<std::array<std::uint32_t, 3>, std::vector<std::size_t>> byCorners;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<std::uint32_t, 3> corners{triangles[i].x, triangles[i].y, triangles[i].z};
    std::sort(corners.begin(), corners.end());
    byCorners[corners].push_back(i);
  }
  std::vector<char> folded(triangles.size(), 0);
  for (const auto& [corners, owners] : byCorners)
    for (std::size_t k = 0; k + 1 < owners.size(); k += 2) folded[owners[k]] = folded[owners[k + 1]] = 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!folded[i]) triangles[kept++] = triangles[i];
  triangles.resize(kept);
}

// Flat places need fewer polygons than the octree gives them: the cheapest edges go.
TriangleMesh thinned(const TriangleMesh& mesh, float error) {
  std::vector<uvec3> fewer(mesh.triangles.size());
  const float* first = &mesh.positions[0].x;
  const float scale = meshopt_simplifyScale(first, mesh.positions.size(), sizeof(vec3));
  const std::size_t wanted = 3 * std::size_t(kKeptShare * float(fewer.size()));
  fewer.resize(meshopt_simplify(&fewer[0].x, &mesh.triangles[0].x, 3 * fewer.size(), first,
                                mesh.positions.size(), sizeof(vec3), wanted, error / scale, 0, nullptr) /
               3);
  dropFolds(fewer);
  TriangleMesh result;
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> numbers(mesh.positions.size(), kUnused);
  for (uvec3 t : fewer) {
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& number = numbers[t[k]];
      if (number == kUnused) {
        number = std::uint32_t(result.positions.size());
        result.positions.push_back(mesh.positions[t[k]]);
      }
      t[k] = number;
    }
    result.triangles.push_back(t);
  }
  separateSheets(result);
  return result;
}

/// The form's own slope is smoother than the polygons'; in a sharp groove it may point elsewhere.
std::vector<vec3> smoothNormals(const BoneForm& form, const TriangleMesh& mesh) {
  std::vector<vec3> normals = vertexNormals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const vec3 slope = form.gradient(mesh.positions[i]);
    const float length = glm::length(slope);
    if (length > 0.05f && glm::dot(slope, normals[i]) > 0.5f * length) normals[i] = slope / length;
  }
  return normals;
}

/// The octree's largest leaf, so that its smallest is the finest cell.
float coarseCell(float finest) {
  float cell = finest;
  for (int level = 0; level < 3 && 2 * cell <= kLargestCell; ++level) cell *= 2;
  return cell;
}

}  // namespace

FormSurface surfaceOf(const BoneForm& form, float thinningError) {
  FormSurface result;
  const ImplicitSurface surface{[&](vec3 p) { return form.distance(p); },
                                [&](vec3 p, float reach) { return form.cellSize(p, kFineReach * reach); },
                                form.bounds(), kCertain};
  result.mesh = thinned(polygonise(surface, coarseCell(form.finestCell())), thinningError);
  result.normals = smoothNormals(form, result.mesh);
  return result;
}

}  // namespace vasa::human
