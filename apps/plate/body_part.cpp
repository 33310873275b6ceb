#include "plate/body_part.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "body/humanoid.h"

namespace vasa::plate {
namespace {

using enum BodyPart;

// How a part's name in VRM's words ends; the first that fits.
constexpr std::array<std::pair<std::string_view, BodyPart>, 15> kWords{{{"hips", abdomen},
                                                                        {"spine", abdomen},
                                                                        {"chest", thorax},
                                                                        {"upperChest", thorax},
                                                                        {"neck", neck},
                                                                        {"head", head},
                                                                        {"Shoulder", shoulder},
                                                                        {"UpperArm", upperArm},
                                                                        {"LowerArm", lowerArm},
                                                                        {"Hand", hand},
                                                                        {"Proximal", hand},
                                                                        {"UpperLeg", upperLeg},
                                                                        {"LowerLeg", lowerLeg},
                                                                        {"Foot", foot},
                                                                        {"Toes", foot}}};

std::vector<SidedPart> partsBy(const Body& body, std::span<const std::string_view> names) {
  std::vector<SidedPart> parts;
  for (std::size_t j = 0; j < names.size(); ++j) {
    const JointId parent = body.skeleton.joints[j].parent;
    SidedPart part = parent.valid() ? parts[parent.value] : SidedPart{};
    for (const auto& [word, meant] : kWords)
      if (names[j].ends_with(word)) {
        part = {meant, names[j].starts_with("left") ? 1 : names[j].starts_with("right") ? -1 : 0};
        break;
      }
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

Result<std::vector<SidedPart>> partsOfJoints(const Body& body) {
  std::vector<std::string> names;
  for (const auto& joint : body.skeleton.joints) names.push_back(joint.name);
  const HumanoidNames known = humanoidNames(names);
  if (humanoidKeys(known.of) < kHumanoidKeys)
    return badInput(
        body.name +
        ": its joints are not all recognised as a person's by their names, so its regions are not "
        "known; choose front or back");
  return partsBy(body, known.of);
}

std::vector<std::uint16_t> mainJoints(const SkinnedMesh& mesh) {
  std::vector<std::uint16_t> joints;
  joints.reserve(mesh.influences.size());
  for (const SkinInfluence& influence : mesh.influences) {
    int most = 0;
    for (int k = 1; k < 4; ++k)
      if (influence.weights[k] > influence.weights[most]) most = k;
    joints.push_back(influence.joints[std::size_t(most)]);
  }
  return joints;
}

}  // namespace vasa::plate
