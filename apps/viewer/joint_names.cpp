#include "viewer/joint_names.h"

namespace vasa::viewer {
namespace {

struct Word {
  std::string_view part, name;
};
constexpr Word kMiddle[] = {
    {"hips", "pelvis"},           {"spine", "lower back"}, {"chest", "middle back"},
    {"upperChest", "upper back"}, {"neck", "neck"},        {"head", "head"},
};
constexpr Word kSides[] = {
    {"Shoulder", "collar bone"},
    {"UpperArm", "shoulder"},
    {"LowerArm", "elbow"},
    {"Hand", "wrist"},
    {"UpperLeg", "hip"},
    {"LowerLeg", "knee"},
    {"Foot", "ankle"},
    {"Toes", "toes"},
    {"ThumbProximal", "thumb"},
    {"IndexProximal", "index finger"},
    {"MiddleProximal", "middle finger"},
};

}  // namespace

std::string peoplesName(std::string_view part) {
  for (const Word& word : kMiddle)
    if (part == word.part) return std::string(word.name);
  for (const std::string_view side : {"left", "right"})
    for (const Word& word : kSides)
      if (part.starts_with(side) && part.substr(side.size()) == word.part)
        return std::string(side) + " " + std::string(word.name);
  return "";
}

const char* wordForAxis(std::string_view part, int axis) {
  if (axis == 0) return "flexion";
  if (axis == 2) return "rotation";
  const bool side = part.starts_with("left") || part.starts_with("right");
  return side && !part.ends_with("Hand") ? "abduction" : "side bend";
}

vec3 sensesOf(std::string_view part) {
  return {part.ends_with("LowerLeg") ? -1 : 1, part.starts_with("left") ? -1 : 1,
          part.starts_with("right") ? -1 : 1};
}

}  // namespace vasa::viewer
