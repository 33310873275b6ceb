#include "convert/convert.h"

#include <doctest/doctest.h>

#include "convert/sources.h"
#include "core/cancellation.h"
#include "core/parallel.h"
#include "network/file.h"
#include "network/reshape.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// A trunk, a branch on it, a continuation, a copy of the branch, a vein beside, and an empty element.
std::vector<SourceElement> smallBody() {
  return {source("aorta", tubeBetween({0, 0, 0}, {0, 0.2f, 0}, 0.008f)),
          source("left renal artery", tubeBetween({0.007f, 0.1f, 0}, {0.08f, 0.11f, 0}, 0.003f)),
          source("left renal artery, copy", tubeBetween({0.007f, 0.1f, 0}, {0.08f, 0.11f, 0}, 0.003f)),
          source("arch", tubeBetween({0, 0.2f, 0}, {0.02f, 0.26f, 0}, 0.008f)),
          source("vena cava", tubeBetween({-0.03f, 0, 0}, {-0.03f, 0.2f, 0}, 0.009f), VesselKind::vein),
          source("empty", {})};
}

}  // namespace

TEST_CASE("a closed ring is a network, standing or lying flat") {
  for (const vec3 across : {vec3(0, 1, 0), vec3(0, 0, 1)}) {
    const auto ring = [=](float t) {
      return 0.012f * std::cos(2 * kPi * t) * vec3(1, 0, 0) + 0.009f * std::sin(2 * kPi * t) * across;
    };
    const std::vector<SourceElement> elements{
        source("circle of Willis", tube(
                                       ring, [](float) { return 0.0013f; }, 64, 12, TubeEnds::open))};
    const auto conversion = convertElements(elements);
    if (!conversion.ok()) FAIL(conversion.error().message);
    CHECK(conversion->network.componentCount() == 1);
    CHECK(conversion->report.summary.coverage > 0.98f);
  }
}

TEST_CASE("what covers little since it was moved aside says so") {
  const std::vector<SourceElement> elements{source("artery", tubeBetween({0, 0, 0}, {0, 0.2f, 0}, 0.004f))};
  ConvertOptions options;
  for (const float aside : {0.0f, 0.006f}) {
    options.mend = [&](const Network& network) {
      std::vector<vec4> points(network.points().begin(), network.points().end());
      points.back().x += aside;
      return reshapeNetwork(network, points, network.bodyHeight());
    };
    const auto conversion = convertElements(elements, options);
    if (!conversion.ok()) FAIL(conversion.error().message);
    const ElementReport& report = conversion->report.elements.front();
    CHECK(report.status == (aside > 0 ? ElementStatus::partial : ElementStatus::ok));
    CHECK((report.reason.find("moved aside by up to 6.0 mm") != std::string::npos) == (aside > 0));
  }
}

TEST_CASE("elements become one network with forks, told element by element") {
  const auto conversion = convertElements(smallBody());
  REQUIRE(conversion.ok());
  const Network& network = conversion->network;
  const ConvertSummary& s = conversion->report.summary;
  CHECK(network.vessels().size() == 4);
  CHECK(network.componentCount() == 2);
  CHECK(network.junctionCount() == 1);
  CHECK(network.bodyHeight() == doctest::Approx(0.26f).epsilon(0.05));
  CHECK(s.elements == 6);
  CHECK(s.ok == 5);
  CHECK(s.failed == 1);
  CHECK(s.duplicates == 1);
  CHECK(s.joins.endToSide == 1);
  CHECK(s.joins.endToEnd == 1);
  CHECK(s.coverage > 0.95);
  CHECK(s.error.p95 < 0.001f);
  CHECK(s.largestArterialTree == doctest::Approx(s.arteryLength));
  const auto& elements = conversion->report.elements;
  CHECK(elements[2].duplicate);
  CHECK(elements[2].reason == "repeats 'left renal artery'");
  CHECK(elements[2].sweeps == 0);
  CHECK(elements[5].status == ElementStatus::failed);
  CHECK(!elements[5].reason.empty());
}

TEST_CASE("the network is the same for any number of threads") {
  std::vector<std::byte> first;
  for (const unsigned threads : {1u, 2u, 5u}) {
    setThreadCount(threads);
    const auto conversion = convertElements(smallBody());
    REQUIRE(conversion.ok());
    const auto bytes = encodeNetwork(conversion->network);
    if (first.empty()) first = bytes;
    CHECK(bytes == first);
  }
  setThreadCount(0);
}

TEST_CASE("several vessels of one element are numbered, the longest first") {
  TriangleMesh two = tubeBetween({0, 0, 0}, {0, 0.1f, 0}, 0.003f);
  append(two, tubeBetween({0.1f, 0, 0}, {0.1f, 0.2f, 0}, 0.003f));
  const std::vector<SourceElement> elements{source("digital arteries", two)};
  const auto conversion = convertElements(elements);
  REQUIRE(conversion.ok());
  REQUIRE(conversion->network.vessels().size() == 2);
  CHECK(conversion->network.vessels()[0].name == "digital arteries");
  CHECK(conversion->network.vessels()[1].name == "digital arteries (2)");
  CHECK(lengthOf(conversion->network.pointsOf(conversion->network.vessels()[0])) > 0.18f);
}

TEST_CASE("input without a vessel is refused with a remedy, a stop is obeyed") {
  const auto nothing = convertElements(std::vector<SourceElement>{source("speck", {})});
  REQUIRE(!nothing.ok());
  CHECK(nothing.error().fault == Fault::badInput);
  CHECK(nothing.error().message.find("give surfaces of tubes") != std::string::npos);
  Cancellation wish;
  wish.ask();
  const CancellationScope scope(wish);
  CHECK_THROWS_AS((void)convertElements(smallBody()), Cancelled);
}

TEST_CASE("a flat sheet is doubtful, whichever way its triangles are turned") {
  TriangleMesh sheet;
  for (int i = 0; i < 12; ++i)
    for (const float z : {0.0f, 0.004f}) sheet.positions.emplace_back(0.004f * float(i), 1.2f, z);
  for (std::uint32_t i = 0; i + 2 < sheet.positions.size(); ++i)
    sheet.triangles.emplace_back(i, i + 1, i + 2);  // a strip: every second one the other way round
  const auto made = convertElements(std::vector<SourceElement>{source("sheet", sheet)});
  REQUIRE(made.ok());
  CHECK(made->report.elements[0].status == ElementStatus::doubtful);
  CHECK(made->report.elements[0].reason.find("flat") != std::string::npos);
}

TEST_CASE("what is too wide for any vessel is doubtful, with what may be the matter") {
  // A vessel in millimetres that is read as metres, beside one that is right.
  std::vector<SourceElement> elements{source("aorta", tubeBetween({0, 0, 0}, {0, 0.3f, 0}, 0.012f)),
                                      source("torso", tubeBetween({1, 0, 0}, {1, 0.9f, 0}, 0.15f))};
  const auto made = convertElements(elements);
  REQUIRE(made.ok());
  CHECK(made->report.elements[0].status == ElementStatus::ok);
  CHECK(made->report.elements[1].status == ElementStatus::doubtful);
  CHECK(statusName(made->report.elements[1].status) == "doubtful");
  CHECK(made->report.elements[1].reason.find("--unit") != std::string::npos);
  CHECK(made->report.summary.ok == 1);
  CHECK(made->report.summary.doubtful == 1);
}

TEST_CASE("what is thinner than surfaces are followed at is doubtful, as its radii are raised") {
  std::vector<SourceElement> elements{source("arteriole", tubeBetween({0, 0, 0}, {0, 2e-3f, 0}, 3e-5f)),
                                      source("artery", tubeBetween({1, 0, 0}, {1, 4e-3f, 0}, 7e-5f))};
  const auto made = convertElements(elements);
  REQUIRE(made.ok());
  CHECK(made->report.elements[0].status == ElementStatus::doubtful);
  CHECK(made->report.elements[0].reason.find("50 um") != std::string::npos);
  CHECK(made->report.elements[1].status == ElementStatus::ok);
}
