#include "support/meshes.h"

namespace vasa::test {

SkinnedMesh boxMesh(std::string name, vec3 low, vec3 high) {
  SkinnedMesh box;
  box.name = std::move(name);
  const vec3 centre = 0.5f * (low + high), half = 0.5f * (high - low);
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      vec3 normal(0), u(0), v(0);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = side;  // u x v = normal
      const std::uint32_t first = std::uint32_t(box.mesh.positions.size());
      for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
        box.mesh.positions.push_back(centre + half * (normal + corner.x * u + corner.y * v));
        box.normals.push_back(normal);
        box.influences.push_back({{0, 0, 0, 0}, {1, 0, 0, 0}});
      }
      box.mesh.triangles.push_back({first, first + 1, first + 2});
      box.mesh.triangles.push_back({first, first + 2, first + 3});
    }
  return box;
}

}  // namespace vasa::test
