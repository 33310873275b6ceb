#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "cli/program.h"
#include "support/shared_data.h"

using namespace vasa::test;

namespace {

nlohmann::json vesselOf(const nlohmann::json& report, const std::string& name) {
  for (const auto& vessel : report["vessel"])
    if (vessel["name"] == name) return vessel;
  FAIL("no vessel is named " << name);
  return {};
}

std::string journal(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  const auto path = folder.path() / name;
  std::ofstream(path) << text;
  return path.string();
}

}  // namespace

TEST_CASE("a stenosis of 70 % and an aneurysm of 55 mm in the built-in human are measured as such") {
  const TemporaryFolder folder;
  const auto lesions =
      journal(folder, "l.vedit", "# lesions\nstenosis \"left internal carotid artery\" 0.1 12 70\n");
  const auto out = (folder.path() / "out.vasa").string();
  const auto outcome =
      runProgram({"edit", lesions, "--set", "aneurysm \"abdominal aorta\" 0.7 70 55", "-o", out, "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  CHECK(report["edits"] == 2);
  CHECK(report["applied"] == 2);
  CHECK(report["refused"] == 0);
  REQUIRE(report["rows"].size() == 2);
  CHECK(report["rows"][0]["line"] == lesions + ":2");
  CHECK(report["rows"][0]["operation"] == "stenosis");
  CHECK(report["rows"][0]["vessel"] == "left internal carotid artery");
  CHECK(report["rows"][1]["line"] == "--set:1");
  const auto measured = runProgram({"info", out, "--vessels", "--json"}).json();
  const auto carotid = vesselOf(measured, "left internal carotid artery");
  for (const char* key : {"nascet", "ecst"}) CHECK(std::abs(carotid[key].get<double>() - 0.70) <= 0.01);
  CHECK(std::abs(carotid["area_stenosis"].get<double>() - 0.91) <= 0.01);
  CHECK(carotid["stenosis_at"].get<double>() == doctest::Approx(0.1).epsilon(0.05));
  const auto aorta = vesselOf(measured, "abdominal aorta");
  CHECK(std::abs(aorta["aneurysm_diameter_m"].get<double>() - 0.055) <= 2e-4);
  CHECK(aorta["aneurysm_ratio"].get<double>() > 3);
  for (const char* key : {"saccular_index", "tortuosity", "inflections", "inflection_metric",
                          "sum_of_angles_rad_m", "least_bend_radius_m"})
    CHECK_MESSAGE(aorta.contains(key), key);
  CHECK(measured["fork"].size() > 50);
  // The bulge presses on what lies around it, and the report says on whom.
  CHECK(!report["overlaps"].empty());
  const auto text = runProgram({"info", out, "--vessels"});
  CHECK(text.out.find("left internal carotid artery") != std::string::npos);
  const auto profile = runProgram({"info", out, "--profile", "abdominal aorta", "--step", "2"});
  CHECK(profile.out.starts_with("along_mm,share,"));
  CHECK(std::count(profile.out.begin(), profile.out.end(), '\n') > 40);
  const auto way = runProgram({"info", out, "--profile", "abdominal aorta", "--to", "left femoral artery"});
  REQUIRE_MESSAGE(way.exit == 0, way.err);
  CHECK(std::count(way.out.begin(), way.out.end(), '\n') > 400);  // millimetres of aorta, iliac and femoral
  const auto listed =
      runProgram({"info", out, "--profile", "abdominal aorta", "--step", "2", "--json"}).json();
  CHECK(listed["profile"] == "abdominal aorta");
  CHECK(listed["station"].size() + 1 ==
        std::size_t(std::count(profile.out.begin(), profile.out.end(), '\n')));
  CHECK(listed["length_mm"] == listed["station"].back()["along_mm"]);
  const auto chart = (folder.path() / "way.png").string();
  CHECK(runProgram({"info", out, "--profile", "abdominal aorta", "-o", chart}).exit == 0);
  CHECK(contentOf(chart).starts_with("\x89PNG"));
  CHECK(runProgram({"info", out, "--profile", "abdominal aorta", "-o", "way.txt"}).exit == 2);
  CHECK(runProgram({"info", out, "--to", "abdominal aorta"}).exit == 2);
}

TEST_CASE(
    "an edit is undone by leaving its line out: without any, the bytes are those of the network that was read") {
  const TemporaryFolder folder;
  const auto network = humanVessels().string();
  const auto write = [&](const std::string& text) {
    const auto out = folder.path() / "out.vasa";
    const auto outcome = runProgram({"edit", network, journal(folder, "e.vedit", text), "-o", out.string()});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    return contentOf(out);
  };
  const std::string first = "occlude \"left femoral artery\" 0.6\n",
                    second = "rename \"abdominal aorta\" \"belly aorta\"\n";
  const auto one = write(first);
  CHECK(write(first + second) != one);
  CHECK(write(first + "# " + second) == one);
  CHECK(write("# nothing\n") == contentOf(network));
}

TEST_CASE("refused edits are told with line, vessel, place and rule, and nothing is written") {
  const TemporaryFolder folder;
  const auto out = (folder.path() / "out.vasa").string();
  const auto bad = journal(folder, "bad.vedit",
                           "occlude \"left femoral artery\" 0.5\nocclude \"left femorla artery\" 0.5\n");
  const auto refused = runProgram({"edit", bad, "-o", out});
  CHECK(refused.exit == 3);
  CHECK_MESSAGE(
      refused.err.find(bad +
                       ":2: occlude of \"left femorla artery\" at 0.5: no vessel has this name; did you mean "
                       "\"left femoral artery\"") != std::string::npos,
      refused.err);
  CHECK(!std::filesystem::exists(out));
  const auto going = runProgram({"edit", bad, "-o", out, "--keep-going", "--json"});
  CHECK(going.exit == 0);
  CHECK(going.json()["applied"] == 1);
  CHECK(going.json()["refused"] == 1);
  CHECK(runProgram({"edit", "--set", "oclude x 0.5", "-o", out}).exit == 2);
  CHECK(runProgram({"edit", "a.vasa", "b.vasa", "-o", out}).exit == 2);
  CHECK(runProgram({"edit", (folder.path() / "none.vedit").string(), "-o", out}).exit == 6);
  CHECK(runProgram({"edit", bad}).exit == 2);
  CHECK(runProgram({"info", humanVessels().string(), "--profile", "spleen artery"}).exit == 3);
  CHECK(runProgram({"info", humanVessels().string(), "--edits", bad}).exit == 2);
  CHECK(runProgram({"help", "edits"}).out.find("stenosis V s length_mm percent") != std::string::npos);
}

TEST_CASE("scenes and commands take journals, and the edited vessels walk certified") {
  const TemporaryFolder folder;
  const auto edits = journal(folder, "l.vedit", "occlude \"left femoral artery\" 0.6\n");
  const auto scene = journal(folder, "s.json", "{\"edits\": [\"l.vedit\"]}");
  const auto outcome = runProgram({"check", scene, "--clip", "walk", "--frames", "0:3", "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const nlohmann::json report = outcome.json();
  CHECK(report["frames"].size() == 4);
  for (const auto& frame : report["frames"]) CHECK(frame["certified"] == true);
  const auto measured = runProgram({"info", "--edits", edits, "--vessels", "--json"}).json();
  CHECK(vesselOf(measured["edited"], "left femoral artery")["nascet"].get<double>() > 0.98);
  const auto bad = journal(folder, "bad.vedit", "occlude nobody 0.5\n");
  CHECK(runProgram({"check", "--edits", bad, "--frames", "0"}).exit == 3);
}
