#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <map>

#include "golden/compare.h"
#include "golden/gallery.h"
#include "gpu/gpu_rig.h"
#include "io/png.h"

// Pictures against those of tests/golden/pictures. After a change of the look that is meant, write them anew
// with scripts/golden.sh and look at each one that changed.

using namespace vasa;

namespace {

std::filesystem::path pathOf(const std::string& name) {
  return std::filesystem::path("tests/golden/pictures") / (name + ".png");
}

bool writing() { return std::getenv("VASA_WRITE_GOLDEN") != nullptr; }

golden::Drawn drawnBy(const test::GpuRig& rig) {
  return {rig.device().limits().subPixelPrecisionBits, !rig.device().isCpu()};
}

Image stored(const std::string& name) {
  auto picture = readPng(pathOf(name));
  REQUIRE_MESSAGE(picture.ok(), (picture.ok() ? "" : picture.error().message));
  return std::move(*picture);
}

void write(const std::string& name, const Image& image) {
  std::filesystem::create_directories(pathOf(name).parent_path());
  const auto written = writePng(pathOf(name), image, {.alpha = name == "presets/transparent"});
  REQUIRE_MESSAGE(written.ok(), (written.ok() ? "" : written.error().message));
}

void check(const test::GpuRig& rig, const std::vector<golden::Picture>& pictures) {
  for (const golden::Picture& picture : pictures) {
    CAPTURE(picture.name);
    const Image image = picture.draw(rig.device());
    if (writing()) {
      write(picture.name, image);
      continue;
    }
    const golden::Difference difference = golden::compare(stored(picture.name), image);
    CAPTURE(difference.mean);
    CAPTURE(difference.changed);
    CHECK(golden::same(difference, drawnBy(rig)));
  }
}

}  // namespace

TEST_CASE("pictures of synthetic networks are what they were") {
  VASA_REQUIRE_GPU(rig);
  check(rig, golden::syntheticPictures());
}

TEST_CASE("pictures of the built-in human are what they were") {
  VASA_REQUIRE_GPU(rig);
  check(rig, golden::humanPictures());
}

TEST_CASE("a change in any family is seen") {
  VASA_REQUIRE_GPU(rig);
  if (writing()) return;
  std::map<std::string, int> families;
  for (const auto& pictures : {golden::syntheticPictures(), golden::humanPictures()})
    for (const golden::Picture& picture : pictures)
      families[picture.name.substr(0, picture.name.find('/'))] = 0;
  for (const auto& mutations : {golden::syntheticMutations(), golden::humanMutations()})
    for (const golden::Picture& mutation : mutations) {
      CAPTURE(mutation.name);
      CHECK(!golden::same(golden::compare(stored(mutation.name), mutation.draw(rig.device())), drawnBy(rig)));
      ++families[mutation.name.substr(0, mutation.name.find('/'))];
    }
  for (const auto& family : families) {
    CAPTURE(family.first);
    CHECK(family.second > 0);
  }
}

TEST_CASE("there are at least sixty pictures, and none is left over") {
  std::size_t known = 0, files = 0;
  for (const auto& pictures : {golden::syntheticPictures(), golden::humanPictures()})
    known += pictures.size();
  for (const auto& entry : std::filesystem::recursive_directory_iterator("tests/golden/pictures"))
    files += entry.path().extension() == ".png";
  CHECK(known >= 60);
  if (!writing()) CHECK(files == known);
}
