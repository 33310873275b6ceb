#include "io/swc.h"

#include <doctest/doctest.h>

#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

void expectSwcFault(const char* text, const char* message) {
  INFO(text);
  expectFault(parseSwc(text, "a.swc"), message);
}

}  // namespace

TEST_CASE("SWC of others: a byte order mark, and roots whose parent is 0") {
  const auto samples = parseSwc("\xEF\xBB\xBF# made\n1 3 0 0 0 2 0\n2 3 0 10 0 2 1\n", "a.swc");
  if (!samples.ok()) FAIL(samples.error().message);
  CHECK((*samples)[0].parent == SwcSample::kRoot);
  CHECK((*samples)[1].parent == 0);
  // Where there is a sample 0 it is that one.
  const auto counted = parseSwc("0 3 0 0 0 2 -1\n1 3 0 10 0 2 0\n", "a.swc");
  REQUIRE(counted.ok());
  CHECK((*counted)[1].parent == 0);
  const auto oldLines = parseSwc("# made\r1 3 0 0 0 2 -1\r2 3 0 10 0 2 1\r", "a.swc");
  REQUIRE(oldLines.ok());
  CHECK(oldLines->size() == 2);
  const auto table = parseSwc("1,3,0,0,0,2,-1\r\n2, 3, 0, 10.5, 0, 2, 1\r\n", "a.swc");
  REQUIRE(table.ok());
  CHECK((*table)[1].position == vec3(0, 10.5f, 0));
  expectSwcFault("1 3 0,5 0 0 2 -1\n", "with blanks or commas between and decimal points");
  expectSwcFault("1 3 0,5 0,5 0,5 2,0 -1 0,1 0,2\n", "a.swc:1: the id must be a finite number");
  expectSwcFault("1,3,0,0,0,2,-1\n2,3,0,10,,2,1,1\n", "a.swc:2: the z is missing");
  const auto named = parseSwc("id,type,x,y,z,r,parent\n1,3,0,0,0,2,-1\n2,3,0,1,0,2,1\n", "a.swc");
  REQUIRE(named.ok());
  CHECK(named->size() == 2);
}

TEST_CASE(
    "SWC tables of others: titles and names of columns without a #, semicolons, tabs, marks of an end") {
  const auto reads = [](const std::string& text) {
    const auto samples = parseSwc(text, "a.swc");
    INFO(text);
    if (!samples.ok()) FAIL(samples.error().message);
    REQUIRE(samples->size() == 2);
    CHECK((*samples)[1].position == vec3(0, 10, 0));
    CHECK((*samples)[1].parent == 0);
  };
  const std::string rows = "1 3 0 0 0 2 -1\n2 3 0 10 0 2 1\n";
  reads("id type x y z radius parent\n" + rows);
  reads("n\tT\tx\ty\tz\tR\tP\r\n1\t3\t0\t0\t0\t2\t-1\r\n2\t3\t0\t10\t0\t2\t1\r\n");
  reads("Traced by hand\nORIGINAL_SOURCE Neurolucida 11\n" + rows);
  reads(
      "\xEF\xBB\xBF\"Index\";\"Type\";\"X\";\"Y\";\"Z\";\"R\";\"Parent\"\n1;3;0;0;0;2;-1\n2;3;0;10;0;2;1\n");
  reads("1.0 3.0 0 0 0 2 -1.0\n2.0 3.0 0 10 0 2 1.0\n");
  reads("1 3 0 0 0 2 1\n2 3 0 10 0 nan 1\n");
  reads(rows + "\x1a");
  reads(rows + std::string("\r\n\x1a\0\0", 5));
  const char* order = "a.swc:1: the type is in column 7; order the columns: id type x y z radius parent";
  expectSwcFault("id,x,y,z,radius,parent,type\n1,0,0,0,2,-1,3\n", order);
  expectSwcFault("x y z radius\n0 0 0 2\n", "a.swc:1: the x is in column 1; order the columns");
  expectSwcFault("# id type x y z diameter parent\n1 3 0 0 0 2 -1\n",
                 "a.swc:1: gives diameters; write radii");
  CHECK(parseSwc("# diameter x y z of a vessel\n# columns: n T x y z R P\n1 3 0 0 0 2 -1\n", "a.swc").ok());
  expectSwcFault("id type x y z diameter parent\n1 3 0 0 0 2 -1\n", "a.swc:1: gives diameters; write radii");
  reads("id;type;x;y;z;radius;parent\r\n1;3;0;0;0;2,5;-1\r\n2;3;0,0;10,0;0;2,5;1\r\n");
  expectSwcFault("1;3;0,5,1;0;0;2;-1\n", "the x must be a finite number");
  reads("id,type,x [cm],y [cm],z [cm],radius [cm],parent\n1,3,0,0,0,2,-1\n2,3,0,10,0,2,1\n");
  reads("# id type x (mm) y (mm) z (mm) radius (mm) parent\n" + rows);
  expectSwcFault("id,type,x [cm],y [cm],z [cm],radius [mm],parent\n1,3,0,0,0,2,-1\n",
                 "a.swc:1: its columns are in different units; write all lengths in one");
  CHECK(swcUnit("Traced by hand\nid;type;x_um;y_um;z_um;radius_um;parent\n") == 1e-6);
  CHECK(swcUnit("# id type x y z radius parent\n" + rows) == 0);
  expectSwcFault("x1 3 0 0 0 2 -1\n", "a.swc:1: the id must be a finite number, found 'x1'");
}

TEST_CASE("an SWC tree: units, comments, a parent further down, a fork") {
  const auto samples =
      parseSwc("# a comment\n2 3 0 10 0 2 1\r\n1 1 0 0 0 2 -1 # root\n\n3 3 0 20 0 2 2\n4 3 5 15 0 1 2 99\n",
               "a.swc", kMillimetres);
  REQUIRE(samples.ok());
  REQUIRE(samples->size() == 4);
  CHECK((*samples)[0].position == vec3(0, 0.01f, 0));
  CHECK((*samples)[0].radius == 0.002f);
  CHECK((*samples)[0].parent == 1);
  CHECK((*samples)[1].parent == SwcSample::kRoot);
  const Centrelines lines = centrelinesOfSwc(*samples, "a", VesselKind::artery);
  REQUIRE(lines.lines.size() == 2);
  CHECK(lines.lines[0].samples.size() == 3);
  CHECK(lines.lines[0].samples.back() == vec4(0, 0.02f, 0, 0.002f));
  CHECK(lines.lines[1].samples.front() == vec4(0, 0.01f, 0, 0.001f));
  REQUIRE(lines.joints.size() == 1);
  CHECK(lines.joints[0].host->line == 0);
  CHECK(lines.joints[0].host->sample == 1);
}

TEST_CASE("a sample without a radius takes its parent's, a root its child's") {
  const auto samples = parseSwc("1 1 0 0 0 0 -1\n2 3 0 1 0 0 1\n3 3 0 2 0 0.5 2\n4 3 0 3 0 0 3\n", "a.swc");
  REQUIRE(samples.ok());
  for (const SwcSample& s : *samples) CHECK(s.radius == 0.5f);
}

TEST_CASE("what is wrong with an SWC file is told with its line") {
  expectSwcFault("", "no samples");
  expectSwcFault("# only this\n", "no samples");
  expectSwcFault("1 1 0 0 0 1 -1\n2 1 0 0 x 1 1\n", "a.swc:2: the z must be a finite number, found 'x'");
  expectSwcFault("1 1 0 0 0\n", "a.swc:1: the radius is missing");
  expectSwcFault("1 1 0 0 0 inf -1\n", "the radius must be a finite number");
  expectSwcFault("1 1 0 0 0 -0.2 -1\n", "a.swc:1: radius -0.2 must be positive");
  expectSwcFault("1 1 0 0 0 1 -1\n1 1 0 0 1 1 -1\n", "a.swc:2: id 1 is that of line 1 already");
  expectSwcFault("1 1 0 0 0 1 7\n", "a.swc:1: parent 7 does not exist");
  expectSwcFault("1 1 0 0 0 1 2\n2 1 0 0 1 1 1\n", "lead back to itself");
  expectSwcFault("1.5 1 0 0 0 1 -1\n", "the id must be a whole number");
  expectSwcFault("1 1 1e12 0 0 1 -1\n", "vasa convert --unit");
  expectSwcFault("1 1 0 0 0 0 -1\n2 3 0 1 0 0 1\n", "a.swc:1: no sample of the file has a radius above 0");
  CHECK(readSwc("/nowhere/a.swc").error().fault == Fault::io);
}

TEST_CASE("SWC written is read back the same, byte for byte") {
  const auto samples =
      parseSwc("7 1 0.1 -0.2 0.3 0.77 -1\n9 3 1.23456 10 0 2 7\n8 3 0 20 1e-3 2 9\n", "a.swc", kMillimetres);
  REQUIRE(samples.ok());
  const std::string text = encodeSwc(*samples, kMillimetres);
  const auto again = parseSwc(text, "b.swc", kMillimetres);
  REQUIRE(again.ok());
  for (std::size_t i = 0; i < samples->size(); ++i) {
    CHECK((*again)[i].position == (*samples)[i].position);
    CHECK((*again)[i].radius == (*samples)[i].radius);
    CHECK((*again)[i].parent == (*samples)[i].parent);
  }
  CHECK(encodeSwc(*again, kMillimetres) == text);
}

TEST_CASE("a network of lines with a loop becomes a forest of all its samples") {
  Centrelines lines;
  lines.lines.push_back(
      {"a", {}, VesselKind::artery, {{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 2, 0, 1}, {0, 3, 0, 1}}});
  lines.lines.push_back(
      {"b", {}, VesselKind::artery, {{0, 1, 0, 1}, {1, 1, 0, 1}, {1, 2, 0, 1}, {0, 2, 0, 1}}});
  lines.joints = {{Centrelines::Place{0, 1}, {{1, false}}}, {Centrelines::Place{0, 2}, {{1, true}}}};
  const auto samples = swcOfCentrelines(lines);
  CHECK(samples.size() == 7);  // six places, and the loop's end once more
  const auto read = parseSwc(encodeSwc(samples), "loop.swc");
  REQUIRE(read.ok());
  CHECK(read->size() == 7);
}

TEST_CASE("kinds of vessels go through SWC's types; others' types tell nothing") {
  Centrelines lines;
  for (const VesselKind kind : {VesselKind::artery, VesselKind::vein, VesselKind::portalVein,
                                VesselKind::lymphatic, VesselKind::other}) {
    const float x = 10 * float(kind);
    lines.lines.push_back({"a", {}, kind, {{x, 0, 0, 1}, {x, 5, 0, 1}, {x, 9, 0, 1}}});
  }
  const std::string text = encodeSwc(swcOfCentrelines(lines));
  CHECK(text.find("\n4 11 10 0 0 1 -1\n") != std::string::npos);
  const Centrelines read = centrelinesOfSwc(*parseSwc(text, "f"), "f", VesselKind::vein);
  REQUIRE(read.lines.size() == 5);
  for (std::size_t i = 0; i < 4; ++i) CHECK(read.lines[i].kind == VesselKind(i));
  CHECK(read.lines[4].kind == VesselKind::vein);
  for (const int type : {-1, 0, 1, 2, 3, 4, 5, 6, 9, 14, 100}) CHECK(!kindOfSwcType(type));
}

TEST_CASE("traced brain arteries: every sample is met within 1 % of its radius") {
  VASA_REQUIRE_SHARED_DATA(data);
  for (const auto& entry : std::filesystem::directory_iterator(data / "centerlines/brava")) {
    if (entry.path().extension() != ".swc") continue;
    const auto samples = readSwc(entry.path(), kMillimetres);
    REQUIRE(samples.ok());
    const Centrelines lines = centrelinesOfSwc(*samples, "brain", VesselKind::artery);
    const auto made = networkOfCentrelines(lines);
    REQUIRE(made.ok());
    CHECK(made->network.componentCount() == 1);
    // A branch's first sample is its own, besides the one it leaves.
    CHECK(lines.sampleCount() == samples->size() + lines.lines.size() - 1);
    float worst = 0, miss = 0;
    for (std::size_t i = 0; i < lines.lines.size(); ++i)
      for (std::size_t s = 0; s < lines.lines[i].samples.size(); ++s) {
        const vec4 wanted = lines.lines[i].samples[s];
        const vec4 at = evaluate(made->network.pointsOf(made->network.vessels()[i]), made->parameters[i][s]);
        worst = std::max(worst, std::abs(at.w - wanted.w) / wanted.w);
        miss = std::max(miss, glm::distance(vec3(at), vec3(wanted)) / wanted.w);
      }
    CHECK(worst < 0.01f);
    CHECK(miss < 0.06f);
    MESSAGE(entry.path().filename().string()
            << ": " << samples->size() << " samples, " << made->network.vessels().size() << " vessels, "
            << made->network.sweepCount() << " sweeps, radius within " << 100 * worst << " %");
    const auto written = swcOfCentrelines(lines);
    CHECK(written.size() == samples->size());
    const std::string text = encodeSwc(written, kMillimetres);
    const auto again = parseSwc(text, "again", kMillimetres);
    REQUIRE(again.ok());
    CHECK(encodeSwc(*again, kMillimetres) == text);
  }
}
