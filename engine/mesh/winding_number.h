#pragma once
#include <span>
#include <vector>

#include "math/triangle_pair.h"
#include "math/types.h"

namespace vasa {

/// How often a triangle mesh winds around a point: 1 inside a closed surface, 0 outside. Meshes that are
/// open, overlap or hold the same face twice still give about the number that an eye would (Jacobson, Kavan,
/// Sorkine-Hornung 2013), where the nearest triangle's normal would say anything. Method: solid angles of
/// near triangles; of a group of far ones only the dipole (Barill et al. 2018), error some hundredths.
class WindingNumber {
 public:
  /// @param triangles  counter-clockwise from outside
  /// O(n log n)
  WindingNumber(std::span<const vec3> positions, std::span<const uvec3> triangles);

  /// O(log n)
  float at(vec3 point) const;

  /// Adds all triangles that come within reach of a point, and some that do not.
  void addNear(vec3 point, float reach, std::vector<Triangle>& near) const;

 private:
  struct Node {
    std::uint32_t first, last;  // triangles, half open
    std::uint32_t second;       // the first child is the next node; 0: a leaf
    vec3 centre;
    float radius;
    vec3 dipole;  // sum of areas times normals
  };
  static void halve(std::span<Triangle> triangles);
  void build(std::uint32_t first, std::uint32_t last);

  std::vector<Triangle> triangles_;  // as the leaves hold them
  std::vector<Node> nodes_;          // parents first
};

}  // namespace vasa
