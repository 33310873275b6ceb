#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "atlas/body_region.h"
#include "scene/scene.h"

namespace vasa::atlas {

enum class VesselSystem : std::uint8_t { arteries, veins, portal, pulmonary, lymph, other };
constexpr std::array<std::string_view, 6> kSystemNames{"Arteries",  "Veins",         "Portal system",
                                                       "Pulmonary", "Lymph vessels", "Other vessels"};

/// By its kind, and of the lungs by its name.
VesselSystem systemOf(const Vessel& vessel);

/// What each vessel belongs to.
struct VesselGroups {
  std::vector<VesselSystem> system;
  std::vector<BodyRegion> region;   ///< where most of its points lie
  std::vector<BodyRegion> ofPoint;  ///< of each of the network's points
  bool person = false;              ///< regions are known (RegionFinder::knowsPerson)
};

/// By kinds and names, and by the joints that the points are bound to. O(points)
VesselGroups groupsOf(const Scene& scene);

}  // namespace vasa::atlas
