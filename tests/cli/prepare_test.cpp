#include <doctest/doctest.h>

#include <fstream>

#include "cli/program.h"
#include "network/builder.h"
#include "network/file.h"
#include "support/shared_data.h"

// What is kept between runs: pictures are the same with it and without, whatever became of its files.

using namespace vasa;
using namespace vasa::test;

namespace {

namespace fs = std::filesystem;

// The built-in human with its lungs' vessels alone, in a folder of its own, without what ships of it: a body
// like any other.
struct OwnBody {
  TemporaryFolder folder;
  fs::path cache = folder.path() / "cache", kept = cache / "vasa";

  OwnBody() {
    for (const char* name : {"human.glb", "growth"})
      fs::create_symlink(humanBody().parent_path() / name, folder.path() / name);
    std::ofstream(folder.path() / "human.holds.csv") << "vessel,at,held_by\n";
    const auto all = readNetwork(humanVessels());
    REQUIRE(all.ok());
    NetworkBuilder builder;
    for (const Vessel& vessel : all->vessels())
      if (vessel.name.find("pulmonary") != std::string::npos)
        builder.addVessel({vessel.name, vessel.ontologyId, vessel.kind},
                          {all->pointsOf(vessel).begin(), all->pointsOf(vessel).end()});
    const auto lungs = builder.build(all->bodyHeight());
    REQUIRE(lungs.ok());
    REQUIRE(lungs->vessels().size() > 20);
    REQUIRE(writeNetwork(folder.path() / "human.vasa", *lungs).ok());
  }
  ProgramOptions with(const fs::path& where) const {
    return {.environment = {"VASA_DATA_DIR=" + folder.path().string(), "XDG_CACHE_HOME=" + where.string()}};
  }
  std::string picture(const ProgramOptions& options, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"render", "--size", "96x160", "-o",
                                       (folder.path() / "picture.png").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = runProgram(arguments, options);
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    return contentOf(folder.path() / "picture.png");
  }
};

std::vector<std::string> keptFiles(const fs::path& folder) {
  std::vector<std::string> names = listOf(folder);
  std::erase_if(names, [](const std::string& name) {
    return !name.ends_with(".kept") || name.starts_with("pipelines-");
  });
  return names;
}

}  // namespace

TEST_CASE(
    "the first run keeps what the second finds, and pictures are the same to the bit, damaged files or none") {
  const OwnBody body;
  const std::string without = body.picture(body.with(body.cache), {"--no-cache"});
  CHECK_FALSE(fs::exists(body.kept));
  CHECK(body.picture(body.with(body.cache)) == without);
  const auto names = keptFiles(body.kept);
  REQUIRE(names.size() == 4);
  const std::vector<std::string> kinds{"binding-", "bones-", "levels-", "surface-"};
  std::vector<std::string> contents;
  for (std::size_t k = 0; k < names.size(); ++k) {
    CHECK(names[k].starts_with(kinds[k]));
    contents.push_back(contentOf(body.kept / names[k]));
  }
  CHECK(body.picture(body.with(body.cache)) == without);
  CHECK(keptFiles(body.kept) == names);
  fs::resize_file(body.kept / names[0], contents[0].size() / 2);
  fs::resize_file(body.kept / names[1], 20);
  for (const std::size_t k : {2, 3})
    std::fstream(body.kept / names[k], std::ios::in | std::ios::out | std::ios::binary).seekp(1000)
        << "somebody else's";
  CHECK(body.picture(body.with(body.cache)) == without);
  CHECK(keptFiles(body.kept) == names);
  // Made anew.
  for (std::size_t k = 0; k < names.size(); ++k) CHECK(contentOf(body.kept / names[k]) == contents[k]);
}

TEST_CASE("where nothing can be kept the program goes on without, and says so with --verbose") {
  const OwnBody body;
  const auto outcome = runProgram({"render", "--size", "96x160", "--no-avoid", "--verbose", "-o",
                                   (body.folder.path() / "p.png").string()},
                                  body.with("/dev/full"));
  CHECK(outcome.exit == 0);
  CHECK(outcome.err.find("not kept for later runs: /dev/full/vasa/") != std::string::npos);
  CHECK(outcome.err.find(" ms  reading the body") != std::string::npos);
}

TEST_CASE("prepare says what it cannot do") {
  const TemporaryFolder folder;
  const auto nowhere = runProgram({"prepare"}, {.environment = {"HOME=", "XDG_CACHE_HOME="}});
  CHECK(nowhere.exit == 2);
  CHECK(nowhere.err.find("-o FOLDER") != std::string::npos);
  const auto unkept = runProgram({"--no-cache", "prepare", "-o", folder.path().string()});
  CHECK(unkept.exit == 2);
  CHECK(unkept.err.find("leave --no-cache out") != std::string::npos);
  CHECK(fs::is_empty(folder.path()));
  std::ofstream(folder.path() / "file") << "no folder";
  const auto file = runProgram({"prepare", "-o", (folder.path() / "file").string()});
  CHECK(file.exit == 6);
  CHECK(file.err.find("choose one that you may write to") != std::string::npos);
  CHECK(runProgram({"prepare", "--body", "none.glb", "--network", "none.vasa", "-o", folder.path().string()})
            .exit == 6);
}

TEST_CASE("what ships of the built-in human is what prepare makes, and is used") {
  const fs::path shipped = humanBody().parent_path() / "kept";
  if (!fs::exists(shipped)) return;  // builds under sanitizers ship none
  const auto names = keptFiles(shipped);
  CHECK(names.size() == 5);
  const TemporaryFolder cache;
  const auto outcome = runProgram(
      {"render", "--size", "96x160", "--capillaries", "1", "-o", (cache.path() / "p.png").string()},
      {.environment = {"XDG_CACHE_HOME=" + cache.path().string()}});
  CHECK_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK((!fs::exists(cache.path() / "vasa") ||
         keptFiles(cache.path() / "vasa").empty()));  // nothing was to be made
}
