#pragma once
#include "make_human/bone_form.h"
#include "mesh/triangle_mesh.h"

namespace vasa::human {

/// A form as a closed smooth mesh with unit normals.
struct FormSurface {
  TriangleMesh mesh;
  std::vector<vec3> normals;
};

/// @param thinningError  [m] how far triangles may move when half of them are taken out
FormSurface surfaceOf(const BoneForm& form, float thinningError);

}  // namespace vasa::human
