#include "io/video.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "support/shared_data.h"

using namespace vasa;

namespace {

Image plain(std::uint8_t level) { return {33, 21, std::vector<std::uint8_t>(33 * 21 * 4, level)}; }

bool emptyFolder(const std::filesystem::path& folder) {
  return std::filesystem::directory_iterator(folder) == std::filesystem::directory_iterator();
}

}  // namespace

TEST_CASE("frames become a film of the right size, number and rate, odd sizes too") {
  test::TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.mkv", "a.mov", "a.webm"}) {
    const auto path = folder.path() / name;
    auto video = VideoWriter::create(path, 33, 21, 30);
    REQUIRE(video.ok());
    for (int frame = 0; frame < 6; ++frame) REQUIRE(video->write(plain(std::uint8_t(40 * frame))).ok());
    CHECK(!std::filesystem::exists(path));
    REQUIRE(video->finish().ok());
    const std::string probe =
        "ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames,r_frame_rate -of csv=p=0 '" +
        path.string() + "'";
    FILE* output = popen(probe.c_str(), "r");
    char line[200] = "";
    CHECK(fgets(line, sizeof(line), output) != nullptr);
    pclose(output);
    CHECK(std::string(line) == "34,22,30/1,6\n");
  }
}

TEST_CASE("a film that is given up leaves nothing") {
  test::TemporaryFolder folder;
  {
    auto video = VideoWriter::create(folder.path() / "a.mp4", 33, 21, 30);
    REQUIRE(video.ok());
    REQUIRE(video->write(plain(1)).ok());
  }
  CHECK(emptyFolder(folder.path()));
}

TEST_CASE("an encoder that fails is told and leaves nothing") {
  test::TemporaryFolder folder;
  auto video = VideoWriter::create(folder.path() / "a.mp4", 0, 0, 30);
  REQUIRE(video.ok());
  CHECK(!video->finish().ok());
  { const auto dropped = std::move(video); }
}

TEST_CASE("what cannot be a film is refused") {
  const auto unknown = VideoWriter::create("film.txt", 10, 10, 30);
  REQUIRE(!unknown.ok());
  CHECK(unknown.error().fault == Fault::usage);
  CHECK(unknown.error().message ==
        "film.txt: unknown video format; end the name in .mp4, .mov, .mkv or .webm");
  const auto noFolder = VideoWriter::create("/nowhere/at/all/film.mp4", 10, 10, 30);
  REQUIRE(!noFolder.ok());
  CHECK(noFolder.error().fault == Fault::io);
}

TEST_CASE("without ffmpeg the remedy is told") {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const auto video =
      VideoWriter::create(std::filesystem::temp_directory_path() / "vasa-no-ffmpeg.mp4", 10, 10, 30);
  setenv("PATH", path.c_str(), 1);
  REQUIRE(!video.ok());
  CHECK(video.error().message.find("install it (apt install ffmpeg)") != std::string::npos);
}
