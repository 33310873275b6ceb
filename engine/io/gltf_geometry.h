#pragma once
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf_asset.h"
#include "mesh/triangle_mesh.h"

namespace vasa::gltf {

/// The triangles of one or more primitives, as the file has them.
struct Geometry {
  TriangleMesh mesh;
  std::vector<vec3> normals;  ///< unit, one a vertex; from the triangles where the file has none
  /// One a vertex, empty for what is not skinned: up to four joints of the node's skin, weights that sum
  /// to 1.
  struct Influence {
    std::array<std::uint32_t, 4> joints{};
    vec4 weights{0};
  };
  std::vector<Influence> influences;
  std::vector<std::uint32_t> vessels;  ///< one a vertex: of Model::Mesh::vessels, kNone where none is told
  std::size_t mendedWeights = 0;       ///< vertices whose weights did not sum to 1
};

/// Adds a primitive's triangles (lists, strips and fans, indexed or not). Points and lines add nothing.
/// Corners of strips that are no triangle are left out.
/// @param weights  how far morph targets are in; more of either than of the other count for nothing
/// @param skinned  read joints and weights; the primitive has them
void appendPrimitive(const Asset& asset, const Model::Primitive& primitive, std::span<const float> weights,
                     bool skinned, Geometry& geometry);

/// Moves positions and normals; where the transform mirrors, turns the triangles over so that they keep
/// facing out.
void transform(Geometry& geometry, const mat4& by);

}  // namespace vasa::gltf
