#include "io/vtp.h"

#include <doctest/doctest.h>

#include <zlib.h>

#include "io/base64.h"
#include "io/radius_array.h"
#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// Three points in one line, every array in its own encoding.
std::string file(const std::string& points, const std::string& radius, const std::string& connectivity,
                 const std::string& head = "", const std::string& tail = "") {
  return "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" version=\"0.1\" " + head +
         "><PolyData><Piece NumberOfPoints=\"3\" NumberOfLines=\"1\"><PointData>" + radius +
         "</PointData><Points>" + points + "</Points><Lines>" + connectivity +
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Lines></Piece></PolyData>" +
         tail + "</VTKFile>";
}
const std::string kPoints =
    "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0\n2 0 0</DataArray>";
const std::string kRadius =
    "<DataArray type=\"Float64\" Name=\"MaximumInscribedSphereRadius\" format=\"ascii\">1 2 3</DataArray>";
const std::string kLine =
    "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>";

template <class T>
std::vector<std::byte> packed(const std::vector<T>& values, bool bigEndian = false) {
  std::vector<std::byte> bytes;
  for (const T& value : values) {
    const auto one = std::as_bytes(std::span(&value, 1));
    if (bigEndian)
      bytes.insert(bytes.end(), one.rbegin(), one.rend());
    else
      bytes.insert(bytes.end(), one.begin(), one.end());
  }
  return bytes;
}
std::vector<std::byte> operator+(std::vector<std::byte> a, const std::vector<std::byte>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void expectRead(const std::string& text) {
  const auto read = parseVtp(bytesOf(text), "a.vtp");
  if (!read.ok()) FAIL(read.error().message);
  REQUIRE(read->points.size() == 3);
  CHECK(read->points[2] == vec4(2, 0, 0, 3));
  CHECK(read->lines == std::vector<std::vector<std::uint32_t>>{{0, 1, 2}});
}
void expectVtpFault(const std::string& text, const char* message) {
  expectFault(parseVtp(bytesOf(text), "a.vtp"), message);
}

}  // namespace

TEST_CASE("VTP radii under other names, of lines, and diameters") {
  const auto named = [](const std::string& name, const std::string& content) {
    return "<DataArray type=\"Float64\" Name=\"" + name + "\" format=\"ascii\">" + content + "</DataArray>";
  };
  for (const char* name : {"Radius", "RADIUS", "radii", "r", "MISR", "vessel_radius", "EdgeRadius",
                           "lumenradius", "Rayon", "raggio", "Radio"})
    expectRead(file(kPoints, named(name, "1 2 3"), kLine));
  for (const char* name :
       {"Diameter", "diameters", "MeanDiameter", "Diam\xc3\xa8tre", "moyen_diame\xcc\x80tre", "Durchmesser"})
    expectRead(file(kPoints, named(name, "2 4 6"), kLine));
  // The best of several, whatever their order.
  expectRead(
      file(kPoints, named("Diameter", "9 9 9") + named("r", "1 2 3") + named("Curvature", "7 7 7"), kLine));
  expectRead(file(kPoints, named("CurvatureRadius", "9 9 9") + named("Diameter", "2 4 6"), kLine));
  expectRead(file(kPoints, named("BallRadius", "9 9 9") + named("Diameter", "2 4 6"), kLine));
  expectRead(file(kPoints, named("MinRadius", "9 9 9") + named("MaxRadius", "1 2 3"), kLine));
  expectRead(file(kPoints, named("min_radius", "9 9 9") + named("Equivalent diameter", "2 4 6"), kLine));
  expectRead(file(kPoints, named("MinRadius", "1 2 3"), kLine));
  expectVtpFault(file(kPoints, named("CurvatureRadius", "9 9 9"), kLine), "it has CurvatureRadius");
  expectVtpFault(file(kPoints, named("radiusofcurvature", "9 9 9"), kLine), "it has radiusofcurvature");
  // A unit of their own.
  expectRead(file(kPoints, named("radius_mm", "1000 2000 3000"), kLine));
  expectRead(file(kPoints, named("rayon \xc2\xb5m", "1e6 2e6 3e6"), kLine));
  expectRead(file(kPoints, named("Max Diameter (cm)", "200 400 600"), kLine));
  const auto inMillimetres =
      parseVtp(bytesOf(file(kPoints, named("radius [mm]", "1 2 3"), kLine)), "a.vtp", kMillimetres);
  REQUIRE(inMillimetres.ok());
  CHECK(inMillimetres->points[2] == vec4(0.002f, 0, 0, 0.003f));
  std::string ofLines = file(kPoints, "", kLine);
  ofLines.insert(ofLines.find("<PointData>"), "<CellData>" + named("Radius", "3") + "</CellData>");
  const auto read = parseVtp(bytesOf(ofLines), "a.vtp");
  if (!read.ok()) FAIL(read.error().message);
  for (const vec4& point : read->points) CHECK(point.w == 3);
}

TEST_CASE("radii of nothing come along lines, also from other lines, else they are the mean") {
  std::vector<vec4> points{{0, 0, 0, 0}, {1, 0, 0, 0}, {2, 0, 0, 4}, {3, 0, 0, 2},
                           {9, 0, 0, 0}, {8, 0, 0, 0}, {7, 0, 0, 0}};
  const std::vector<std::vector<std::uint32_t>> lines{{1, 0}, {2, 1}, {2, 3}, {4, 5}};
  CHECK(mendRadii(lines, points) == 4);
  CHECK(points[0].w == 4);
  CHECK(points[1].w == 4);
  CHECK(points[4].w == 3);
  CHECK(points[5].w == 3);
  CHECK(points[6].w == 0);  // of no line
  std::vector<vec4> bare(7, vec4(0));
  CHECK(!mendRadii(lines, bare));
}

TEST_CASE("VTP data in every encoding") {
  const std::vector<float> radii{1, 2, 3};
  const auto radius = [](const std::string& format, const std::string& content) {
    return "<DataArray type=\"Float32\" Name=\"Radius\" " + format + ">" + content + "</DataArray>";
  };
  expectRead(file(kPoints, kRadius, kLine));
  const auto plain = packed<std::uint32_t>({12}) + packed(radii);
  expectRead(file(kPoints, radius("format=\"binary\"", "\n  " + encodeBase64(plain) + "\n"), kLine));
  const auto big = packed<std::uint64_t>({12}, true) + packed(radii, true);
  expectRead(file(kPoints, radius("format=\"binary\"", encodeBase64(big)), kLine,
                  "byte_order=\"BigEndian\" header_type=\"UInt64\""));
  std::vector<std::byte> squeezed(100);
  uLongf length = 100;
  REQUIRE(compress(reinterpret_cast<Bytef*>(squeezed.data()), &length,
                   reinterpret_cast<const Bytef*>(radii.data()), 12) == Z_OK);
  squeezed.resize(length);
  const auto header = packed<std::uint32_t>({1, 32768, 12, std::uint32_t(length)});
  const std::string zlib = "compressor=\"vtkZLibDataCompressor\"";
  expectRead(
      file(kPoints, radius("format=\"binary\"", encodeBase64(header) + encodeBase64(squeezed)), kLine, zlib));
  const auto raw = header + squeezed;
  const std::string rawText(reinterpret_cast<const char*>(raw.data()), raw.size());
  expectRead(file(kPoints, radius("format=\"appended\" offset=\"2\"", ""), kLine, zlib,
                  "<AppendedData encoding=\"raw\">_\x01<" + rawText + "</AppendedData>"));
  expectRead(file(kPoints, radius("format=\"appended\" offset=\"4\"", ""), kLine, zlib,
                  "<AppendedData encoding=\"base64\">_AAAA" + encodeBase64(header) + encodeBase64(squeezed) +
                      encodeBase64(header) + "</AppendedData>"));
}

TEST_CASE("what is wrong with a VTP file is told with its place") {
  const auto array = [](const char* type, const char* name, const char* content,
                        const char* format = "ascii") {
    return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"" + format + "\">" +
           content + "</DataArray>";
  };
  const char* r = "MaximumInscribedSphereRadius";
  expectVtpFault("", "not valid XML");
  expectVtpFault("<VTKFile><PolyData></VTKFile>", "line 1: is not valid XML");
  expectVtpFault("<svg/>", "no VTK XML file");
  expectVtpFault("<html/>", "it is a web page, saved in place of the file");
  expectVtpFault("<VTKFile type=\"ImageData\"/>", "holds ImageData, not PolyData");
  expectVtpFault("<VTKFile compressor=\"vtkLZ4DataCompressor\"/>", "save the file with zlib");
  expectVtpFault("<VTKFile><PolyData/></VTKFile>", "no lines");
  expectVtpFault("<VTKFile><PolyData><Piece NumberOfPoints=\"x\" NumberOfLines=\"1\"/></PolyData></VTKFile>",
                 "Piece[0]/NumberOfPoints: must be a whole number");
  expectVtpFault("<VTKFile><PolyData><Piece NumberOfPoints=\"99999999999\"/></PolyData></VTKFile>",
                 "must lie between");
  expectVtpFault(file("", kRadius, kLine), "Points: is missing");
  expectVtpFault(file(kPoints, "", kLine), "has no array of radii: name one MaximumInscribedSphereRadius");
  expectVtpFault(file(kPoints, array("Float64", "Curvature", "1 2 3"), kLine), "(it has Curvature)");
  expectVtpFault(file(kPoints, array("Float64", r, "1 2"), kLine), "holds 2 numbers for 3 points");
  expectVtpFault(file(kPoints, array("Float64", r, "1 -2 3"), kLine),
                 "radius -2 of point 1 must be positive");
  expectVtpFault(file(kPoints, array("Float64", r, "1 nan 3"), kLine), "no finite number: 'nan'");
  expectVtpFault(file(kPoints, array("Float64", r, "0 0 0"), kLine), "no radius above zero");
  expectVtpFault(file(kPoints, array("Float80", r, "1 2 3"), kLine), "not a number type");
  expectVtpFault(file(kPoints, array("Float64", r, "1 2 3", "hex"), kLine),
                 "must be ascii, binary or appended");
  expectVtpFault(file(kPoints, array("Float64", r, "###", "binary"), kLine), "is not base64");
  expectVtpFault(file(kPoints, array("Float64", r, "//8AAAAA", "binary"), kLine), "is cut short");
  expectVtpFault(file(kPoints, kRadius, array("Int64", "connectivity", "0 1 3")),
                 "value 2 lies outside the 3 points");
  expectVtpFault(file(kPoints, kRadius, array("Int64", "connectivity", "0 1")),
                 "must not fall and not exceed");
  CHECK(readVtp("/nowhere/a.vtp").error().fault == Fault::io);
}

TEST_CASE("VTP written is read back the same, byte for byte") {
  Centrelines lines;
  lines.lines.push_back({"left \xc3\xa4orta & <co>",
                         {},
                         VesselKind::vein,
                         {{0, 0, 0, 0.01f}, {0.1f, 0.2f, 0.3f, 0.02f}, {0.7f, 0, 0, 0.03f}}});
  lines.lines.push_back(
      {"branch", {}, VesselKind::artery, {{0.1f, 0.2f, 0.3f, 0.001f}, {0.1f, 0.5f, 0.3f, 0.002f}}});
  lines.joints = {{Centrelines::Place{0, 1}, {{1, false}}}};
  const std::string text = encodeVtp(vtpOfCentrelines(lines), kMillimetres);
  const auto read = parseVtp(bytesOf(text), "a.vtp", kMillimetres);
  if (!read.ok()) FAIL(read.error().message);
  CHECK(encodeVtp(*read, kMillimetres) == text);
  const Centrelines again = centrelinesOfVtp(*read, "a", VesselKind::other).value();
  REQUIRE(again.lines.size() == 2);
  for (int i = 0; i < 2; ++i) {
    CHECK(again.lines[i].name == lines.lines[i].name);
    CHECK(again.lines[i].kind == lines.lines[i].kind);
    CHECK(again.lines[i].samples == lines.lines[i].samples);
  }
  REQUIRE(again.joints.size() == 1);
  CHECK(again.joints[0].host->sample == 1);
  CHECK(encodeVtp(vtpOfCentrelines(again), kMillimetres) == text);
}

TEST_CASE("names of arrays that XML might take for its own survive") {
  VtpLines lines;
  lines.points = {{0, 0, 0, 1}, {1, 0, 0, 1}};
  lines.lines = {{0, 1}};
  lines.cellArrays = {{"a<AppendedData & \"b\"\n", {7}}};
  const std::string text = encodeVtp(lines);
  const auto read = parseVtp(bytesOf(text), "a.vtp");
  if (!read.ok()) FAIL(read.error().message);
  REQUIRE(read->cellArrays.size() == 1);
  CHECK(read->cellArrays[0].name == lines.cellArrays[0].name);
  CHECK(encodeVtp(*read) == text);
}

TEST_CASE("VMTK's aorta: one tree, radii within 1 % of the source's at every sample") {
  VASA_REQUIRE_SHARED_DATA(data);
  for (const char* name : {"aorta-centerline.vtp", "aorta-centerline-branches.vtp"}) {
    const auto source = readVtp(data / "centerlines/vmtk" / name, kMillimetres);
    if (!source.ok()) FAIL(source.error().message);
    const Centrelines lines = centrelinesOfVtp(*source, "aorta", VesselKind::artery).value();
    const auto made = networkOfCentrelines(lines);
    if (!made.ok()) FAIL(made.error().message);
    CHECK(made->network.vessels().size() == 2);
    CHECK(made->network.componentCount() == 1);
    // Against the source's own points, wherever the network passes nearest.
    float worst = 0, farthest = 0;
    for (const vec4& wanted : source->points) {
      vec4 best(0);
      float least = 1e9f;
      for (const Vessel& vessel : made->network.vessels())
        for (std::uint32_t i = 0; i <= 64 * vessel.spanCount(); ++i) {
          const vec4 at = evaluate(made->network.pointsOf(vessel), float(i) / 64);
          const float distance = glm::distance(at, wanted);
          if (distance < least) least = distance, best = at;
        }
      worst = std::max(worst, std::abs(best.w - wanted.w) / wanted.w);
      farthest = std::max(farthest, glm::distance(vec3(best), vec3(wanted)));
    }
    CHECK(worst < 0.01f);
    CHECK(farthest < 5e-4f);
    MESSAGE(std::string(name) << ": " << made->network.sweepCount() << " sweeps, radius within "
                              << 100 * worst << " %, centre within " << 1000 * farthest << " mm");
  }
}

namespace {

// Two-point lines along these polylines; every piece with points of its own, or shared by number.
VtpLines pieces(const std::vector<std::vector<vec4>>& polylines, bool shared, float rounding) {
  VtpLines file;
  const auto number = [&](vec4 p) {
    if (shared)
      for (std::uint32_t i = 0; i < file.points.size(); ++i)
        if (file.points[i] == p) return i;
    file.points.push_back(p + (file.points.size() % 2 ? rounding : 0) * vec4(1, 0, 0, 0));
    return std::uint32_t(file.points.size() - 1);
  };
  for (const auto& line : polylines)
    for (std::size_t i = 1; i < line.size(); ++i) {
      const std::uint32_t a = number(line[i - 1]), b = number(line[i]);
      file.lines.push_back({a, b});
    }
  return file;
}

}  // namespace

TEST_CASE(
    "two-point lines that share points are vessels with forks, by number, by place and by about the same place") {
  std::vector<vec4> trunk, branch, other;
  for (int i = 0; i <= 40; ++i) trunk.push_back({0, float(i), 0, 1});
  for (int i = 0; i <= 20; ++i) branch.push_back({float(i), 20 + 0.5f * float(i), 0, 0.5f});
  for (int i = 0; i <= 20; ++i) other.push_back({60 + float(i), 0, 0, 0.5f});
  branch[0].w = trunk[20].w;  // the shared point has one radius
  for (const auto& [shared, rounding] :
       {std::pair(true, 0.0f), std::pair(false, 0.0f), std::pair(false, 0.01f)}) {
    const auto lines =
        centrelinesOfVtp(pieces({trunk, branch, other}, shared, rounding), "brain", VesselKind::artery);
    REQUIRE(lines.ok());
    REQUIRE(lines->lines.size() == 3);
    CHECK(lines->lines[0].samples.size() == 41);
    const auto made = networkOfCentrelines(*lines);
    if (!made.ok()) FAIL(made.error().message);
    CHECK(made->network.componentCount() == 2);
    CHECK(made->network.junctionCount() == 1);
  }
}

namespace {

// Whole lines, each of one or several tracts, with VMTK's numbers.
VtpLines numbered(const std::vector<std::vector<vec4>>& tracts, const std::vector<std::int32_t>& ids,
                  const std::vector<std::int32_t>& numbers) {
  VtpLines file;
  for (const auto& tract : tracts) {
    file.lines.emplace_back();
    for (const vec4& sample : tract) {
      file.lines.back().push_back(std::uint32_t(file.points.size()));
      file.points.push_back(sample);
    }
  }
  file.cellArrays = {{"CenterlineIds", ids}, {"TractIds", numbers}};
  return file;
}

std::vector<vec4> alongY(float x, float from, float to) {
  std::vector<vec4> samples;
  for (float y = from; y <= to; ++y) samples.push_back({x, y, 0, 1});
  return samples;
}

}  // namespace

TEST_CASE("lines of files that were put together keep apart though their numbers are the same") {
  const auto lengths = [](const VtpLines& file) {
    const auto lines = centrelinesOfVtp(file, "a", VesselKind::artery);
    REQUIRE(lines.ok());
    std::vector<float> all;
    for (const auto& line : lines->lines)
      all.push_back(glm::distance(vec3(line.samples.front()), vec3(line.samples.back())));
    return all;
  };
  CHECK(lengths(numbered({alongY(0, 0, 40), alongY(0, 40, 90)}, {0, 0}, {0, 1})) == std::vector{90.0f});
  CHECK(lengths(numbered({alongY(0, 0, 90), alongY(50, 0, 90)}, {0, 0}, {0, 0})) ==
        std::vector{90.0f, 90.0f});
  CHECK(lengths(numbered({alongY(0, 0, 40), alongY(0, 40, 90), alongY(50, 0, 40), alongY(50, 40, 90)},
                         {0, 0, 0, 0}, {0, 1, 0, 1})) == std::vector{90.0f, 90.0f});
  // The second with a tract more, which would go on from the first's end.
  CHECK(lengths(numbered(
            {alongY(0, 0, 40), alongY(0, 40, 90), alongY(2, 0, 40), alongY(2, 40, 90), alongY(2, 90, 99)},
            {0, 0, 0, 0, 0}, {0, 1, 0, 1, 2})) == std::vector{99.0f, 90.0f});
  // A bifurcation's tract left out.
  CHECK(lengths(numbered({alongY(0, 0, 40), alongY(0, 43, 90)}, {0, 0}, {0, 2})) == std::vector{90.0f});
  CHECK(lengths(numbered({alongY(0, 0, 40), alongY(50, 0, 40)}, {0, 0}, {0, 1})) ==
        std::vector{40.0f, 40.0f});
}

// VMTK's lines, resampled each from its own outlet, share the inlet's point and no other.
TEST_CASE("lines from one inlet that are sampled at different places do not go on in one another there") {
  VtpLines file;
  const auto add = [&](vec3 outlet, float step) {
    const vec3 inlet(0), fork(0, 60, 0);
    std::vector<vec4> samples;
    for (float way = 0; way < glm::distance(outlet, fork); way += step)
      samples.push_back(vec4(outlet + way * glm::normalize(fork - outlet), 4));
    for (float way = 0.3f * step; way < 59; way += step) samples.push_back(vec4(fork - vec3(0, way, 0), 4));
    samples.push_back(vec4(inlet, 4));
    file.lines.emplace_back();
    for (const vec4& sample : samples) {
      file.lines.back().push_back(std::uint32_t(file.points.size()));
      file.points.push_back(sample);
    }
  };
  add({40, 100, 0}, 2);
  add({-40, 90, 0}, 3);
  const auto lines = centrelinesOfVtp(file, "iliacs", VesselKind::artery);
  REQUIRE(lines.ok());
  const auto made = networkOfCentrelines(*lines);
  REQUIRE(made.ok());
  CHECK(made->network.junctionCount() == 1);
  float length = 0;
  for (const auto& line : lines->lines)
    for (std::size_t i = 1; i < line.samples.size(); ++i)
      length += glm::distance(vec3(line.samples[i - 1]), vec3(line.samples[i]));
  CHECK(length == doctest::Approx(60 + std::hypot(40, 40) + std::hypot(40, 30)).epsilon(0.03));
}

TEST_CASE("a way beside a vessel is a way of its own once it leaves that vessel, however short") {
  const auto linesWith = [](float aside) {
    std::vector<vec4> trunk, loop;
    for (int i = 0; i <= 100; ++i) trunk.push_back({0, float(i), 0, 4});
    for (int i = 0; i <= 12; ++i)
      loop.push_back({aside * std::sin(3.14159265f * float(i) / 12), 44 + float(i), 0, 4});
    VtpLines file;
    for (const auto& line : {trunk, loop}) {
      file.lines.emplace_back();
      for (const vec4& sample : line) {
        file.lines.back().push_back(std::uint32_t(file.points.size()));
        file.points.push_back(sample);
      }
    }
    const auto lines = centrelinesOfVtp(file, "a", VesselKind::artery);
    REQUIRE(lines.ok());
    return lines->lines.size();
  };
  CHECK(linesWith(1) == 1);  // the same way, traced twice
  CHECK(linesWith(5) == 2);
}
