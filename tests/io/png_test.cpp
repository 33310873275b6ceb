#include "io/png.h"

#include <doctest/doctest.h>

#include "support/shared_data.h"

using namespace vasa;

namespace {

Image gradient(std::uint32_t width, std::uint32_t height) {
  Image image{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (const unsigned value : {x * 7, y * 11, x + y, 128 + x}) image.rgba.push_back(std::uint8_t(value));
  return image;
}

}  // namespace

TEST_CASE("a picture survives, with and without its alpha") {
  test::TemporaryFolder folder;
  const Image image = gradient(13, 7);
  REQUIRE(writePng(folder.path() / "a.png", image, PngOptions{.alpha = true}).ok());
  const auto read = readPng(folder.path() / "a.png");
  REQUIRE(read.ok());
  CHECK(read->width == 13);
  CHECK(read->rgba == image.rgba);
  const auto opaque = decodePng(*encodePng(image), "b.png");
  REQUIRE(opaque.ok());
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    CHECK(opaque->rgba[i] == (i % 4 == 3 ? 255 : image.rgba[i]));
}

TEST_CASE("the same picture gives the same bytes") {
  CHECK(*encodePng(gradient(64, 64)) == *encodePng(gradient(64, 64)));
}

TEST_CASE("a comment is kept and read back; none is none") {
  test::TemporaryFolder folder;
  REQUIRE(writePng(folder.path() / "a.png", gradient(9, 9), PngOptions{.comment = "run 42"}).ok());
  CHECK(*readPngComment(folder.path() / "a.png") == "run 42");
  CHECK(readPng(folder.path() / "a.png").ok());
  REQUIRE(writePng(folder.path() / "b.png", gradient(9, 9)).ok());
  CHECK(readPngComment(folder.path() / "b.png")->empty());
  CHECK(!readPngComment(folder.path() / "none.png").ok());
}

TEST_CASE("the resolution for print is in the file where one is given") {
  const Image image{1, 1, {1, 2, 3, 255}};
  const auto chunk = [](const std::vector<std::byte>& bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto at = text.find("pHYs");
    return at == text.npos ? std::string() : std::string(text.substr(at + 4, 9));
  };
  const auto with = encodePng(image, {.dotsPerInch = 300}), without = encodePng(image);
  REQUIRE(with.ok());
  REQUIRE(without.ok());
  CHECK(chunk(*with) == std::string("\x00\x00\x2e\x23\x00\x00\x2e\x23\x01", 9));  // 11,811 a metre
  CHECK(chunk(*without).empty());
}

TEST_CASE("no picture, no crash") {
  const auto garbage = decodePng(std::as_bytes(std::span("not a png at all")), "x.png");
  REQUIRE(!garbage.ok());
  CHECK(garbage.error().fault == Fault::badInput);
  auto bytes = *encodePng(gradient(20, 20));
  bytes.resize(bytes.size() / 2);
  CHECK(!decodePng(bytes, "x.png").ok());
  CHECK(!encodePng(Image{}).ok());
}

TEST_CASE("a full disk is told") {
  const auto written = writePng("/dev/full", gradient(64, 64));
  REQUIRE(!written.ok());
  CHECK(written.error().fault == Fault::io);
}
