#pragma once
#include "growth/plan.h"
#include "growth/regions.h"
#include "scene/scene.h"

namespace vasa {

struct SweepTable;

/// What a scene's capillaries grow from, and the regions that CapillaryBeds counts.
struct SceneGrowth : Growth {
  std::vector<GrowthRegion> regions;
};

/// Reads the rules of a folder (capillaries.lsys, regions.csv) and settles what grows where on the scene's
/// vessels: each span's region by the vessel's name and the joint it moves with, and the beds that the tissue
/// inside the skin and outside of bones is shared out among (scene/beds.h). Those take 304 bytes each;
/// capillaries themselves are stored nowhere. Beds are kept from run to run (core/kept.h).
/// @param table  makeSweepTable() of the scene's network
Result<SceneGrowth> loadGrowth(const Scene& scene, const std::filesystem::path& folder,
                               const SweepTable& table);

/// The two halves of it: reading, which may fail, and settling what grows where, which takes longer.
Result<SceneGrowth> readGrowth(const std::filesystem::path& folder);
void settleGrowth(SceneGrowth& growth, const Scene& scene, const SweepTable& table);

}  // namespace vasa
