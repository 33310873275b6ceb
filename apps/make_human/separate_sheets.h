#pragma once
#include "mesh/triangle_mesh.h"

namespace vasa::human {

/// Where two sheets meet in one edge of four triangles, pairs the triangles that bound the same piece of the
/// solid and gives each further pair an edge of its own. Afterwards every edge has two triangles.
void separateSheets(TriangleMesh& mesh);

}  // namespace vasa::human
