#include "atlas/body_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "body/humanoid.h"
#include "body/retarget.h"

namespace vasa::atlas {
namespace {

using enum BodyPart;

constexpr std::array<BodyRegion, 20> kRegions{
    {{head},       {neck},    {chest},        {abdomen},      {pelvis},      {shoulder, 1}, {upperArm, 1},
     {forearm, 1}, {hand, 1}, {shoulder, -1}, {upperArm, -1}, {forearm, -1}, {hand, -1},    {thigh, 1},
     {leg, 1},     {foot, 1}, {thigh, -1},    {leg, -1},      {foot, -1},    {elsewhere}}};
constexpr std::array<std::string_view, 13> kNames{"head",     "neck",      "chest",    "abdomen", "pelvis",
                                                  "shoulder", "upper arm", "forearm",  "hand",    "thigh",
                                                  "leg",      "foot",      "elsewhere"};

// How a joint's word ends (body/humanoid.h); the first that fits. Fingers go with the hand that they hang on.
constexpr std::array<std::pair<std::string_view, BodyPart>, 14> kWords{{{"hips", pelvis},
                                                                        {"spine", abdomen},
                                                                        {"upperChest", chest},
                                                                        {"chest", chest},
                                                                        {"neck", neck},
                                                                        {"head", head},
                                                                        {"Shoulder", shoulder},
                                                                        {"UpperArm", upperArm},
                                                                        {"LowerArm", forearm},
                                                                        {"Hand", hand},
                                                                        {"UpperLeg", thigh},
                                                                        {"LowerLeg", leg},
                                                                        {"Foot", foot},
                                                                        {"Toes", foot}}};

constexpr float kNearMiddle = 0.6f;  // of the way to the shoulder
constexpr float kDiaphragm = 0.4f;   // of the way from the lower to the upper ribs' joint

}  // namespace

std::span<const BodyRegion> bodyRegions() { return kRegions; }

std::size_t rankOf(BodyRegion region) {
  return std::size_t(std::ranges::find(kRegions, region) - kRegions.begin());
}

std::string nameOf(BodyRegion region) {
  std::string name = region.side == 0 ? "" : region.side > 0 ? "left " : "right ";
  name += kNames[std::size_t(region.part)];
  name.front() = char(name.front() - 'a' + 'A');
  return name;
}

RegionFinder::RegionFinder(const Skeleton& skeleton) {
  const std::vector<std::string_view> words = partsOf(skeleton).of;
  person_ = humanoidKeys(words) == kHumanoidKeys;
  for (std::size_t j = 0; j < words.size(); ++j) {
    const JointId parent = skeleton.joints[j].parent;
    BodyRegion region = parent.valid() ? regions_[parent.value] : BodyRegion{};
    for (const auto& [word, part] : kWords)
      if (words[j].ends_with(word)) {
        region = {part, words[j].starts_with("left") ? 1 : words[j].starts_with("right") ? -1 : 0};
        break;
      }
    regions_.push_back(region);
  }
  const auto find = [&](std::string_view word) {
    const auto found = std::ranges::find(words, word);
    return found == words.end() ? JointId{} : JointId{std::uint32_t(found - words.begin())};
  };
  const auto place = [&](JointId joint) { return vec3(skeleton.joints[joint.value].restWorld[3]); };
  const JointId collar = find("leftShoulder"), arm = find("leftUpperArm"), high = find("upperChest");
  if (collar.valid() && arm.valid()) collar_ = place(collar).y, aside_ = kNearMiddle * std::abs(place(arm).x);
  lowChest_ = find("chest");
  if (!high.valid()) lowChest_ = {};
  if (lowChest_.valid()) diaphragm_ = glm::mix(place(lowChest_).y, place(high).y, kDiaphragm);
}

BodyRegion RegionFinder::of(JointId joint, vec3 place) const {
  const BodyRegion region = of(joint);
  if (region.part == shoulder && std::abs(place.x) < aside_) return {place.y > collar_ ? neck : chest};
  if (joint == lowChest_ && place.y < diaphragm_) return {abdomen};
  return region;
}

}  // namespace vasa::atlas
