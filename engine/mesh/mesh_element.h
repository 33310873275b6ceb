#pragma once
#include <optional>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace vasa {

/// What a run of an element's triangles is drawn with.
struct MeshMaterial {
  std::string name;
  std::optional<vec3> colour;       ///< linear
  std::uint32_t firstTriangle = 0;  ///< the run ends where the next one begins
};

/// One named piece of a mesh file: a vessel, a bone, an organ.
struct MeshElement {
  std::string name;        ///< as the file has it, e.g. "FJ1654 right anterior cerebral artery"
  std::string category;    ///< what the file says it is, e.g. "artery"; empty where it says nothing
  std::string ontologyId;  ///< e.g. "FMA50029"; empty where unknown
  TriangleMesh mesh;       ///< house units: metres, +Y up
  std::vector<std::string> surroundings;  ///< what it belongs to: names of its mesh, the nodes above it from
                                          ///< near to far, its materials
  std::optional<vec3> colour;             ///< of its first material, linear; none where the file gives none
  std::vector<MeshMaterial> materials;    ///< in order; empty where the file gives none
};

}  // namespace vasa
