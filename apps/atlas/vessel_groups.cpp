#include "atlas/vessel_groups.h"

#include <algorithm>
#include <cctype>

namespace vasa::atlas {
namespace {

bool ofLungs(std::string_view name) {
  constexpr std::string_view kWord = "pulmonary";
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::search(name.begin(), name.end(), kWord.begin(), kWord.end(), same) != name.end();
}

}  // namespace

VesselSystem systemOf(const Vessel& vessel) {
  if (ofLungs(vessel.name)) return VesselSystem::pulmonary;
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

VesselGroups groupsOf(const Scene& scene) {
  const RegionFinder regions(scene.body.skeleton);
  const std::vector<Station> stations = mainStations(scene.binding);
  VesselGroups groups;
  groups.person = regions.knowsPerson();
  for (std::size_t p = 0; p < stations.size(); ++p)
    groups.ofPoint.push_back(regions.of(stations[p].joint, vec3(scene.network.points()[p])));
  for (const Vessel& vessel : scene.network.vessels()) {
    std::vector<std::uint32_t> count(bodyRegions().size());
    for (std::uint32_t p = vessel.firstPoint; p < vessel.firstPoint + vessel.pointCount; ++p)
      ++count[rankOf(groups.ofPoint[p])];
    groups.region.push_back(bodyRegions()[std::size_t(std::ranges::max_element(count) - count.begin())]);
    groups.system.push_back(systemOf(vessel));
  }
  return groups;
}

}  // namespace vasa::atlas
