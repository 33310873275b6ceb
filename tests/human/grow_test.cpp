#include <algorithm>

#include "human/made_human.h"
#include "make_human/grow.h"
#include "make_human/organs.h"

using namespace vasa;
using namespace vasa::human;

TEST_CASE("growing ends where there is no room, again and again") {
  const Human& human = madeHuman();
  const std::filesystem::path tables = VASA_HUMAN_TABLES;
  const Surroundings around{human.skinShape, Solid(human.meshes[1].mesh), Solid(human.meshes[2].mesh)};
  Result<VesselRows> rows = VesselRows::read(tables / "vessels.csv", human.rig);
  REQUIRE(rows.ok());
  const Result<std::vector<BoneForm>> organs = readOrganForms(tables, human.rig);
  REQUIRE(organs.ok());
  const Result<std::vector<Region>> all = readRegions(tables / "growth.csv", *rows, human.rig, *organs);
  REQUIRE(all.ok());
  const auto ellipsoid = std::ranges::find(*all, Region::Shape::ellipsoid, &Region::shape);
  REQUIRE(ellipsoid != all->end());
  std::vector<Region> regions{*ellipsoid};
  regions[0].size = vec3(2e-3f);
  const Result<VesselLayout> layout = VesselLayout::make(*rows, around);
  REQUIRE(layout.ok());
  std::vector<LaidVessel> vessels = layout->fitted();
  const std::size_t laid = vessels.size();
  Grower grower(vessels, regions, around, {1'000'000, 1});
  grower.run();
  const std::size_t full = vessels.size();
  CHECK(full < laid + 1000);
  grower.run();
  CHECK(vessels.size() == full);
  CHECK(grower.finish().size() == full);
}
