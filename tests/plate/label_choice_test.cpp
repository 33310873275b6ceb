#include "plate/label_choice.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "network/builder.h"
#include "plate/label_names.h"
#include "plate/plate.h"
#include "surface/surface_mesh.h"

using namespace vasa;
using namespace vasa::plate;

namespace {

// A straight vessel.
std::vector<vec4> line(vec3 from, vec3 to, float radius) {
  std::vector<vec4> points;
  for (int k = 0; k < 6; ++k) points.emplace_back(glm::mix(from, to, float(k) / 5), radius);
  return points;
}

// A body's aorta, a pair of arteries beside it, two that are called left and right and are no pair, and one
// behind the aorta.
Network figure() {
  NetworkBuilder builder;
  const auto add = [&](const char* name, vec3 from, vec3 to, float radius) {
    builder.addVessel({name, "", VesselKind::artery}, line(from, to, radius));
  };
  add("aorta", {0, 0.2f, 0}, {0, 1.4f, 0}, 0.02f);
  add("left femoral artery", {0.2f, 0.1f, 0}, {0.2f, 0.8f, 0}, 0.008f);
  add("right femoral artery", {-0.2f, 0.1f, 0}, {-0.2f, 0.8f, 0}, 0.008f);
  add("left tibial artery", {0.2f, -0.1f, 0}, {0.2f, -0.05f, 0}, 0.003f);
  add("right tibial artery", {-0.2f, -0.1f, 0}, {-0.2f, -0.05f, 0}, 0.003f);
  add("left gastric artery", {0.05f, 1, 0}, {0.15f, 1.1f, 0}, 0.005f);
  add("right gastric artery", {0.06f, 0.9f, 0}, {0.16f, 1.0f, 0}, 0.005f);
  add("hidden vein", {0, 0.5f, -0.1f}, {0, 0.9f, -0.1f}, 0.01f);
  add("thin artery", {0.3f, 0.5f, 0}, {0.3f, 0.9f, 0}, 0.0005f);
  auto network = builder.build(1.7f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  return std::move(*network);
}

// From in front: 2 m high, 400 cells.
SeenMap mapOf(const Network& network) {
  SeenMap map({.position = {0, 0.8f, 5}, .target = {0, 0.8f, 0}, .orthographicHeight = 2, .farDistance = 20},
              200, 400);
  const SweepTable table = makeSweepTable(network);
  std::vector<quat> frames(table.knotCount);
  networkFrames(network, network.points(), restReferences(network), frames);
  const SurfaceMesh surface = surfaceMesh({table, network.points(), frames}, {8, 4});
  map.draw(surface.positions, surface.triangles,
           [&](std::uint32_t t) { return surface.vesselOfVertex[surface.triangles[t].x]; });
  return map;
}

std::vector<std::string> textsOf(const LabelChoice& choice) {
  std::vector<std::string> texts;
  for (const VesselLabel& label : choice.labels) texts.push_back(label.text);
  return texts;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("a label leaves out the side of a mirrored pair, and of no other") {
  const Network network = figure();
  const auto text = [&](std::uint32_t v) { return LabelNames(network).of({v}); };
  CHECK(text(0) == "Aorta");
  CHECK(text(1) == "Femoral artery");
  CHECK(text(2) == "Femoral artery");
  CHECK(text(5) == "Left gastric artery");
  CHECK(text(6) == "Right gastric artery");
}

TEST_CASE("main vessels are the large ones that are seen, each pair once") {
  const Network network = figure();
  const SeenMap map = mapOf(network);
  const auto choice = chooseLabels(network, network.points(), map, {});
  REQUIRE(choice.ok());
  CHECK(textsOf(*choice) ==
        Texts{"Aorta", "Femoral artery", "Left gastric artery", "Right gastric artery", "Tibial artery"});
  // On both of the pair, and every anchor on a cell of the vessel.
  const VesselLabel& femoral = choice->labels[1];
  CHECK(femoral.vessels.size() == 2);
  bool left = false, right = false;
  for (const vec2& anchor : femoral.anchors) {
    const std::uint32_t what = map.at(std::uint32_t(anchor.x), std::uint32_t(anchor.y));
    CHECK((what == 1 || what == 2));
    (anchor.x > 100 ? left : right) = true;
  }
  CHECK(left);
  CHECK(right);
  // The best anchor is in the middle of what is seen.
  CHECK(choice->labels[0].anchors[0].y == doctest::Approx(200).epsilon(0.03));
}

TEST_CASE("all-visible adds the thin ones, but nothing that is hidden") {
  const Network network = figure();
  const auto choice = chooseLabels(network, network.points(), mapOf(network), {.which = "all-visible"});
  REQUIRE(choice.ok());
  CHECK(choice->labels.size() == 5 + std::size_t(std::ranges::count(textsOf(*choice), "Thin artery")));
  CHECK(std::ranges::count(textsOf(*choice), "Hidden vein") == 0);
  const auto two =
      chooseLabels(network, network.points(), mapOf(network), {.which = "all-visible", .most = 2});
  REQUIRE(two.ok());
  CHECK(textsOf(*two) == Texts{"Aorta", "Femoral artery"});
}

TEST_CASE("names: with or without a side, a part of one, hidden ones told, unknown ones refused") {
  const Network network = figure();
  const SeenMap map = mapOf(network);
  const auto choose = [&](const char* names) {
    return chooseLabels(network, network.points(), map, {.which = names});
  };
  const auto some = choose("femoral artery, AORTA,right gastric");
  REQUIRE(some.ok());
  CHECK(textsOf(*some) == Texts{"Femoral artery", "Aorta", "Right gastric artery"});
  const auto hidden = choose("hidden vein");
  REQUIRE(hidden.ok());
  CHECK(hidden->labels.empty());
  CHECK(hidden->unseen == Texts{"hidden vein"});
  const auto unknown = choose("aorta,facial artery");
  REQUIRE_FALSE(unknown.ok());
  CHECK(unknown.error().fault == Fault::badInput);
  CHECK(unknown.error().message ==
        "--labels: no vessel is named 'facial artery'; vasa info NET.vasa --vessels lists them");
  const auto several = choose("gastric,right gastric");
  REQUIRE(several.ok());
  CHECK(textsOf(*several) == Texts{"Left gastric artery", "Right gastric artery"});
  CHECK(several->unseen.empty());  // the second has its label already
}

TEST_CASE("names that hold commas are asked for as they are") {
  NetworkBuilder builder;
  for (const auto& [name, x] : {std::pair{"artery, renal, left", 0.2f},
                                {"artery, renal", 0.0f},
                                {"a", -0.2f},
                                {"left vein, renal", 0.4f},
                                {"right vein, renal", -0.4f}})
    builder.addVessel({name, "", VesselKind::artery}, line({x, 0.2f, 0}, {x, 1.4f, 0}, 0.01f));
  const auto network = builder.build(1.7f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  const SeenMap map = mapOf(*network);
  const auto named = [&](const char* names) {
    const auto choice = chooseLabels(*network, network->points(), map, {.which = names});
    REQUIRE_MESSAGE(choice.ok(), choice.error().message);
    return textsOf(*choice);
  };
  CHECK(named("a, Artery, renal, left") == Texts{"A", "Artery, renal, left"});
  CHECK(named(" artery, renal ,a") == Texts{"Artery, renal", "A"});
  CHECK(named(",, a,") == Texts{"A"});
  CHECK(named("vein, renal, a") == Texts{"Vein, renal", "A"});
}

TEST_CASE("no line points where none may, and only vessels of the page are chosen") {
  const Network network = figure();
  const auto choice = chooseLabels(network, network.points(), mapOf(network),
                                   {.allowed = [](vec2 cell) { return cell.x >= 60 && cell.x < 140; }});
  REQUIRE(choice.ok());
  CHECK(choice->labels.size() >= 3);
  for (const VesselLabel& label : choice->labels)
    for (const vec2& anchor : label.anchors) CHECK((anchor.x >= 60 && anchor.x < 140));
  const std::vector<char> aorta{1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  const auto one = chooseLabels(network, network.points(), mapOf(network), {.of = aorta});
  REQUIRE(one.ok());
  CHECK(textsOf(*one) == Texts{"Aorta"});
}

TEST_CASE("what holds much blood comes before what takes more of the picture; rows and kin have one label") {
  NetworkBuilder builder;
  const auto add = [&](const char* name, float x, float length, float radius) {
    builder.addVessel({name, "", VesselKind::artery}, line({x, 0.2f, 0}, {x, 0.2f + length, 0}, radius));
  };
  add("winding artery", -0.3f, 1.2f, 0.006f);  // the most of the picture
  add("trunk", -0.2f, 0.3f, 0.015f);
  add("second lumbar artery", 0, 0.4f, 0.005f);
  add("third lumbar artery", 0.1f, 0.3f, 0.005f);
  add("anterior branch of trunk", 0.2f, 0.4f, 0.005f);
  add("lateral winding artery", 0.3f, 0.4f, 0.004f);
  const auto network = builder.build(1.7f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  const SeenMap map = mapOf(*network);
  const auto main = chooseLabels(*network, network->points(), map, {});
  REQUIRE(main.ok());
  CHECK(textsOf(*main) == Texts{"Trunk", "Winding artery", "Lumbar arteries"});
  CHECK(main->labels[0].area < main->labels[1].area);
  CHECK(main->labels[2].vessels.size() == 2);
  const auto all = chooseLabels(*network, network->points(), map, {.which = "all-visible"});
  REQUIRE(all.ok());
  CHECK(all->labels.size() == 6);
}

TEST_CASE("rows, kin and many") {
  CHECK(rowOf("Left sixth posterior intercostal artery") == "Left posterior intercostal artery");
  CHECK(rowOf("Ulnar palmar digital artery of little finger") == "Ulnar palmar digital artery");
  CHECK(rowOf("Dorsal venous arch of foot") == "Dorsal venous arch of foot");
  CHECK(plural("Renal artery") == "Renal arteries");
  CHECK(plural("Dorsal branch of aorta") == "Dorsal branches of aorta");
  CHECK(plural("Vein") == "Veins");
  CHECK(namedAfter("Anterior branch of retromandibular vein") == "retromandibular vein");
  CHECK(namedAfter("Lateral brachial vein") == "brachial vein");
  CHECK(namedAfter("Arch of aorta").empty());
}

TEST_CASE("vessels that are only numbered are for who asks for them") {
  NetworkBuilder builder;
  builder.addVessel({"leg artery 2", "", VesselKind::artery}, line({0, 0.2f, 0}, {0, 1.4f, 0}, 0.02f));
  const auto network = builder.build(1.7f);
  REQUIRE(network.ok());
  const SeenMap map = mapOf(*network);
  CHECK(chooseLabels(*network, network->points(), map, {})->labels.empty());
  CHECK(chooseLabels(*network, network->points(), map, {.which = "leg artery 2"})->labels.size() == 1);
}

TEST_CASE("mirror images that leave different vessels keep their sides") {
  NetworkBuilder builder;
  const auto add = [&](const char* name, vec3 from, vec3 to, float radius) {
    return builder.addVessel({name, "", VesselKind::artery}, line(from, to, radius));
  };
  const VesselId upper = add("superior artery", {0, 0.5f, 0}, {0, 1, 0}, 0.01f);
  const VesselId lower = add("inferior artery", {0, 0.52f, 0.05f}, {0, 1.02f, 0.05f}, 0.01f);
  const VesselId left = add("left colic artery", {0, 0.77f, 0.05f}, {0.2f, 0.8f, 0}, 0.005f);
  const VesselId right = add("right colic artery", {0, 0.75f, 0}, {-0.2f, 0.8f, 0}, 0.005f);
  const VesselId leftKidney = add("left renal artery", {0, 0.9f, 0}, {0.2f, 0.95f, 0}, 0.005f);
  const VesselId rightKidney = add("right renal artery", {0, 0.9f, 0}, {-0.2f, 0.95f, 0}, 0.005f);
  builder.joinToSide({right, false}, {upper, 1.5f});
  builder.joinToSide({left, false}, {lower, 1.5f});
  builder.joinToSide({leftKidney, false}, {upper, 2.4f});
  builder.joinToSide({rightKidney, false}, {upper, 2.4f});
  const auto network = builder.build(1.7f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  CHECK(LabelNames(*network).of(left) == "Left colic artery");
  CHECK(LabelNames(*network).of(right) == "Right colic artery");
  CHECK(LabelNames(*network).of(leftKidney) == "Renal artery");
}

TEST_CASE("a pair of scanned vessels may run either way, and pieces have one name") {
  NetworkBuilder builder;
  const auto add = [&](const char* name, vec3 from, vec3 to) {
    return builder.addVessel({name, "", VesselKind::vein}, line(from, to, 0.005f));
  };
  const VesselId left = add("left femoral vein", {0.1f, 0.5f, 0}, {0.12f, 0.9f, 0});
  add("right femoral vein", {-0.12f, 0.89f, 0}, {-0.1f, 0.51f, 0});
  const VesselId upper = add("left coronary vein", {0.02f, 1.2f, 0}, {0.08f, 1.1f, 0});
  add("right coronary vein", {-0.01f, 1.2f, 0}, {-0.02f, 1.1f, 0.06f});
  const VesselId piece = add("digital vein (3)", {0.3f, 0.5f, 0}, {0.3f, 0.4f, 0});
  const VesselId branch = add("left branch of vein", {0.1f, 1, 0}, {0.2f, 1, 0});
  add("right branch of vein", {-0.1f, 1, 0}, {-0.2f, 1, 0});
  const auto network = builder.build(1.7f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  CHECK(LabelNames(*network).of(left) == "Femoral vein");
  CHECK(LabelNames(*network).of(upper) == "Left coronary vein");
  CHECK(LabelNames(*network).of(piece) == "Digital vein");
  CHECK(LabelNames(*network).of(branch) == "Left branch of vein");
}

TEST_CASE("a camera holds all places, and is no wider than they need") {
  const std::vector<vec3> places{{-1, 0, 0.5f}, {1, 2, -0.5f}, {0, 1, 0}};
  const auto fitted = cameraOnto(places, vec3(0, 0, 1), vec3(0, 1, 0), places);
  CHECK(fitted.aspect == doctest::Approx(1));
  const SeenMap map(fitted.camera, 100, 100);
  vec2 cell;
  for (const vec3& place : places) {
    REQUIRE(map.project(place, cell));
    CHECK(cell.x > 0);
    CHECK(cell.x < 100);
    CHECK(cell.y > 0);
    CHECK(cell.y < 100);
  }
  REQUIRE(map.project(places[0], cell));
  CHECK(cell.x < 3);
  CHECK(cell.y > 97);
}
