#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "viewer/mannequin.h"

namespace vasa::viewer {

enum class VesselSystem : std::uint8_t { arteries, veins, portal, pulmonary, lymph, other };
constexpr std::array<std::string_view, 6> kSystemNames{"Arteries",  "Veins",         "Portal system",
                                                       "Pulmonary", "Lymph vessels", "Other vessels"};

/// Where in the body, from head to foot.
enum class BodyRegion : std::uint8_t {
  head,
  neck,
  chest,
  abdomen,
  pelvis,
  leftArm,
  leftForearm,
  leftHand,
  rightArm,
  rightForearm,
  rightHand,
  leftThigh,
  leftLeg,
  leftFoot,
  rightThigh,
  rightLeg,
  rightFoot,
  elsewhere
};
constexpr std::array<std::string_view, 18> kRegionNames{
    "Head",         "Neck",      "Chest",       "Abdomen",       "Pelvis",     "Left arm",
    "Left forearm", "Left hand", "Right arm",   "Right forearm", "Right hand", "Left thigh",
    "Left leg",     "Left foot", "Right thigh", "Right leg",     "Right foot", "Elsewhere"};

/// What each vessel belongs to.
struct VesselGroups {
  std::vector<VesselSystem> system;
  std::vector<BodyRegion> region;
};

/// By kinds and names, and by the joints that the vessels are bound to: a vessel lies where most of its
/// points do. O(points)
VesselGroups groupsOf(const Scene& scene, const Mannequin& mannequin);

}  // namespace vasa::viewer
