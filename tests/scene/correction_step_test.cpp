#include "scene/correction_step.h"

#include <doctest/doctest.h>

#include <random>

#include "network/builder.h"
#include "support/networks.h"

using namespace vasa;

namespace {

// Two straight vessels of 3 mm along x, one at the origin, the other beside it in y.
struct Pair {
  explicit Pair(float apart) {
    NetworkBuilder builder;
    for (const float y : {0.0f, apart}) {
      std::vector<vec4> points;
      for (int k = 0; k < 4; ++k) points.emplace_back(0.001f * float(k), y, 0, 0.001f);
      builder.addVessel({y > 0 ? "other" : "first", "", VesselKind::artery}, std::move(points));
    }
    network = *builder.build(1.0f);
  }
  std::vector<vec4> with(std::uint32_t vessel, vec3 by) const {
    std::vector<vec4> points(network.points().begin(), network.points().end());
    for (vec4& p : Network::pointsOf(network.vessels()[vessel], std::span(points))) p += vec4(by, 0);
    return points;
  }
  std::vector<vec4> rest() const { return with(0, vec3(0)); }

  Network network;
};

constexpr vec3 k2mm(0, 0, 0.002f), k3mm(0, 0, 0.003f);

// The steps when the first vessel's correction changes by 2 mm while the other is posed 3 mm from where it
// was.
CorrectionSteps::Steps besideOneThatMoves(float apart) {
  const Pair pair(apart);
  CorrectionSteps steps(pair.network);
  REQUIRE(!steps.next(pair.rest(), pair.rest()));
  const std::vector<vec4> posed = pair.with(1, k3mm);
  std::vector<vec4> corrected = pair.with(0, k2mm);
  for (std::size_t p = 4; p < 8; ++p) corrected[p] = posed[p];
  return *steps.next(posed, corrected);
}

}  // namespace

TEST_CASE("the first frame has no steps, and what stays has none") {
  const Pair pair(0.1f);
  CorrectionSteps steps(pair.network);
  CHECK(!steps.next(pair.rest(), pair.with(0, k3mm)));
  const auto second = steps.next(pair.rest(), pair.with(0, k3mm));
  REQUIRE(second);
  CHECK(second->largest == 0);
  CHECK(second->excess == 0);
  CHECK(!second->worst);
}

TEST_CASE("a correction that steps 2 mm where nothing moves is in excess, one of 1.4 mm is not") {
  const Pair pair(0.1f);
  CorrectionSteps steps(pair.network);
  steps.next(pair.rest(), pair.rest());
  const auto second = steps.next(pair.rest(), pair.with(1, k2mm));
  REQUIRE(second);
  CHECK(second->largest == doctest::Approx(0.002f));
  CHECK(second->excess == 3);  // one span: its two ends and its middle
  REQUIRE(second->worst);
  CHECK(second->worst->vessel == VesselId{1});
  CHECK(second->worst->step == doctest::Approx(0.002f));
  CHECK(second->worst->bound == CorrectionSteps::kAllowed);
  const auto third = steps.next(pair.rest(), pair.with(1, vec3(0, 0, 0.0006f)));
  CHECK(third->largest == doctest::Approx(0.0014f));
  CHECK(third->excess == 0);
}

TEST_CASE("a correction may change as fast as a vessel within 50 mm is posed anew, and no faster") {
  CHECK(besideOneThatMoves(0.04f).excess == 0);
  CHECK(besideOneThatMoves(0.06f).excess == 3);
  CHECK(besideOneThatMoves(0.04f).largest == doctest::Approx(0.002f));
}

TEST_CASE("a vessel that moves along with its body keeps its correction") {
  const Pair pair(0.1f);
  CorrectionSteps steps(pair.network);
  steps.next(pair.rest(), pair.with(0, k2mm));
  const auto second = steps.next(pair.with(0, k3mm), pair.with(0, k2mm + k3mm));
  CHECK(second->largest < 1e-7f);
}

TEST_CASE("steps are those of a search through all samples") {
  const Network network = test::windingNetwork(40, 7);
  std::mt19937 engine(3);
  const auto within = [&](float most) { return most * (2 * float(engine() >> 8) / float(1 << 24) - 1); };
  // Whole vessels are moved, some far, so that some have a neighbour that moves faster and some have not.
  const auto shaken = [&](std::span<const vec4> points, float most) {
    std::vector<vec4> out(points.begin(), points.end());
    for (const Vessel& vessel : network.vessels()) {
      const float reach = vessel.firstPoint % 5 == 0 ? most : 0.2f * most;
      const vec4 by(within(reach), within(reach), within(reach), 0);
      for (vec4& p : Network::pointsOf(vessel, std::span(out))) p += by;
    }
    return out;
  };
  const auto before = shaken(network.points(), 0.002f), after = shaken(before, 0.004f);
  const auto correctedBefore = shaken(before, 0.002f), correctedAfter = shaken(after, 0.005f);
  CorrectionSteps steps(network);
  steps.next(before, correctedBefore);
  const auto found = steps.next(after, correctedAfter);

  struct Sample {
    vec3 place;
    float posed, step;
  };
  std::vector<Sample> samples;
  const auto add = [&](const Vessel& vessel, float u) {
    const auto at = [&](const std::vector<vec4>& points) {
      return vec3(evaluate(Network::pointsOf(vessel, points), u));
    };
    samples.push_back({at(after), glm::distance(at(after), at(before)),
                       glm::distance(at(correctedAfter) - at(after), at(correctedBefore) - at(before))});
  };
  for (const Vessel& vessel : network.vessels())
    for (std::uint32_t i = 0; i <= 2 * vessel.spanCount(); ++i) add(vessel, 0.5f * float(i));
  for (const Node& node : network.nodes())
    if (node.host) add(network.vessel(node.host->vessel), node.host->parameter);
  std::uint32_t excess = 0, kept = 0;
  float worst = 0;
  for (const Sample& a : samples) {
    float bound = 0.0015f;
    for (const Sample& b : samples)
      if (glm::all(glm::lessThan(glm::abs(a.place - b.place), vec3(0.05f)))) bound = std::max(bound, b.posed);
    if (a.step > bound)
      ++excess, worst = std::max(worst, a.step - bound);
    else
      kept += a.step > 0.0015f;
  }
  REQUIRE(excess > 10);
  REQUIRE(kept > 10);
  CHECK(found->excess == excess);
  CHECK(found->worst->step - found->worst->bound == doctest::Approx(worst).epsilon(1e-3));
}
