#include "view/session.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>

#include "golden/compare.h"
#include "io/png.h"

namespace vasa::test {

std::filesystem::path scriptIn(const std::filesystem::path& folder, std::string text) {
  for (std::size_t at = 0; (at = text.find("OUT/", at)) != std::string::npos;)
    text.replace(at, 4, folder.string() + "/");
  const auto path = folder / "script.txt";
  std::ofstream(path) << text;
  return path;
}

ProgramOptions on(const VirtualDisplay& display, const TemporaryFolder& home) {
  static const TemporaryFolder cache;  // the driver compiles shaders once for all sessions
  return {.environment = {display.variable(), "XDG_CONFIG_HOME=" + home.path().string(),
                          "XDG_CACHE_HOME=" + cache.path().string()},
          .folder = home.path().string()};
}

void checkPicture(const std::filesystem::path& found, const std::string& name) {
  CAPTURE(name);
  const auto picture = readPng(found);
  REQUIRE_MESSAGE(picture, (picture ? "" : picture.error().message));
  const auto stored = std::filesystem::path("tests/view/pictures") / (name + ".png");
  if (std::getenv("VASA_WRITE_GOLDEN")) {
    std::filesystem::create_directories(stored.parent_path());
    REQUIRE(writePng(stored, *picture));
    return;
  }
  const auto wanted = readPng(stored);
  REQUIRE_MESSAGE(wanted, (wanted ? "" : wanted.error().message));
  REQUIRE(wanted->width == picture->width);
  REQUIRE(wanted->height == picture->height);
  const golden::Difference difference = golden::compare(*wanted, *picture);
  CAPTURE(difference.mean);
  CAPTURE(difference.changed);
  CHECK(golden::same(difference));
}

}  // namespace vasa::test
