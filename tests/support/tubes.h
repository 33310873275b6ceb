#pragma once
#include <cmath>
#include <functional>
#include <random>

#include "mesh/triangle_mesh.h"

// Tubes with known axes, for tests of what reads meshes.
namespace vasa::test {

enum class TubeEnds { open, flat };

/// A tube around a curve: rings of `sides` vertices at t = 0 .. 1 in `steps` steps, triangles facing
/// outwards.
inline TriangleMesh tube(const std::function<vec3(float)>& axis, const std::function<float(float)>& radius,
                         int steps, int sides, TubeEnds ends = TubeEnds::flat) {
  TriangleMesh mesh;
  vec3 reference = anyPerpendicular(glm::normalize(axis(1e-3f) - axis(0)));
  for (int i = 0; i <= steps; ++i) {
    const float t = float(i) / float(steps);
    const vec3 tangent = glm::normalize(axis(t + 1e-3f) - axis(t - 1e-3f));
    reference = glm::normalize(reference - glm::dot(reference, tangent) * tangent);
    const vec3 v = glm::cross(tangent, reference);
    for (int k = 0; k < sides; ++k) {
      const float angle = 2 * kPi * float(k) / float(sides);
      mesh.positions.push_back(axis(t) + radius(t) * (std::cos(angle) * reference + std::sin(angle) * v));
    }
  }
  const auto at = [&](int i, int k) { return std::uint32_t(i * sides + k % sides); };
  for (int i = 0; i < steps; ++i)
    for (int k = 0; k < sides; ++k) {
      mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  if (ends == TubeEnds::flat) {
    for (const bool last : {false, true}) {
      const auto apex = std::uint32_t(mesh.positions.size());
      mesh.positions.push_back(axis(last ? 1.0f : 0.0f));
      for (int k = 0; k < sides; ++k) {
        const std::uint32_t a = at(last ? steps : 0, k), b = at(last ? steps : 0, k + 1);
        mesh.triangles.push_back(last ? uvec3(apex, a, b) : uvec3(apex, b, a));
      }
    }
  }
  return mesh;
}

inline TriangleMesh straightTube(float length, float radius, TubeEnds ends = TubeEnds::flat) {
  return tube([=](float t) { return vec3(0, 0, t * length); }, [=](float) { return radius; }, 40, 16, ends);
}

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto base = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const uvec3& t : other.triangles) mesh.triangles.push_back(t + base);
}

/// The same surface, its vertices and triangles in another order and the triangles' corners turned.
inline TriangleMesh shuffled(const TriangleMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> order(mesh.positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  TriangleMesh result;
  result.positions.resize(mesh.positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) result.positions[order[i]] = mesh.positions[i];
  for (const uvec3& t : mesh.triangles) {
    const uvec3 moved(order[t.x], order[t.y], order[t.z]);
    const int turn = int(random() % 3);
    result.triangles.push_back({moved[turn], moved[(turn + 1) % 3], moved[(turn + 2) % 3]});
  }
  for (std::size_t i = result.triangles.size(); i > 1; --i)
    std::swap(result.triangles[i - 1], result.triangles[random() % i]);
  return result;
}

/// The surface field(p) = 0 (negative inside) in a box, by tetrahedra six to a cube: irregular triangles as
/// from a scan. Vertices are shared, outward orientation.
TriangleMesh isosurface(const std::function<float(vec3)>& field, vec3 low, vec3 high, float cell);

/// Distance to a capsule: a tube from a to b with round ends.
inline float capsuleDistance(vec3 p, vec3 a, vec3 b, float radius) {
  const vec3 ab = b - a;
  const float t = glm::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
  return glm::distance(p, a + t * ab) - radius;
}

/// One surface as from a scan: a trunk that ends in two legs, with a branch on its side, wall flowing into
/// wall.
TriangleMesh forkedSurface();

}  // namespace vasa::test
