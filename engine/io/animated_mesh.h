#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "math/types.h"

namespace vasa {

/// A mesh in parts, each of one colour, that changes its shape over time: what files for other programs hold.
/// At key i it is positions + Σ weights[i][k] · shapes[k]; between keys weights change linearly.
struct AnimatedMesh {
  struct Part {
    std::string name;
    vec3 colour{0.8f};  ///< linear
    std::vector<uvec3> triangles;
  };
  struct Label {
    std::string name, kind, ontologyId;
  };
  std::string name;
  std::vector<vec3> positions, normals;      ///< [m], unit; normals may be empty
  std::vector<Part> parts;                   ///< not empty, none without triangles
  std::vector<std::uint16_t> labelOfVertex;  ///< into labels; one a vertex, or none at all
  std::vector<Label> labels;
  std::string clip;
  std::vector<float> times;                 ///< [s] increasing; empty: it does not move
  std::vector<std::vector<float>> weights;  ///< a row a time
  std::vector<std::vector<vec3>> shapes,
      normalShapes;  ///< displacements, one a vertex; normalShapes may be empty
};

/// A binary glTF 2.0 file: one node with one mesh, a primitive and material a part over shared vertices,
/// morph targets and an animation of their weights. The vertex attribute _VESSEL numbers the labels, which
/// the mesh's extras list as "vessels" (name, kind, id). Uses no extension.
std::vector<std::byte> encodeGlb(const AnimatedMesh& mesh);

/// A Wavefront OBJ text of the mesh at its first key: an object for each label, its material named by its
/// kind, vertices and normals shared.
std::string encodeObj(const AnimatedMesh& mesh);

/// A binary STL file of the mesh at its first key, one solid. @param unit  [m] of its numbers
std::vector<std::byte> encodeStl(const AnimatedMesh& mesh, double unit);

}  // namespace vasa
