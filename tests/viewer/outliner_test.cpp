#include "viewer/outliner.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "viewer/document.h"
#include "viewer/human_data.h"
#include "viewer/paint.h"
#include "viewer/undo_history.h"
#include "viewer/view_state.h"

using namespace vasa;
using namespace vasa::viewer;

namespace {

const Document& document() {
  static const std::shared_ptr<const Document> loaded = [] {
    SceneFile file = test::humanFile();
    file.holds = test::kData / "human.holds.csv";
    const auto document = loadDocument(file, {}, [](const char*, std::size_t, std::size_t) {});
    REQUIRE_MESSAGE(document, (document ? "" : document.error().message));
    return *document;
  }();
  return *loaded;
}

const Network& network() { return document().scene.network; }

VesselId named(std::string_view name) {
  const auto found = std::ranges::find(network().vessels(), name, &Vessel::name);
  REQUIRE_MESSAGE(found != network().vessels().end(), std::string(name));
  return {std::uint32_t(found - network().vessels().begin())};
}

std::vector<OutlinerRow> rowsOf(const ViewState& state) {
  return outlinerRows(network(), *document().groups, state.outliner, state.search);
}

std::size_t rowNamed(std::span<const OutlinerRow> rows, std::string_view name) {
  const auto found = std::ranges::find(rows, name, &OutlinerRow::name);
  REQUIRE_MESSAGE(found != rows.end(), std::string(name));
  return std::size_t(found - rows.begin());
}

}  // namespace

TEST_CASE("an edited document's vessels are held where they were") {
  const auto edited = editedDocument(document(), {R"(stenosis "left femoral artery" 0.5 10 70)"}, false);
  REQUIRE_MESSAGE(edited, (edited ? "" : edited.error().message));
  CHECK(!document().scene.holds.empty());
  CHECK((*edited)->scene.holds.size() == document().scene.holds.size());
}

TEST_CASE("the list is folded by system and region, and a search lists what answers, best first") {
  ViewState state;
  auto rows = rowsOf(state);
  CHECK(rows.size() == 4);
  std::size_t sum = 0;
  for (const OutlinerRow& row : rows) sum += row.vessels.size();
  CHECK(sum == network().vessels().size());
  state.selected = VesselPlace{named("left femoral artery"), 0};
  revealChoice(state, *document().groups);
  rows = rowsOf(state);
  const std::size_t at = rowNamed(rows, "left femoral artery");
  CHECK(rows[at].depth == 2);
  CHECK(rows[rowNamed(rows, "Left thigh")].unfolded);
  state.search = "femrl art";
  rows = rowsOf(state);
  REQUIRE(rows.size() >= 2);
  CHECK(rows[0].name.find("femoral artery") != std::string::npos);
}

TEST_CASE("rows are chosen alone, one more with Ctrl, up to one with Shift, and by arrows") {
  ViewState state;
  state.search = "femoral artery";
  const auto rows = rowsOf(state);
  REQUIRE(rows.size() >= 4);
  chooseRow(state, rows, 1, false, false);
  CHECK(chosenVessels(state) == rows[1].vessels);
  chooseRow(state, rows, 3, true, false);
  CHECK(chosenVessels(state).size() == 2);
  CHECK(state.selected->vessel == rows[3].vessel);
  chooseRow(state, rows, 3, true, false);  // no longer
  CHECK(chosenVessels(state) == rows[1].vessels);
  chooseRow(state, rows, 3, false, true);
  CHECK(chosenVessels(state).size() == 3);
  stepChoice(state, rows, 1, false);
  CHECK(chosenVessels(state) == rows[2].vessels);
  stepChoice(state, rows, -5, false);
  CHECK(state.selected->vessel == rows[0].vessel);
  stepChoice(state, rows, 1, true);
  CHECK(chosenVessels(state).size() == 2);
}

TEST_CASE("what is hidden is not drawn nor clicked, a group is hidden as one, and undo shows it again") {
  ViewState state;
  UndoHistory history;
  history.start(state);
  const auto rows = rowsOf(state);
  const OutlinerRow& veins = rows[rowNamed(rows, "Veins")];
  state.hidden.set(network(), veins.vessels, true);
  history.watch(state, false);
  CHECK(sightOf(veins, network(), state.hidden) == RowSight::hidden);
  CHECK(sightOf(rows[0], network(), state.hidden) == RowSight::shown);
  auto shown = shownVessels(document(), state);
  CHECK(std::size_t(std::ranges::count(shown, 1)) == network().vessels().size() - veins.vessels.size());
  CHECK_FALSE(shown[veins.vessels.front().value]);
  state.hidden.set(network(), {veins.vessels.data(), 1}, false);
  history.watch(state, false);
  CHECK(sightOf(veins, network(), state.hidden) == RowSight::partly);
  state.hidden.setAllBut(network(), {veins.vessels.data(), 1});
  history.watch(state, false);
  shown = shownVessels(document(), state);
  CHECK(std::ranges::count(shown, 1) == 1);
  CHECK(history.unsaved(state));  // scenes have it
  for (int i = 0; i < 3; ++i) REQUIRE(history.undo(state));
  CHECK_FALSE(state.hidden.any());
}

TEST_CASE("colours follow the pose and the wish, and hidden vessels have none") {
  ViewState state;
  KeptColours plain;
  auto body = std::make_shared<PosedBody>();
  body->points.assign(network().points().begin(), network().points().end());
  CHECK(coloursOf(document(), body, state, plain).empty());  // as their kinds are
  state.colouring = atlas::Colouring::strain;
  const auto rest = coloursOf(document(), body, state, plain);
  auto longer = std::make_shared<PosedBody>(*body);
  for (vec4& point : longer->points) point = vec4(1.2f * vec3(point), point.w);
  CHECK(coloursOf(document(), longer, state, plain) != rest);
  state.colouring = atlas::Colouring::region;
  state.hidden.set(network(), std::vector{VesselId{0}}, true);
  CHECK(coloursOf(document(), body, state, plain).front() == 0);
}
