#include "io/markups.h"

#include <doctest/doctest.h>

#include "io/reading.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// One curve of three points along +Z, as Extract Centerline writes them.
std::string curve(const std::string& more, const std::string& radii = "[4, 3, 2]") {
  return R"({"@schema": "https://raw.githubusercontent.com/slicer/slicer/master/x.json#", "markups": [{"type": "Curve", )" +
         more +
         R"("controlPoints": [{"position": [10, 20, 0]}, {"position": [10, 20, 30]}, {"position": [10, 20, 60]}],
             "measurements": [{"name": "length", "value": 60.0},
                              {"name": "Radius", "units": "mm", "controlPointValues": )" +
         radii + "}]}]}";
}

Centrelines read(const std::string& text) {
  auto lines = parseMarkups(text, "folder/LAD.mrk.json", VesselKind::artery);
  if (!lines.ok()) FAIL(lines.error().message);
  return std::move(*lines);
}

void expectMarkupsFault(const std::string& text, const char* message) {
  INFO(text);
  expectFault(parseMarkups(text, "a.mrk.json", VesselKind::artery), message);
}

}  // namespace

TEST_CASE("a curve of 3D Slicer with radii, in its own unit and axes") {
  CHECK(isMarkupsFile("a/Centerline curve (1).mrk.json"));
  CHECK(!isMarkupsFile("scene.json"));
  const Centrelines lps = read(curve(R"("coordinateSystem": "LPS", )"));
  REQUIRE(lps.lines.size() == 1);
  CHECK(lps.lines[0].name == "LAD");
  CHECK(lps.lines[0].kind == VesselKind::artery);
  REQUIRE(lps.lines[0].samples.size() == 3);
  CHECK(lps.lines[0].samples[1] == vec4(0.01f, 0.03f, -0.02f, 0.003f));
  CHECK(read(curve(R"("coordinateSystem": "RAS", )")).lines[0].samples[1] ==
        vec4(-0.01f, 0.03f, 0.02f, 0.003f));
  CHECK(read(curve(R"("coordinateUnits": "cm", )")).lines[0].samples[1] == vec4(0.1f, 0.3f, -0.2f, 0.003f));
  CHECK(read(curve("", "[4, 0, 0]")).lines[0].samples[2].w == 0.004f);
}

TEST_CASE("several curves of one file are lines; points without a place are passed over") {
  const std::string one =
      R"({"type": "Curve", "controlPoints": [{"position": [0, 0, 0]}, {"positionStatus": "undefined"},
          {"position": [0, 0, 9]}, {"position": [0, 0, 9]}],
          "measurements": [{"name": "Radius", "controlPointValues": [1, 2, 3, 4]}]})";
  const Centrelines lines =
      read(R"({"markups": [)" + one + R"(, {"type": "Fiducial", "controlPoints": []}, )" + one + "]}");
  REQUIRE(lines.lines.size() == 2);
  CHECK(lines.lines[1].name == "LAD 2");
  CHECK(lines.lines[0].samples == std::vector<vec4>{vec4(0, 0, 0, 0.001f), vec4(0, 0.009f, 0, 0.003f)});
}

TEST_CASE("markups that are no vessels are refused with what to do") {
  expectMarkupsFault("{", "a.mrk.json: is not valid JSON");
  expectMarkupsFault("[]", "holds no curve");
  expectMarkupsFault(R"({"markups": [{"type": "Fiducial"}]})",
                     "markups of type Fiducial; centre lines are those of type Curve");
  expectMarkupsFault(R"({"markups": [{"type": "Curve", "controlPoints": [{"position": [0, 0, 0]}]}]})",
                     "holds no curve of two control points");
  expectMarkupsFault(
      R"({"markups": [{"type": "Curve", "controlPoints": [], "measurements": [{"name": "Radius"}]}]})",
      "holds no curve of two control points");
  expectMarkupsFault(
      R"({"markups": [{"type": "Curve", "controlPoints": [{"position": [0, 0, 0]}, {"position": [0, 0, 1]}]}]})",
      "/markups/0: the curve's control points have no radii");
  expectMarkupsFault(curve("", "[4, 3]"), "have no radii");
  expectMarkupsFault(curve("", "[4, -3, 2]"), "radius -3 of point 1 must be positive");
  expectMarkupsFault(curve("", "[0, 0, 0]"), "all radii are zero");
  expectMarkupsFault(curve(R"("coordinateUnits": "furlong", )"), "/markups/0/coordinateUnits");
  expectMarkupsFault(curve(R"("coordinateSystem": "IJK", )"), "neither LPS nor RAS");
  expectMarkupsFault(curve("", R"([4, "a", 2])"), "a radius must be a number");
  expectMarkupsFault(std::string(40, '['), "nested too deeply");
  expectMarkupsFault(std::string(3'000'001, ' '), "more than 3 MB");
}
