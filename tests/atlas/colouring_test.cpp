#include "atlas/colouring.h"

#include "atlas/human_scene.h"
#include "render/look.h"

using namespace vasa;
using namespace vasa::atlas;
using namespace vasa::test;

namespace {

const Network& network() { return humanScene().network; }

const VesselGroups& groups() {
  static const VesselGroups all = groupsOf(humanScene());
  return all;
}

std::uint32_t packed(vec3 colour) { return packColour(vec4(colour, 1)); }

std::size_t firstSpan(std::size_t vessel) {
  std::size_t first = 0;
  for (std::size_t v = 0; v < vessel; ++v) first += network().vessels()[v].spanCount();
  return first;
}

}  // namespace

TEST_CASE("blood that goes to the lungs has the colour of veins, and that from them of arteries") {
  const auto kinds = spanColours(network(), groups(), network().points(), Colouring::kind);
  const auto blood = spanColours(network(), groups(), network().points(), Colouring::blood);
  const std::size_t trunk = firstSpan(vesselNamed(network(), "pulmonary trunk")),
                    aorta = firstSpan(vesselNamed(network(), "abdominal aorta"));
  CHECK(kinds[trunk] == packed(vec3(colourOf(VesselKind::artery))));
  CHECK(blood[trunk] == packed(vec3(colourOf(VesselKind::vein))));
  CHECK(blood[aorta] == kinds[aorta]);
}

TEST_CASE("scales tell what a pose does to each span: its length, its bend, its lumen") {
  std::vector<vec4> longer(network().points().begin(), network().points().end());
  CHECK(spanColours(network(), groups(), longer, Colouring::strain) ==
        std::vector<std::uint32_t>(network().sweepCount(), packed(scaleColour(Colouring::strain, 0))));
  for (vec4& point : longer) point = {1.2f * vec3(point), 0.8f * point.w};
  for (const float strain : spanStrains(network(), longer))
    REQUIRE(strain == doctest::Approx(0.2f).epsilon(0.01));
  const vec3 stretched = scaleColour(Colouring::strain, 20);
  CHECK(stretched.r > stretched.b);
  const auto lumina = spanColours(network(), groups(), longer, Colouring::lumen);
  const std::uint32_t expected = packed(scaleColour(Colouring::lumen, 64));
  for (const std::uint32_t colour : lumina)
    for (int shift : {0, 8, 16})
      REQUIRE(std::abs(int(colour >> shift & 0xff) - int(expected >> shift & 0xff)) <= 1);
  // 1.2 times as wide a bend around a lumen of 0.8 folds less.
  const auto before = spanColours(network(), groups(), network().points(), Colouring::bend),
             after = spanColours(network(), groups(), longer, Colouring::bend);
  CHECK(before != after);
  const auto light = [](std::uint32_t c) { return int(c & 0xff) + int(c >> 8 & 0xff) + int(c >> 16 & 0xff); };
  for (std::size_t s = 0; s < before.size(); ++s) REQUIRE(light(after[s]) >= light(before[s]) - 2);
}

TEST_CASE(
    "keys tell of what is in use, scales of evenly spaced marks that have the colours of their values") {
  CHECK(legendOf(network(), groups(), Colouring::kind).keys.size() == 3);
  CHECK(legendOf(network(), groups(), Colouring::region).keys.size() == 5);
  std::vector<char> keyed(network().vessels().size(), 0);
  keyed[vesselNamed(network(), "pulmonary trunk")] = 1;
  const ColourLegend blood = legendOf(network(), groups(), Colouring::blood, keyed);
  REQUIRE(blood.keys.size() == 1);
  CHECK(blood.keys.front().text == "Blood poor in oxygen");
  for (const Colouring scale : {Colouring::radius, Colouring::strain, Colouring::bend, Colouring::lumen}) {
    const ColourLegend legend = legendOf(network(), groups(), scale);
    CHECK_FALSE(legend.title.empty());
    for (std::size_t k = 0; k < legend.keys.size(); ++k)
      CHECK(glm::distance(legend.at(float(k) / float(legend.keys.size() - 1)), legend.keys[k].colour) <
            1e-3f);
  }
  CHECK(legendOf(network(), groups(), Colouring::radius).keys.back().text == "16 mm");
  CHECK(legendOf(network(), groups(), Colouring::strain).keys.back().text == "+30 %");
}

TEST_CASE("every colouring has its name; regions are refused where they are not known") {
  for (std::size_t c = 0; c < kColourings.size(); ++c) CHECK(colouringNamed(kColourings[c]) == Colouring(c));
  CHECK_FALSE(colouringNamed("colour"));
  CHECK(colouringsListed() == "kind, blood, region, radius, strain, bend or lumen");
  CHECK(checkColouring(Colouring::region, groups(), "body").ok());
  const auto unknown = checkColouring(Colouring::region, VesselGroups{}, "body.glb");
  REQUIRE_FALSE(unknown.ok());
  CHECK(unknown.error().fault == Fault::badInput);
  CHECK(unknown.error().message.find("not all recognised") != std::string::npos);
  CHECK(checkColouring(Colouring::strain, VesselGroups{}, "body.glb").ok());
}
