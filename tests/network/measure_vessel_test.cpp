#include <doctest/doctest.h>

#include <cmath>

#include "curve/interpolate.h"
#include "network/measure_course.h"
#include "network/measure_fork.h"
#include "network/measure_lesion.h"
#include "network/sample_network.h"

using namespace vasa;

namespace {

template <class At>  // vec4(double share)
std::vector<vec4> drawn(int count, At at) {
  std::vector<vec4> samples;
  for (int k = 0; k <= count; ++k) samples.push_back(at(double(k) / count));
  return interpolateSamples(samples).points;
}

// 100 mm along z with a radius told by place [mm].
template <class Radius>
std::vector<ProfileStation> straightWith(Radius radius) {
  return stationsOf(drawn(200, [&](double s) { return vec4(0, 0, 0.1 * s, 1e-3 * radius(100 * s)); }),
                    2.5e-4f);
}

double dip(double from, double to, double at) {
  const double x = (2 * at - from - to) / (to - from);
  return std::abs(x) < 1 ? std::pow(1 - x * x, 3) : 0;
}

}  // namespace

TEST_CASE("stations lie at equal distances with the lumen's radius and area") {
  const auto stations = straightWith([](double) { return 2.0; });
  CHECK(stations.size() == 401);
  CHECK(stations[100].along == doctest::Approx(0.025));
  CHECK(stations[100].centre.z == doctest::Approx(0.025).epsilon(1e-3));
  CHECK(stations[100].tangent.z == doctest::Approx(1));
  CHECK(stations[400].area() == doctest::Approx(3.14159 * 4e-6).epsilon(1e-4));
  CHECK(stations[400].curvature == doctest::Approx(0));
}

TEST_CASE("a stenosis by hand: NASCET against the distal lumen, ECST against what would be there, area") {
  // From 4 mm it thins to 3 mm; in its middle it is narrowed to 1 mm.
  const auto stenosis =
      worstStenosis(straightWith([](double z) { return 4 - z / 100 - 2.5 * dip(40, 60, z); }));
  REQUIRE(stenosis);
  CHECK(stenosis->along == doctest::Approx(0.05).epsilon(0.01));
  CHECK(stenosis->radius == doctest::Approx(0.001).epsilon(0.01));
  CHECK(stenosis->proximal == doctest::Approx(0.04).epsilon(0.05));
  CHECK(stenosis->distal == doctest::Approx(0.06).epsilon(0.05));
  CHECK(stenosis->nascet() == doctest::Approx(1 - 1 / 3.4).epsilon(0.01));
  CHECK(stenosis->ecst() == doctest::Approx(1 - 1 / 3.5).epsilon(0.01));
  CHECK(stenosis->area() == doctest::Approx(1 - 1 / (3.5 * 3.5)).epsilon(0.01));
}

TEST_CASE("a long narrowing, and the worse of two") {
  const auto stenosis = worstStenosis(straightWith([](double z) {
    return z > 20 && z < 80 ? 1.5
           : z <= 20        ? 3 - 1.5 * std::max(0.0, (z - 15) / 5)
                            : 1.5 + 1.5 * std::min(1.0, (z - 80) / 5);
  }));
  REQUIRE(stenosis);
  CHECK(stenosis->ecst() == doctest::Approx(0.5).epsilon(0.03));
  const auto worse =
      worstStenosis(straightWith([](double z) { return 3 - 1 * dip(20, 30, z) - 2 * dip(60, 75, z); }));
  REQUIRE(worse);
  CHECK(worse->along == doctest::Approx(0.0675).epsilon(0.01));
}

TEST_CASE("healthy vessels have neither stenosis nor aneurysm: even, thinning, or widening ones") {
  for (const double slope : {0.0, -0.015, 0.015}) {
    const auto stations = straightWith([&](double z) { return 3 + slope * z; });
    const auto stenosis = worstStenosis(stations);
    CHECK((!stenosis || stenosis->nascet() < 0.01f));
    const auto aneurysm = widestAneurysm(stations);
    CHECK((!aneurysm || aneurysm->ratio() < 1.01f));
  }
}

TEST_CASE(
    "an aneurysm by hand: its diameter, its ratio, diameter over length; a stenosis beside it is its own") {
  const auto stations = straightWith([](double z) { return 8 + 12 * dip(30, 70, z) - 4 * dip(80, 95, z); });
  const auto aneurysm = widestAneurysm(stations);
  REQUIRE(aneurysm);
  CHECK(aneurysm->diameter() == doctest::Approx(0.04).epsilon(0.005));
  CHECK(aneurysm->ratio() == doctest::Approx(2.5).epsilon(0.02));
  CHECK(aneurysm->length() == doctest::Approx(0.04).epsilon(0.1));
  CHECK(aneurysm->saccularIndex() == doctest::Approx(1).epsilon(0.1));
  const auto stenosis = worstStenosis(stations);
  REQUIRE(stenosis);
  CHECK(stenosis->ecst() == doctest::Approx(0.5).epsilon(0.03));
  // The necks of an aneurysm are no stenoses.
  const auto neck = worstStenosis(straightWith([](double z) { return 7.4 - z / 100 + 20 * dip(20, 80, z); }));
  CHECK((!neck || neck->ecst() < 0.05f));
}

TEST_CASE("the course of a half circle: arc over chord, least bend radius, no inflection") {
  const auto course = measureCourse(drawn(60, [](double s) {
    return vec4(0.02 * std::cos(3.14159265 * s), 0.02 * std::sin(3.14159265 * s), 0, 0.004);
  }));
  CHECK(course.arc == doctest::Approx(0.02 * 3.14159265).epsilon(1e-3));
  CHECK(course.chord == doctest::Approx(0.04));
  CHECK(course.tortuosity == doctest::Approx(3.14159265 / 2).epsilon(1e-3));
  CHECK(course.inflections == 0);
  CHECK(course.inflectionMetric == doctest::Approx(course.tortuosity));
  CHECK(course.sumOfAngles == doctest::Approx(1 / 0.02).epsilon(0.05));
  CHECK(course.leastBendRadius == doctest::Approx(0.02).epsilon(0.05));
  CHECK(course.greatestKink == doctest::Approx(0.2).epsilon(0.05));
}

TEST_CASE(
    "a sine of two periods turns three times; a straight vessel never; a closed one has no arc over chord") {
  const auto wave = measureCourse(
      drawn(80, [](double s) { return vec4(0.01 * std::sin(4 * 3.14159265 * s), 0, 0.1 * s, 0.002); }));
  CHECK(wave.inflections == 3);
  CHECK(wave.inflectionMetric == doctest::Approx(4 * wave.tortuosity));
  const auto straight = measureCourse(drawn(5, [](double s) { return vec4(0, 0, 0.1 * s, 0.002); }));
  CHECK(straight.tortuosity == doctest::Approx(1));
  CHECK(straight.inflections == 0);
  CHECK(straight.sumOfAngles == doctest::Approx(0));
  CHECK(straight.leastBendRadius == 0);
  const auto ring = measureCourse(drawn(80, [](double s) {
    return vec4(0.02 * std::cos(6.2831853 * s), 0.02 * std::sin(6.2831853 * s), 0, 0.002);
  }));
  CHECK(ring.tortuosity == 0);
}

TEST_CASE("Murray's exponent of known forks") {
  const float half = float(std::pow(0.5, 1 / 3.0));
  CHECK(*murrayExponent(1, std::vector{half, half}) == doctest::Approx(3).epsilon(1e-3));
  CHECK(*murrayExponent(2, std::vector{1.41421356f, 1.41421356f}) == doctest::Approx(2).epsilon(1e-3));
  CHECK(*murrayExponent(5, std::vector{4.0f, 3.0f}) == doctest::Approx(2).epsilon(1e-3));
  CHECK(!murrayExponent(1, std::vector{1.0f, 0.5f}));
  CHECK(!murrayExponent(1, std::vector{0.1f, 0.1f}));
  CHECK(!murrayExponent(1, {}));
}

TEST_CASE("forks of a small tree: a side branch leaves at its angle, arms of a Y at theirs") {
  const auto network = test::sampleBuilder().build(1.75f);
  REQUIRE(network.ok());
  const auto forks = measureForks(*network, network->points());
  REQUIRE(forks.size() == 2);
  for (const ForkMeasures& fork : forks) {
    CHECK(fork.trunk == VesselId{0});
    CHECK(fork.arms.size() == 2);
    CHECK(fork.trunkRadius > 0);
  }
  CHECK(forks[0].arms[0].host != forks[1].arms[0].host);
}
