#include "plate/sheet.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include "plate/plate.h"

using namespace vasa;
using namespace vasa::plate;

namespace {

Sheet example() {
  auto image = std::make_shared<Image>(Image{2, 1, {255, 0, 0, 255, 0, 0, 255, 255}});
  Sheet sheet{.size = {100, 50}, .title = "A & B", .items = {}};
  sheet.items.push_back(SheetPicture{{10, 10}, {20, 10}, image, "two <halves>"});
  sheet.items.push_back(SheetLine{{{40, 5}, {60, 5}}, 2, {0, 0, 0}, "leader", "a \"b\""});
  sheet.items.push_back(SheetDisc{{80, 25}, 5, {0, 1, 0}});
  sheet.items.push_back(SheetBox{{5, 40}, {15, 45}, {0, 0, 1}});
  sheet.items.push_back(SheetText{.at = {95, 40},
                                  .align = Lettering::Align::right,
                                  .size = 5,
                                  .text = "Vène ½",
                                  .kind = "label",
                                  .subject = "vène"});
  return sheet;
}

vec3 pixel(const Image& image, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = &image.rgba[4 * (std::size_t(y) * image.width + x)];
  return {p[0], p[1], p[2]};
}

bool has(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

}  // namespace

TEST_CASE("a sheet in pixels has everything where it was put") {
  const auto image = sheetImage(example(), 254);  // ten pixels a millimetre
  REQUIRE(image.ok());
  CHECK(image->width == 1000);
  CHECK(image->height == 500);
  CHECK(pixel(*image, 150, 150) == vec3(255, 0, 0));
  CHECK(pixel(*image, 250, 150) == vec3(0, 0, 255));
  CHECK(pixel(*image, 99, 150) == vec3(255));
  CHECK(pixel(*image, 500, 50) == vec3(0));
  CHECK(pixel(*image, 500, 65) == vec3(255));
  CHECK(pixel(*image, 800, 250) == vec3(0, 255, 0));
  CHECK(pixel(*image, 840, 290) == vec3(255));
  CHECK(pixel(*image, 100, 420) == vec3(0, 0, 255));
  int ink = 0;
  for (std::uint32_t y = 360; y < 410; ++y)
    for (std::uint32_t x = 700; x < 950; ++x) ink += pixel(*image, x, y).x < 100;
  CHECK(ink > 500);
}

TEST_CASE("a sheet as SVG: structure, names, and nothing that XML would trip over") {
  const auto type = Typesetter::load();
  REQUIRE(type.ok());
  const auto svg = sheetSvg(example(), *type);
  REQUIRE(svg.ok());
  CHECK(has(*svg, R"(width="100mm" height="50mm" viewBox="0 0 100 50")"));
  CHECK(has(*svg, "<title>A &amp; B</title>"));
  CHECK(has(*svg, R"(<image x="10.000" y="10.000" width="20.000")"));
  CHECK(has(*svg, "data:image/png;base64,iVBOR"));
  CHECK(has(*svg,
            R"(<polyline class="leader" data-vessel="a &quot;b&quot;" points="40.000,5.000 60.000,5.000")"));
  CHECK(has(*svg, R"(text-anchor="end")"));
  CHECK(has(*svg, ">Vène ½</text>"));
  CHECK(svg->ends_with("</svg>\n"));
  Sheet odd = example();
  odd.title = "a\xe9 b\x01 <\xef\xbf\xbf\xc3\xa9";  // Latin-1, a control character, U+FFFF: none is XML
  const auto plain = sheetSvg(odd, *type);
  REQUIRE(plain.ok());
  CHECK(has(*plain, "<title>a b &lt;é</title>"));
}

TEST_CASE("a sheet as PDF: every object is where the table says, and streams are as long as they say") {
  const auto type = Typesetter::load();
  REQUIRE(type.ok());
  const auto bytes = sheetPdf(example(), *type);
  REQUIRE(bytes.ok());
  const std::string pdf(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  CHECK(pdf.starts_with("%PDF-1.5\n"));
  const std::size_t table = std::stoul(pdf.substr(pdf.rfind("startxref") + 10));
  REQUIRE(pdf.substr(table, 5) == "xref\n");
  const std::size_t count = std::stoul(pdf.substr(table + 7));
  const std::size_t first = pdf.find('\n', table + 5) + 1;
  for (std::size_t i = 1; i < count; ++i) {
    const std::size_t at = std::stoul(pdf.substr(first + 20 * i, 10));
    CHECK(pdf.substr(at).starts_with(std::to_string(i) + " 0 obj\n"));
    const std::size_t end = pdf.find("endobj", at), stream = pdf.find("stream\n", at);
    if (stream > end) continue;
    const std::size_t length = std::stoul(pdf.substr(pdf.find("/Length ", at) + 8));
    CHECK(pdf.substr(stream + 7 + length).starts_with("\nendstream"));
  }
  CHECK(has(pdf, "/MediaBox [0 0 283.465 141.732]"));
  CHECK(has(pdf, "/Width 2 /Height 1"));
  CHECK(has(pdf, "/FontName /DejaVuSans-Bold"));
}

TEST_CASE("a title that is wider than its page gets smaller letters") {
  const auto type = Typesetter::load();
  REQUIRE(type.ok());
  const auto widthOf = [&](const std::string& title) {
    PlateStyle style{.legend = false, .scale = false};
    style.title = title;
    const auto image = std::make_shared<Image>(Image{1, 1, {0, 0, 0, 255}});
    for (const auto& item : plateSheet({}, style, *type, image, {}).items)
      if (const auto* words = std::get_if<SheetText>(&item); words && words->kind == "title")
        return type->widthOf(words->text, words->size, true);
    return 0.0f;
  };
  const float plain = type->widthOf("Thorax", 2.3f * PlateStyle{}.letters, true);
  CHECK(widthOf("Thorax") == doctest::Approx(plain));
  CHECK(widthOf(std::string(200, 'W')) <= doctest::Approx(190));
}

TEST_CASE("words are broken at blanks, in as few lines as the width takes") {
  const auto type = Typesetter::load();
  REQUIRE(type.ok());
  CHECK(type->wrap("Aorta", 3, 100) == std::vector<std::string>{"Aorta"});
  const auto lines = type->wrap("Radial palmar digital artery of index finger", 3, 45);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] + " " + lines[1] == "Radial palmar digital artery of index finger");
  for (const std::string& line : lines) CHECK(type->widthOf(line, 3) <= 45);
  CHECK(type->widthOf("femoral", 6) == doctest::Approx(2 * type->widthOf("femoral", 3)));
}

TEST_CASE("a scale bar is 1, 2 or 5 times a power of ten, as long as there is room for") {
  CHECK(scaleLength(100, 25) == doctest::Approx(0.2f));
  CHECK(scaleLength(100, 9.9f) == doctest::Approx(0.05f));
  CHECK(scaleLength(1000, 10) == doctest::Approx(0.01f));
  CHECK(scaleLength(0.5f, 30) == doctest::Approx(50));
}

TEST_CASE("a picture fades along the edges that are cut, and only there") {
  Image picture{100, 200, std::vector<std::uint8_t>(100 * 200 * 4, 0)};
  CutEdges cut;
  cut.along[2] = {1, 0};  // the left half of the upper edge
  fadeEdges(picture, cut, vec3(1));
  CHECK(pixel(picture, 25, 0).x > 250);
  CHECK(pixel(picture, 75, 0).x == 0);
  CHECK(pixel(picture, 25, 20).x == 0);
  CHECK(pixel(picture, 0, 100).x == 0);
  CHECK(pixel(picture, 50, 199).x == 0);
}
