#include "body/body.h"

#include "body/skinning.h"
#include "body/trunk.h"
#include "math/aabb.h"

namespace vasa {

float Body::height() const {
  const Pose rest = restPose(skeleton);
  const auto matrices = skinMatrices(*this, rest);
  Aabb box;
  std::vector<vec3> positions;
  for (const SkinnedMesh& mesh : meshes) {
    skinPositions(mesh, matrices, positions);
    for (const vec3 p : positions) box.add(p);
  }
  if (box.empty())
    for (const mat4& joint : rest.world) box.add(vec3(joint[3]));
  return box.empty() ? 0 : box.extent()[uprightAxis(rigOf(skeleton))];
}

}  // namespace vasa
