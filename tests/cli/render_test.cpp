#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "cli/program.h"
#include "io/png.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

std::vector<std::string> walk(const std::filesystem::path& folder, std::initializer_list<std::string> more) {
  std::vector<std::string> arguments{"render", "--clip",  "walk",
                                     "--size", "192x320", "--quads",
                                     "4x2",    "-o",      (folder / "{frame:03}.png").string()};
  arguments.insert(arguments.end(), more);
  return arguments;
}

std::vector<std::uint8_t> pixelsOf(const std::filesystem::path& file) {
  auto picture = readPng(file);
  REQUIRE(picture.ok());
  return std::move(picture->rgba);
}

}  // namespace

TEST_CASE("a clip becomes numbered pictures with vessels in them") {
  TemporaryFolder folder;
  const auto outcome =
      runProgram(walk(folder.path(), {"--frames", "2:4", "--hide", "skin,bones,organs", "--json"}));
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(listOf(folder.path()) == std::vector<std::string>{"002.png", "003.png", "004.png"});
  CHECK(outcome.json()["frames"] == 3);
  CHECK(outcome.json()["largest_step_m"].get<double>() > 0);
  const auto picture = readPng(folder.path() / "003.png");
  REQUIRE(picture.ok());
  CHECK(picture->width == 192);
  int red = 0, blue = 0;
  for (std::size_t i = 0; i < picture->rgba.size(); i += 4) {
    red += picture->rgba[i] > picture->rgba[i + 2] + 60;
    blue += picture->rgba[i + 2] > picture->rgba[i] + 40;
  }
  CHECK(red > 50);
  CHECK(blue > 50);
}

TEST_CASE(
    "render leaves out what a scene hides and colours as it says, unless the command line says otherwise") {
  TemporaryFolder folder;
  const auto draw = [&](const std::string& name, const std::string& keys, std::vector<std::string> more) {
    const auto scene = folder.path() / (name + ".json");
    std::ofstream(scene) << R"({ "look": { "skin": false, "bones": false, "organs": false)" << keys << " }";
    std::vector<std::string> arguments{"render",
                                       scene.string(),
                                       "--size",
                                       "192x320",
                                       "--quads",
                                       "4x2",
                                       "--frames",
                                       "0",
                                       "--clip",
                                       "stand",
                                       "--no-avoid",
                                       "-o",
                                       (folder.path() / (name + ".png")).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = runProgram(arguments);
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    return std::pair(contentOf(folder.path() / (name + ".png")), outcome.err);
  };
  const auto pixels = [&](const std::string& name) { return readPng(folder.path() / (name + ".png"))->rgba; };
  draw("all", "}", {});
  draw("hidden", R"(}, "hidden": ["abdominal aorta", "left femoral vein"])", {});
  draw("region", R"(, "colour": "region" })", {});
  draw("asked", "}", {"--colour", "region"});
  draw("kinds", R"(, "colour": "region" })", {"--colour", "kind"});
  const auto strain = draw("strain", R"(, "colour": "strain" }, "hidden": ["nobody"])", {});
  CHECK(pixels("hidden") != pixels("all"));
  CHECK(pixels("region") == pixels("asked"));
  CHECK(pixels("region") != pixels("all"));
  CHECK(pixels("kinds") == pixels("all"));
  CHECK(pixels("strain") != pixels("all"));
  CHECK(strain.second.find("'nobody'") != std::string::npos);
}

TEST_CASE("the same frame has the same bits on one and two threads, and in any order of frames") {
  TemporaryFolder one, two, single;
  REQUIRE(runProgram(walk(one.path(), {"--frames", "0:3", "--threads", "1"}),
                     {.environment = {"LP_NUM_THREADS=1"}})
              .exit == 0);
  REQUIRE(runProgram(walk(two.path(), {"--frames", "0:3", "--threads", "2"}),
                     {.environment = {"LP_NUM_THREADS=2"}})
              .exit == 0);
  REQUIRE(runProgram(walk(single.path(), {"--frames", "3"})).exit == 0);
  REQUIRE(runProgram(walk(single.path(), {"--frames", "1"})).exit == 0);
  for (const char* name : {"000.png", "001.png", "002.png", "003.png"})
    CHECK(contentOf(one.path() / name) == contentOf(two.path() / name));
  for (const char* name : {"001.png", "003.png"})
    CHECK(contentOf(one.path() / name) == contentOf(single.path() / name));
}

TEST_CASE("a track alone draws nothing, needs no device, and gives the pictures of a run without it") {
  TemporaryFolder tracks, with, without;
  const std::string track = (tracks.path() / "new" / "walk.track").string();
  const auto solved = runProgram({"render", "--clip", "walk", "--frames", "0:3", "--track", track, "--json"},
                                 {.environment = {"VK_DRIVER_FILES=/dev/null"}});
  REQUIRE_MESSAGE(solved.exit == 0, solved.err);
  CHECK(solved.json()["frames"] == 4);
  REQUIRE(runProgram(walk(with.path(), {"--frames", "3", "--track", track})).exit == 0);
  REQUIRE(runProgram(walk(without.path(), {"--frames", "3"})).exit == 0);
  CHECK(contentOf(with.path() / "003.png") == contentOf(without.path() / "003.png"));
  // A motion, and one that is solved, is needed.
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--clip", "walk", "--no-avoid"}}) {
    std::vector<std::string> arguments{"render", "--track", (tracks.path() / "other.track").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    CHECK(runProgram(arguments).exit == 2);
  }
  CHECK(listOf(tracks.path() / "new") == std::vector<std::string>{"walk.track"});
}

TEST_CASE("at twice the clip's rate every other frame is the clip's own, also from a track") {
  TemporaryFolder tracks, own, twice, share;
  const std::string track = (tracks.path() / "walk.track").string();
  const auto solved =
      runProgram({"render", "--clip", "walk", "--fps", "60", "--frames", "0:3", "--track", track, "--json"});
  REQUIRE_MESSAGE(solved.exit == 0, solved.err);
  CHECK(solved.json()["frames"] == 3);  // of the clip: 0, 1 and 2, which frame 3 lies before
  REQUIRE(runProgram(walk(own.path(), {"--frames", "0:2"})).exit == 0);
  const auto film = runProgram(walk(twice.path(), {"--fps", "60", "--frames", "0:4"}));
  REQUIRE_MESSAGE(film.exit == 0, film.err);
  CHECK(listOf(twice.path()).size() == 5);
  CHECK(pixelsOf(twice.path() / "002.png") == pixelsOf(own.path() / "001.png"));
  CHECK(pixelsOf(twice.path() / "004.png") == pixelsOf(own.path() / "002.png"));
  CHECK(pixelsOf(twice.path() / "003.png") != pixelsOf(own.path() / "001.png"));
  CHECK(pixelsOf(twice.path() / "003.png") != pixelsOf(own.path() / "002.png"));
  REQUIRE(
      runProgram(walk(share.path(), {"--fps", "60", "--frames", "0:4", "--shard", "1/2", "--track", track}))
          .exit == 0);
  CHECK(listOf(share.path()) == std::vector<std::string>{"001.png", "003.png"});
  CHECK(pixelsOf(share.path() / "003.png") == pixelsOf(twice.path() / "003.png"));
  // A rate that the clip has anyhow is no other run; of a pose there is none.
  const auto same = runProgram(walk(own.path(), {"--fps", "30", "--frames", "0:2", "--resume", "--json"}));
  REQUIRE_MESSAGE(same.exit == 0, same.err);
  CHECK(same.json()["frames_kept"] == 3);
  CHECK(runProgram({"render", "--fps", "30", "-o", (own.path() / "rest.png").string()}).exit == 2);
}

TEST_CASE("shards share a film without overlap, and --resume keeps what is there") {
  TemporaryFolder folder;
  const auto film = [&](std::vector<std::string> more) {
    auto arguments = walk(folder.path(), {"--frames", "0:3", "--no-avoid"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  };
  REQUIRE(film({"--shard", "0/2"}).exit == 0);
  CHECK(listOf(folder.path()) == std::vector<std::string>{"000.png", "002.png"});
  const auto resumed = film({"--resume", "--json"});
  REQUIRE_MESSAGE(resumed.exit == 0, resumed.err);
  CHECK(resumed.json()["frames"] == 2);
  CHECK(resumed.json()["frames_kept"] == 2);
  CHECK(listOf(folder.path()).size() == 4);
  // What is cut off, as by a copy that was interrupted, is drawn anew; another frame's is refused.
  const std::string whole = contentOf(folder.path() / "001.png");
  for (const std::size_t bytes : {whole.size() - 1, whole.size() / 2, std::size_t(0)}) {
    std::ofstream(folder.path() / "001.png", std::ios::binary) << whole.substr(0, bytes);
    const auto mended = film({"--resume", "--json"});
    REQUIRE_MESSAGE(mended.exit == 0, mended.err);
    CHECK(mended.json()["frames_kept"] == 3);
    CHECK(contentOf(folder.path() / "001.png") == whole);
  }
  std::filesystem::copy_file(folder.path() / "002.png", folder.path() / "001.png",
                             std::filesystem::copy_options::overwrite_existing);
  CHECK(film({"--resume"}).exit == 7);
  std::filesystem::remove(folder.path() / "001.png");
  const auto other = film({"--resume", "--camera", "back"});
  CHECK(other.exit == 7);
  CHECK(other.err.find("--resume cannot go on from it") != std::string::npos);
}

TEST_CASE("frames may have folders of their own; frames of a shard are no neighbours, with no step between") {
  TemporaryFolder folder;
  const auto own = (folder.path() / "{frame:02}" / "front.png").string();
  const std::vector<std::string> two{"render", "--clip", "walk", "--size",     "32x32",  "--frames",
                                     "0:2",    "-o",     own,    "--no-avoid", "--shard"};
  const auto with = [&](const char* shard) {
    std::vector<std::string> words = two;
    words.push_back(shard);
    return runProgram(words);
  };
  const auto shard = with("0/2"), all = with("0/1");
  REQUIRE_MESSAGE(shard.exit == 0, shard.err);
  CHECK(listOf(folder.path()) == std::vector<std::string>{"00", "01", "02"});
  CHECK(std::filesystem::exists(folder.path() / "01" / "front.png"));
  CHECK(shard.err.find("largest step") == std::string::npos);
  CHECK(all.err.find("largest step") != std::string::npos);
}

TEST_CASE("a picture goes to standard output, with alpha if asked") {
  const auto outcome = runProgram({"render", "--size", "40x60", "--transparent", "-o", "-"});
  REQUIRE(outcome.exit == 0);
  const auto picture = decodePng(std::as_bytes(std::span(outcome.out)), "standard output");
  REQUIRE(picture.ok());
  CHECK(picture->rgba[3] == 0);
}

TEST_CASE("what cannot be drawn or written ends with the right code, a remedy and no rest") {
  TemporaryFolder folder;
  const auto output = (folder.path() / "{frame}.png").string();
  const auto unknown = runProgram({"render", "--clip", "moonwalk", "-o", output});
  CHECK(unknown.exit == 3);
  CHECK(unknown.err.find("it has") != std::string::npos);
  CHECK(unknown.err.find("walk") != std::string::npos);
  CHECK(runProgram({"render", "--body", "/nowhere.glb", "--network", humanVessels().string(), "-o", output})
            .exit == 6);
  CHECK(runProgram({"render", "--body", humanBody().string(), "--network", "/nowhere.vasa", "-o", output})
            .exit == 6);
  CHECK(runProgram({"render", "--focus", "tail", "-o", output}).exit == 3);
  const auto full = runProgram({"render", "--size", "32x32", "-o", "/dev/full"});
  CHECK(full.exit == 6);
  CHECK(full.err.find("No space left") != std::string::npos);
  CHECK(runProgram({"render", "--size", "32x32", "-o", "/proc/nowhere/x.png"}).exit == 6);
  CHECK(runProgram({"render", "--size", "32x32", "-o", "-"}, {.standardOutput = "/dev/full"}).exit == 6);
  CHECK(listOf(folder.path()).empty());
}

TEST_CASE("Ctrl-C in the middle of an export leaves only whole pictures and no video") {
  TemporaryFolder folder;
  auto arguments = walk(folder.path(), {"--video", (folder.path() / "walk.mp4").string()});
  arguments[4] = "1280x720";
  const auto outcome = runProgram(arguments, {.signalAfterMs = 2500});
  CHECK(outcome.exit == 130);
  for (const auto& name : listOf(folder.path())) {
    CHECK(name.ends_with(".png"));
    CHECK(readPng(folder.path() / name).ok());
  }
}

TEST_CASE("forks can be left out, to compare") {
  TemporaryFolder folder;
  const auto frame = [&](const char* forks) {
    const auto path = folder.path() / (std::string(forks) + ".png");
    REQUIRE(runProgram({"render", "--clip", "walk", "--frames", "0", "--focus", "abdominal aorta", "--size",
                        "160x160", "--hide", "skin,bones,organs", "--forks", forks, "-o", path.string()})
                .exit == 0);
    auto picture = readPng(path);
    REQUIRE(picture.ok());
    return std::move(picture->rgba);
  };
  CHECK(frame("on") != frame("off"));
  CHECK(runProgram({"render", "--forks", "some", "-o", "x.png"}).exit == 2);
}
