#include "viewer/vessel_groups.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vasa::viewer {
namespace {

struct Place {
  std::string_view part;
  BodyRegion left, right;  // the same in the middle
};
using enum BodyRegion;
constexpr Place kPlaces[] = {
    {"head", head, head},
    {"neck", neck, neck},
    {"upperChest", chest, chest},
    {"chest", chest, chest},
    {"spine", abdomen, abdomen},
    {"hips", pelvis, pelvis},
    {"Shoulder", leftArm, rightArm},
    {"UpperArm", leftArm, rightArm},
    {"LowerArm", leftForearm, rightForearm},
    {"Hand", leftHand, rightHand},
    {"UpperLeg", leftThigh, rightThigh},
    {"LowerLeg", leftLeg, rightLeg},
    {"Foot", leftFoot, rightFoot},
    {"Toes", leftFoot, rightFoot},
    {"Thumb", leftHand, rightHand},
    {"Index", leftHand, rightHand},
    {"Middle", leftHand, rightHand},
};

BodyRegion regionOfPart(std::string_view part) {
  for (const Place& place : kPlaces) {
    if (part == place.part) return place.left;
    if (part.starts_with("left") && part.substr(4).starts_with(place.part)) return place.left;
    if (part.starts_with("right") && part.substr(5).starts_with(place.part)) return place.right;
  }
  return elsewhere;
}

VesselSystem systemOf(const Vessel& vessel) {
  if (vessel.name.find("pulmonary") != std::string::npos) return VesselSystem::pulmonary;
  switch (vessel.kind) {
    case VesselKind::artery:
      return VesselSystem::arteries;
    case VesselKind::vein:
      return VesselSystem::veins;
    case VesselKind::portalVein:
      return VesselSystem::portal;
    case VesselKind::lymphatic:
      return VesselSystem::lymph;
    case VesselKind::other:
      break;
  }
  return VesselSystem::other;
}

/// Where points lie, by their joints and places at rest.
class RegionFinder {
 public:
  RegionFinder(const Skeleton& skeleton, const Mannequin& mannequin) {
    for (std::uint32_t j = 0; j < skeleton.joints.size(); ++j) {
      JointId joint{j};
      while (joint.valid() && regionOfPart(mannequin.partOf(joint)) == elsewhere)
        joint = skeleton.joints[joint.value].parent;
      parts_.push_back(joint.valid() ? mannequin.partOf(joint) : std::string_view{});
    }
    const auto place = [&](std::string_view part) -> std::optional<vec3> {
      const JointId joint = mannequin.find(part);
      if (!joint.valid()) return std::nullopt;
      return vec3(skeleton.joints[joint.value].restWorld[3]);
    };
    const auto collar = place("leftShoulder"), arm = place("leftUpperArm"), low = place("chest"),
               high = place("upperChest");
    if (collar && arm) collar_ = collar->y, aside_ = kNearMiddle * std::abs(arm->x);
    if (low && high) diaphragm_ = glm::mix(low->y, high->y, kDiaphragm);
  }

  BodyRegion of(JointId joint, vec3 place) const {
    const std::string_view part = parts_[joint.value];
    if (part.ends_with("Shoulder") && std::abs(place.x) < aside_) return place.y > collar_ ? neck : chest;
    if (part == "chest" && place.y < diaphragm_) return abdomen;
    return regionOfPart(part);
  }

 private:
  static constexpr float kNearMiddle = 0.6f;  // of the way to the shoulder
  static constexpr float kDiaphragm = 0.4f;   // of the way from the lower to the upper ribs' joint
  std::vector<std::string_view> parts_;       // the joint's own, or that of the nearest one above it
  float collar_ = 0, aside_ = 0, diaphragm_ = 0;
};

}  // namespace

VesselGroups groupsOf(const Scene& scene, const Mannequin& mannequin) {
  const RegionFinder regions(scene.body.skeleton, mannequin);
  const std::vector<Station> stations = mainStations(scene.binding);
  VesselGroups groups;
  for (const Vessel& vessel : scene.network.vessels()) {
    std::array<std::uint32_t, kRegionNames.size()> count{};
    for (std::uint32_t p = vessel.firstPoint; p < vessel.firstPoint + vessel.pointCount; ++p)
      ++count[std::size_t(regions.of(stations[p].joint, vec3(scene.network.points()[p])))];
    groups.region.push_back(BodyRegion(std::ranges::max_element(count) - count.begin()));
    groups.system.push_back(systemOf(vessel));
  }
  return groups;
}

}  // namespace vasa::viewer
