#pragma once
#include "growth/plan.h"
#include "growth/regions.h"
#include "scene/scene.h"

namespace vasa {

struct SweepTable;

/// What growth is loaded for. Counting needs no walls and no reach, which take by far the longest to find.
enum class GrowthUse { drawn, counted };

/// What a scene's capillaries grow from, and the regions that CapillarySites::region counts.
struct SceneGrowth : Growth {
  std::vector<GrowthRegion> regions;
};

/// Reads the rules of a folder (capillaries.lsys, regions.csv) and settles what grows where on the scene's
/// vessels: each span's region by the vessel's name and the joint it moves with, its hub and axis by the
/// body's limbs, its walls by the nearest skin, its partner by the nearest vessel of the other kind. All of
/// that is 150 bytes a span; capillaries themselves are stored nowhere. Walls are kept from run to run
/// (core/kept.h).
/// @param table  makeSweepTable() of the scene's network
Result<SceneGrowth> loadGrowth(const Scene& scene, const std::filesystem::path& folder,
                               const SweepTable& table, GrowthUse use = GrowthUse::drawn);
Result<SceneGrowth> loadGrowth(const Scene& scene, const std::filesystem::path& folder);

/// The two halves of it: reading, which may fail, and settling what grows where, which takes longer.
Result<SceneGrowth> readGrowth(const Scene& scene, const std::filesystem::path& folder);
void settleGrowth(SceneGrowth& growth, const Scene& scene, const SweepTable& table,
                  GrowthUse use = GrowthUse::drawn);

/// The same from rules at hand.
CapillarySites growthSites(const Scene& scene, const GrowthRules& rules,
                           const std::vector<GrowthRegion>& regions, const SweepTable& table,
                           GrowthUse use = GrowthUse::drawn);

}  // namespace vasa
