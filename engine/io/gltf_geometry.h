#pragma once
#include <array>
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
  std::size_t mendedWeights = 0;  ///< vertices whose weights did not sum to 1
};

/// How much geometry all primitives of a file may expand to: a few bytes of JSON can name a mesh any number
/// of times.
class Budget {
 public:
  /// Throws BrokenRule when the sum of all calls exceeds the limits.
  void spend(std::size_t vertices, std::size_t triangles, const std::string& place);

 private:
  std::size_t vertices_ = std::size_t(1) << 25;
  std::size_t triangles_ = std::size_t(1) << 26;
};

/// Adds a primitive's triangles (lists, strips and fans, indexed or not). Points and lines add nothing.
/// Corners of strips that are no triangle are left out.
/// @param skinned  read joints and weights; the primitive has them
/// @param place    of the primitive, for messages
void appendPrimitive(const Asset& asset, const tinygltf::Primitive& primitive, bool skinned,
                     const std::string& place, Budget& budget, Geometry& geometry);

/// Moves positions and normals; where the transform mirrors, turns the triangles over so that they keep
/// facing out.
void transform(Geometry& geometry, const mat4& by);

}  // namespace vasa::gltf
