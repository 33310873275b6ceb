#include "body/rib_heads.h"

#include <algorithm>
#include <array>

#include "body/axial_bones.h"
#include "body/trunk.h"

namespace vasa {

std::vector<vec3> ribHeads(Body body) {
  constexpr std::size_t kRibs = 12;
  const Rig rig = rigOf(body.skeleton);
  const Trunk trunk = findTrunk(rig);
  const std::uint32_t left = rig.partNamed("leftUpperArm"), right = rig.partNamed("rightUpperArm");
  if (!trunk.known() || left == kNone || right == kNone) return {};
  if (body.axialBones.empty()) separateAxialBones(body);
  std::array<std::vector<vec3>, 2> sides;
  for (const AxialBone& bone : body.axialBones)
    if (bone.vertebra != kNone) {
      const bool isRight =
          glm::distance(bone.place, rig.centres[right]) < glm::distance(bone.place, rig.centres[left]);
      sides[isRight].push_back(bone.root);
    }
  std::vector<vec3> heads;
  for (std::vector<vec3>& side : sides) {
    if (side.size() != kRibs) return {};
    std::ranges::sort(side, {}, [&](vec3 head) { return glm::dot(head, trunk.way(rig.centres)); });
    heads.insert(heads.end(), side.begin(), side.end());
  }
  return heads;
}

}  // namespace vasa
