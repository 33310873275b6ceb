#include <doctest/doctest.h>

#include <cstring>
#include <functional>

#include "cli/motion_text.h"
#include "cli/program.h"
#include "core/atomic_file.h"
#include "support/shared_data.h"

// What an earlier run made is kept only while everything that was read for it is as it was.
using namespace vasa;
using namespace vasa::test;

namespace {

const std::filesystem::path kGrowth = VASA_GROWTH_DATA;

std::string textOf(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  REQUIRE(bytes.ok());
  return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

void write(const std::filesystem::path& path, const std::string& text) {
  REQUIRE(writeFileAtomically(path, text).ok());
}

// The built-in human as JSON with its numbers in a file beside it.
void writeHumanInTwoFiles(const std::filesystem::path& folder) {
  const std::string glb = textOf(humanBody());
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof length);
  auto json = nlohmann::json::parse(glb.substr(20, length));
  json["buffers"][0]["uri"] = "human.bin";
  write(folder / "human.gltf", json.dump());
  write(folder / "human.bin", glb.substr(20 + length + 8));
}

// Draws a picture, keeps it in a run that reads the same, then refuses to after the change.
void checkHeld(const std::filesystem::path& folder, const std::vector<std::string>& scene,
               const std::function<void()>& change) {
  std::vector<std::string> arguments{"render",
                                     "--size",
                                     "32x48",
                                     "--quads",
                                     "4x2",
                                     "--frames",
                                     "0",
                                     "--json",
                                     "--no-avoid",
                                     "-o",
                                     (folder / "picture.png").string()};
  arguments.insert(arguments.end(), scene.begin(), scene.end());
  const auto first = runProgram(arguments);
  REQUIRE_MESSAGE(first.exit == 0, first.err);
  arguments.emplace_back("--resume");
  const auto again = runProgram(arguments);
  REQUIRE_MESSAGE(again.exit == 0, again.err);
  CHECK(again.json()["frames_kept"] == 1);
  change();
  const auto changed = runProgram(arguments);
  CHECK(changed.exit == 7);
  CHECK_MESSAGE(changed.err.find("was made by another run") != std::string::npos, changed.err);
}

}  // namespace

TEST_CASE("--resume sees that a motion's file changed, or the map of its joints") {
  const TemporaryFolder folder;
  const auto motion = folder.path() / "motion.bvh", map = folder.path() / "joints.txt";
  write(motion, armMotion({"-80"}));
  write(map, "LeftArm = LeftArm\n");
  const std::vector<std::string> scene{"--clip", motion.string(), "--joint-map", map.string()};
  checkHeld(folder.path(), scene, [&] { write(motion, armMotion({"10"})); });
  std::filesystem::remove(folder.path() / "picture.png");
  checkHeld(folder.path(), scene, [&] { write(map, "LeftArm = LeftArm\nRightArm = RightArm\n"); });
}

TEST_CASE("--resume sees that the buffer beside a glTF file changed") {
  const TemporaryFolder folder;
  writeHumanInTwoFiles(folder.path());
  const auto buffer = folder.path() / "human.bin";
  checkHeld(folder.path(),
            {"--body", (folder.path() / "human.gltf").string(), "--network", humanVessels().string()}, [&] {
              std::string bytes = textOf(buffer);
              const auto json = nlohmann::json::parse(textOf(folder.path() / "human.gltf"));
              const auto& accessor =
                  json["accessors"]
                      [json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
              // The lowest bit of some vertex' coordinate.
              const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
              bytes[view.value("byteOffset", std::size_t(0)) + accessor.value("byteOffset", std::size_t(0)) +
                    120] ^= 1;
              write(buffer, bytes);
            });
}

TEST_CASE("--resume sees that the rules of growth changed") {
  const TemporaryFolder folder;
  for (const char* name : {"capillaries.lsys", "regions.csv"})
    write(folder.path() / name, textOf(kGrowth / name));
  checkHeld(folder.path(), {"--capillaries", "1", "--growth", folder.path().string()},
            [&] { write(folder.path() / "regions.csv", textOf(kGrowth / "regions.csv") + "\n"); });
}

TEST_CASE("--resume goes on in another place, with other files of the same contents") {
  const TemporaryFolder folder;
  const auto network = folder.path() / "other.vasa";
  std::vector<std::string> arguments{"render",
                                     "--size",
                                     "32x48",
                                     "--quads",
                                     "4x2",
                                     "--body",
                                     humanBody().string(),
                                     "--network",
                                     humanVessels().string(),
                                     "-o",
                                     (folder.path() / "picture.png").string(),
                                     "--json"};
  REQUIRE(runProgram(arguments).exit == 0);
  std::filesystem::copy(humanVessels(), network);
  arguments[8] = "other.vasa", arguments[10] = "picture.png";
  arguments.emplace_back("--resume");
  const auto moved = runProgram(arguments, {.folder = folder.path().string()});
  REQUIRE_MESSAGE(moved.exit == 0, moved.err);
  CHECK(moved.json()["frames_kept"] == 1);
}

TEST_CASE("--resume sees that a journal of edits changed") {
  const TemporaryFolder folder;
  const auto journal = folder.path() / "lesions.vedit";
  write(journal, "occlude \"left femoral artery\" 0.5\n");
  checkHeld(folder.path(), {"--edits", journal.string()},
            [&] { write(journal, "occlude \"left femoral artery\" 0.6\n"); });
}
