#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "edit/replay.h"
#include "network/file.h"
#include "network/measure_profile.h"
#include "scene/scene_file.h"
#include "support/kept_once.h"
#include "support/shared_data.h"
#include "view/virtual_display.h"
#include "viewer/app.h"
#include "viewer/human_data.h"
#include "viewer/scene_keeper.h"

// Editing, undoing and saving as a person does it: sessions on a display without a screen.

using namespace vasa;
using namespace vasa::viewer;
using namespace vasa::test;

namespace {

// A scene of the human's bare vessels with one of them before the eye.
std::filesystem::path sceneIn(const std::filesystem::path& folder, const std::string& vessel) {
  const auto path = folder / "scene.json";
  std::ofstream(path) << R"({"body": ")" << (kData / "human.glb").string() << R"(", "networks": [")"
                      << (kData / "human.vasa").string() << R"("], "camera": {"focus": ")" << vessel << R"("},
      "look": {"preset": "clinical", "skin": false, "bones": false, "organs": false}})";
  return path;
}

ViewReport session(const std::filesystem::path& scene, const std::string& script) {
  const KeptOnce kept;
  auto file = readSceneFile(scene);
  REQUIRE(file);
  auto steps = parseScript(script, "script");
  REQUIRE_MESSAGE(steps, (steps ? "" : steps.error().message));
  ViewOptions options;
  options.file = std::move(*file);
  options.width = 960;
  options.height = 640;
  options.script = std::move(*steps);
  options.out = scene.parent_path();
  options.stopped = [] { return false; };
  const auto report = view(options);
  REQUIRE_MESSAGE(report, (report ? "" : report.error().message));
  return *report;
}

std::string control(const char* key) {
  return std::string("hold control\nkey ") + key + "\nlet control\nsettle\n";
}

}  // namespace

TEST_CASE("a scene names no body where it has the built-in human's, with whatever vessels") {
  const TemporaryFolder folder;
  const Document document;
  ViewState state;
  state.playback.clip = -1;
  const auto saved = [&](SceneFile file) {
    file.path = folder.path() / "scene.json";
    SceneKeeper keeper(kData);
    keeper.opened(file, state);
    REQUIRE(keeper.save(document, state, {}));
    auto read = readSceneFile(file.path);
    REQUIRE(read);
    return *read;
  };
  SceneFile own = humanFile();
  own.networks = {folder.path() / "own.vasa"};
  CHECK(saved(own).body.empty());
  CHECK(saved(own).networks == own.networks);
  own.body = folder.path() / "human.glb";
  CHECK(saved(own).body == own.body);
  SceneFile builtIn = humanFile();
  CHECK(saved(builtIn).networks.front().filename() == "human.vasa");  // without holds
  builtIn.holds = kData / "human.holds.csv";
  CHECK(saved(builtIn).body.empty());
  CHECK(saved(builtIn).networks.empty());
  CHECK(saved(builtIn).holds.empty());
}

TEST_CASE(
    "a vessel is dragged, undone, redone and saved; opened and saved again it is the same to the byte") {
  const VirtualDisplay display;
  REQUIRE(setenv("DISPLAY", display.variable().substr(8).c_str(), 1) == 0);
  const TemporaryFolder folder;
  const auto scene = sceneIn(folder.path(), "abdominal aorta"), journal = folder.path() / "scene.vedit";
  const std::string out = folder.path().string();
  const std::string pick = "settle\nkey e\nmove 320 315\npress left\nrelease left\nsettle\n";
  const std::string drag =  // from the ring's middle on the centre line
      "move 316 320\npress left\nmove 332 320\nframes 1\nmove 354 325\nframes 2\nrelease left\nsettle\n";
  const ViewReport first =
      session(scene, pick + "window " + out + "/picked.png\n" + drag + "window " + out + "/dragged.png\n" +
                         control("z") + "window " + out + "/undone.png\n" + control("y") + control("s"));
  CHECK(first.selected == "abdominal aorta");
  MESSAGE("from an edit to its picture: " << first.editMs << " ms");
  CHECK(first.editMs > 0);
  const auto edits = readJournal(journal);
  REQUIRE(edits);
  REQUIRE(edits->size() == 1);  // a drag is one line
  const auto* move = std::get_if<MoveEdit>(&edits->front().operation);
  REQUIRE(move);
  CHECK(move->vessel == "abdominal aorta");
  CHECK(move->byMm.x > 3);  // to the right in a picture from the front: to the body's left
  CHECK(std::abs(move->byMm.y) < 0.3 * move->byMm.x);
  const std::string saved = contentOf(scene), lines = contentOf(journal);
  const ViewReport again = session(scene, "settle\n" + control("s") + "window " + out + "/again.png\n");
  CHECK(again.selected == "abdominal aorta");
  CHECK(contentOf(scene) == saved);
  CHECK(contentOf(journal) == lines);
  CHECK(parseScene(saved, folder.path(), "saved")->edits == std::vector{journal});
  unsetenv("DISPLAY");
}

TEST_CASE(
    "a stenosis by its slider, undone, then a branch to a point; what cannot be done is said and leaves no line") {
  const VirtualDisplay display;
  REQUIRE(setenv("DISPLAY", display.variable().substr(8).c_str(), 1) == 0);
  const TemporaryFolder folder;
  const auto scene = sceneIn(folder.path(), "left femoral artery"), journal = folder.path() / "scene.vedit";
  const auto click = [](const char* place) {
    return std::string("move ") + place + "\npress left\nrelease left\nsettle\n";
  };
  const std::string pick = "settle\nkey e\n" + click("311 343");
  const std::string slide =
      "move 26 157\npress left\nframes 1\nmove 108 157\nframes 2\nrelease left\nsettle\n";
  session(scene, pick + slide + control("s"));
  auto edits = readJournal(journal);
  REQUIRE(edits);
  REQUIRE(edits->size() == 1);  // one line for the whole way of the slider
  const auto* stenosis = std::get_if<StenosisEdit>(&edits->front().operation);
  REQUIRE(stenosis);
  CHECK(stenosis->vessel == "left femoral artery");
  CHECK(stenosis->percent > 60);

  const TemporaryFolder other;
  const std::string branch = click("103 244") + click("206 438"),
                    graftToNothing = click("185 244") + click("45 562"), remove = click("270 244");
  session(sceneIn(other.path(), "left femoral artery"),
          pick + slide + control("z") + branch + graftToNothing + remove + control("s"));
  edits = readJournal(other.path() / "scene.vedit");
  REQUIRE(edits);
  REQUIRE(edits->size() == 1);
  const auto* grown = std::get_if<BranchEdit>(&edits->back().operation);
  REQUIRE(grown);
  CHECK(grown->name == "branch of left femoral artery");
  CHECK(grown->lengthMm > 50);

  // What has branches goes with these alone.
  const TemporaryFolder bare;
  session(sceneIn(bare.path(), "left femoral artery"),
          pick + "key delete\nsettle\nhold shift\nkey delete\nlet shift\nsettle\n" + control("s"));
  edits = readJournal(bare.path() / "scene.vedit");
  REQUIRE(edits);
  REQUIRE(edits->size() == 1);
  const auto* taken = std::get_if<DeleteEdit>(&edits->back().operation);
  REQUIRE(taken);
  CHECK(taken->tree);

  // Past a place beside all vessels, which lies as deep as the place that it begins at.
  const TemporaryFolder third;
  const std::string graft = click("185 244") + click("380 500") + click("338 570");
  session(sceneIn(third.path(), "left femoral artery"), pick + graft + control("s"));
  edits = readJournal(third.path() / "scene.vedit");
  REQUIRE(edits);
  REQUIRE(edits->size() == 1);
  const auto* led = std::get_if<GraftEdit>(&edits->back().operation);
  REQUIRE(led);
  CHECK(led->vessel == "left femoral artery");
  CHECK(led->other == "left popliteal artery");
  REQUIRE(led->via.size() == 1);
  const auto before = readNetwork(kData / "human.vasa");
  REQUIRE(before);
  const auto after = editNetwork(*before, *edits);
  REQUIRE(after);
  const auto made = findVessel(*after, led->name);
  REQUIRE(made);
  const vec3 passed = 1e-3f * vec3(led->via.front());
  float nearest = 1;
  for (const ProfileStation& station : stationsOf(after->pointsOf(after->vessel(*made)), 1e-3f))
    nearest = std::min(nearest, glm::distance(station.centre, passed));
  CHECK(nearest < 2e-3f);

  // Undo takes such a place back, and nothing else.
  const TemporaryFolder fourth;
  session(sceneIn(fourth.path(), "left femoral artery"), pick + slide + click("185 244") + click("380 500") +
                                                             control("z") + click("338 570") + control("s"));
  edits = readJournal(fourth.path() / "scene.vedit");
  REQUIRE(edits);
  REQUIRE(edits->size() == 2);
  CHECK(std::holds_alternative<StenosisEdit>(edits->front().operation));
  const auto* straight = std::get_if<GraftEdit>(&edits->back().operation);
  REQUIRE(straight);
  CHECK(straight->via.empty());
  unsetenv("DISPLAY");
}
