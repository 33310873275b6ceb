#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "capillary_filling.h"
#include "growth/capillary.h"
#include "scene/growth.h"
#include "scene_human.h"

using namespace vasa;

namespace {

struct Grown {
  Grown()
      : table(makeSweepTable(human().network)),
        growth([&] {
          auto loaded = loadGrowth(human(), VASA_GROWTH_DATA, table);
          REQUIRE_MESSAGE(loaded.ok(), (loaded.ok() ? "" : loaded.error().message));
          return std::move(*loaded);
        }()),
        frames(table.knotCount) {
    const Network& network = human().network;
    networkFrames(network, network.points(), restReferences(network), frames);
  }
  PosedNetwork rest() const { return {table, human().network.points(), frames}; }

  SweepTable table;
  SceneGrowth growth;
  std::vector<quat> frames;
};

const Grown& grown() {
  static const Grown one;
  return one;
}

}  // namespace

TEST_CASE("nearly every end of the human's capillaries meets one of the other kind") {
  const CapillaryBeds& beds = grown().growth.beds;
  const PosedNetwork rest = grown().rest();
  const GrowthScene scene{rest, grown().growth.rules.tables, beds.spans, beds.beds};
  constexpr std::uint32_t kLevels = 3;
  std::size_t ends = 0, open = 0;
  for (std::uint32_t bed = 0; bed < beds.beds.size(); ++bed)
    for (const BedSide side : kBedSides) {
      const auto& other = beds.beds[bed].stem[1 - std::size_t(side)];
      if (beds.beds[bed].stem[std::size_t(side)].from == shared::kNoStem) continue;
      const std::uint32_t size = grown().growth.rules.treeSize(beds.beds[bed].system, kLevels);
      for (std::uint32_t k = 0; k < size; ++k) {
        const Capillary curve = capillaryAt(scene, bed, side, kLevels, k);
        if (!curve.leaf) continue;
        ++ends;
        open += other.from == shared::kNoStem ||
                vec3(curve.curve.b[3]) !=
                    vec3(capillaryAt(scene, bed, kBedSides[1 - std::size_t(side)], kLevels, k).curve.b[3]);
      }
    }
  MESSAGE(beds.beds.size() << " beds, " << ends << " ends, open: " << open);
  CHECK(ends > 200'000);
  CHECK(double(open) < 0.02 * double(ends));
}

TEST_CASE(
    "the human's capillaries stay inside the skin and out of bones and airways, and fill flesh and organs") {
  const CapillaryBeds& beds = grown().growth.beds;
  const PosedNetwork rest = grown().rest();
  const GrowthScene scene{rest, grown().growth.rules.tables, beds.spans, beds.beds};
  std::vector<Bezier> curves;
  for (std::uint32_t bed = 0; bed < beds.beds.size(); ++bed)
    for (const BedSide side : kBedSides) {
      if (beds.beds[bed].stem[std::size_t(side)].from == shared::kNoStem) continue;
      const std::uint32_t size = grown().growth.rules.treeSize(beds.beds[bed].system, 3);
      for (std::uint32_t k = 0; k < size; ++k) curves.push_back(capillaryAt(scene, bed, side, 3, k).curve);
    }
  const test::Filling filling = test::FillingMeter(human()).measure(curves);
  MESSAGE(curves.size() << " curves, of " << filling.places << " places out of the skin: " << filling.outside
                        << ", in bone: " << filling.inBone << ", filled of thigh: " << filling.thigh
                        << ", scalp: " << filling.scalp << ", brain: " << filling.brain << ", lungs: "
                        << filling.lungs << ", liver: " << filling.liver << ", kidneys: " << filling.kidneys
                        << ", heart: " << filling.heart << ", windpipe: " << filling.windpipe);
  CHECK(double(filling.outside) < 0.0005 * double(filling.places));
  CHECK(double(filling.inBone) < 0.005 * double(filling.places));
  CHECK(filling.thigh > 0.95);
  CHECK(filling.scalp > 0.85);
  CHECK(filling.brain > 0.9);
  CHECK(filling.lungs > 0.9);
  CHECK(filling.liver > 0.9);
  CHECK(filling.kidneys > 0.9);
  CHECK(filling.heart > 0.9);
  CHECK(filling.windpipe < 0.015);
}

TEST_CASE("an organ's capillaries hang on its own vessels, not on those that run through it") {
  const CapillaryBeds& beds = grown().growth.beds;
  const PosedNetwork rest = grown().rest();
  struct Owner {
    std::string organ, region;
    std::vector<const char*> vessels;  // parts of names
  };
  for (const Owner& owner :
       {Owner{"left lung", "lungs", {"pulmonary", "bronchial", "lingular"}},
        {"right lung", "lungs", {"pulmonary", "bronchial", "lingular"}},
        {"liver", "liver", {"hepatic", "portal", "liver"}},
        {"kidney", "kidneys", {"renal", "kidney"}},
        {"spleen", "spleen", {"splen", "spleen"}},
        {"pancreas", "pancreas", {"pancrea", "splenic"}},
        {"stomach", "stomach", {"gastr", "stomach"}},
        {"small bowel",
         "small bowel",
         {"small bowel", "mesenteric", "jejunal", "ileal", "ileocolic", "intestinal", "duodenal"}},
        {"large bowel",
         "large bowel",
         {"large bowel", "colic", "colon", "cecal", "appendicular", "sigmoid", "rectal"}},
        {"heart",
         "heart",
         {"coronary", "interventricular", "circumflex", "marginal", "diagonal", "posterolateral",
          "posterior left ventricular", "nodal", "conal", "septal", "cardiac", "left ventricle"}}}) {
    CAPTURE(owner.organ);
    const auto mesh = std::ranges::find(human().body.meshes, "organ: " + owner.organ, &SkinnedMesh::name);
    REQUIRE(mesh != human().body.meshes.end());
    const TriangleMesh atRest = meshAtRest(human().body, *mesh);
    const WindingNumber inside(atRest.positions, atRest.triangles);
    int all = 0, own = 0;
    std::map<std::string, int> others;
    for (std::size_t i = 0; i < beds.beds.size(); ++i) {
      if (grown().growth.regions[beds.regionOfBed[i]].name != owner.region)
        continue;  // of one that overlaps it
      const auto& bed = beds.beds[i];
      const Section on = sectionOn(rest, beds.spans[bed.span], bed.t);
      const vec3 centre = on.centre + mat3(on.frame.u, on.frame.v, on.frame.tangent) * bed.centre;
      if (std::abs(inside.at(centre)) < 0.5f) continue;
      for (const auto& stem : bed.stem) {
        if (stem.from == shared::kNoStem) continue;
        const std::string& name = human().network.vessels()[beds.spans[stem.span].vessel].name;
        const bool isOwn = std::ranges::any_of(
            owner.vessels, [&](const char* part) { return name.find(part) != std::string::npos; });
        ++all;
        own += isOwn;
        if (!isOwn) ++others[name];
      }
    }
    std::string named;
    for (const auto& [name, count] : others) named.append("; ").append(name) += " " + std::to_string(count);
    MESSAGE(owner.organ << ": " << own << " of " << all << " stems" << named);
    CHECK(all > 20);
    CHECK(own >= 0.98 * all);
  }
}
