#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "growth/growth_rules.h"
#include "network/network.h"

namespace vasa {

/// A row of the table that says which rules grow where.
struct GrowthRegion {
  static constexpr std::uint32_t kNoSystem = 0xffu;  ///< nothing grows around its vessels

  std::string name;
  std::uint32_t system = kNoSystem;
  std::vector<std::string> joints;   ///< parts of joints' names; empty: all
  std::vector<std::string> vessels;  ///< parts of vessels' names, or whole ontology ids; empty: all.
                                     ///< Of an organ: those that feed it
  std::vector<VesselKind> kinds;     ///< empty: all
  float thinnest = 0, thickest = 0;  ///< [m] radii of vessels that trees hang on
  float bed = 0;                     ///< [m] side of a cube as large as a bed
  bool inBone = false;               ///< bones are its surface, as the skull is the brain's; else the skin
  std::vector<std::string> organs;   ///< parts of names of the meshes that it fills
  float wall = 0;                    ///< [m] how deep below such a mesh's surface; 0: all of it
};

struct RegionQuestion {
  std::string_view vessel, ontologyId, joint;
  VesselKind kind = VesselKind::other;
};

/// The first region whose joints, vessels and kinds fit, none that fills organs; nullptr if there is none.
/// Upper and lower case are alike.
const GrowthRegion* regionOf(const std::vector<GrowthRegion>& regions, const RegionQuestion& question);

/// Whether the region's vessels are these, by a part of the name or the whole id; of an organ, whether the
/// vessel is its own.
bool namesVessel(const GrowthRegion& region, std::string_view vessel, std::string_view ontologyId);

/// The first region that fills the organ of a mesh; nullptr if there is none.
const GrowthRegion* regionOfOrgan(const std::vector<GrowthRegion>& regions, std::string_view mesh);

/// Reads the table: see data/growth/regions.csv. Lengths are for a body 1.75 m tall. badInput names file,
/// line, cause and remedy.
Result<std::vector<GrowthRegion>> parseRegions(std::string_view text, const std::string& name,
                                               const GrowthRules& rules);
Result<std::vector<GrowthRegion>> readRegions(const std::filesystem::path& path, const GrowthRules& rules);

}  // namespace vasa
