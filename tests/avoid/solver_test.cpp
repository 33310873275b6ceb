#include "avoid/solver.h"

#include <doctest/doctest.h>

#include <random>

#include "core/hash.h"
#include "core/parallel.h"
#include "network/builder.h"

using namespace vasa;

namespace {

std::vector<vec4> line(vec3 from, vec3 to, float radius, std::uint32_t count) {
  std::vector<vec4> points;
  for (std::uint32_t k = 0; k < count; ++k) points.emplace_back(glm::mix(from, to, float(k) / float(count - 1)), radius);
  return points;
}

Network built(const NetworkBuilder& builder) {
  auto network = builder.build(1);
  REQUIRE(network.ok());
  return std::move(*network);
}

Network separateVessels(const std::vector<std::vector<vec4>>& vessels) {
  NetworkBuilder builder;
  for (std::size_t v = 0; v < vessels.size(); ++v)
    builder.addVessel({"vessel " + std::to_string(v), "", VesselKind::artery}, vessels[v]);
  return built(builder);
}

struct Solved {
  AvoidReport report;
  std::vector<vec4> points;
};

Solved solve(Avoider& avoider, const Network& network, const std::vector<vec4>& posed) {
  const std::vector<quat> rotations(network.points().size(), quat(1, 0, 0, 0));
  Solved solved{{}, posed};
  solved.report = avoider.run({posed, rotations}, nullptr, solved.points);
  return solved;
}

// A hundred vessels along z in a jittered square, and a pose that squeezes it.
Network bundle() {
  std::mt19937 random(5);
  const auto jitter = [&] { return 0.001f * float(random() % 1000) / 1000; };
  std::vector<std::vector<vec4>> vessels;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y) {
      const vec3 foot(0.01f * float(x) + jitter(), 0.01f * float(y) + jitter(), 0);
      vessels.push_back(line(foot, foot + vec3(jitter(), jitter(), 0.3f), 0.003f, 16));
    }
  return separateVessels(vessels);
}

std::vector<vec4> squeezed(const Network& network, float factor) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (vec4& p : points) {
    const float share = std::exp(-std::pow((p.z - 0.15f) / 0.06f, 2.0f));
    const float scale = glm::mix(1.0f, factor, share);
    p.x = 0.035f + (p.x - 0.035f) * scale;
    p.y = 0.035f + (p.y - 0.035f) * scale;
  }
  return points;
}

// Two vessels that cross at right angles; at rest the second is `height` above the first.
Network crossing(float height) {
  return separateVessels({line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.004f, 12), line({0, height, -0.1f}, {0, height, 0.1f}, 0.004f, 12)});
}

std::vector<vec4> lowered(const Network& network, float by) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (std::uint32_t p = network.vessels()[1].firstPoint; p < points.size(); ++p) points[p].y -= by;
  return points;
}

}  // namespace

TEST_CASE("what does not interfere is not touched") {
  const Network network = crossing(0.02f);
  Avoider avoider(network);
  const std::vector<vec4> posed = lowered(network, 0.005f);
  const Solved solved = solve(avoider, network, posed);
  CHECK(solved.points == posed);
  CHECK(solved.report.after.holds());
  CHECK(solved.report.movedMax == 0);
}

TEST_CASE("two crossing vessels are pushed apart by the same amount") {
  const Network network = crossing(0.012f);
  Avoider avoider(network);
  const Solved solved = solve(avoider, network, lowered(network, 0.008f));  // centre lines 4 mm apart, radii 8 mm
  CHECK(solved.report.before.contacts > 0);
  CHECK(solved.report.before.depth == doctest::Approx(0.004f).epsilon(0.01));
  CHECK(solved.report.after.holds());
  CHECK(solved.report.narrowSpans == 0);
  const auto posed = lowered(network, 0.008f);
  const std::uint32_t second = network.vessels()[1].firstPoint;
  for (std::uint32_t k = 0; k < second; ++k)
    CHECK(posed[k].y - solved.points[k].y == doctest::Approx(solved.points[second + k].y - posed[second + k].y).epsilon(0.05));
  CHECK(evaluate(Network::pointsOf(network.vessels()[1], solved.points), 4.5f).y -
            evaluate(Network::pointsOf(network.vessels()[0], solved.points), 4.5f).y == doctest::Approx(0.00816f).epsilon(0.02));
}

TEST_CASE("a vessel that has passed through another comes back to its own side") {
  const Network network = crossing(0.012f);
  Avoider avoider(network);
  for (const float below : {0.0f, 0.001f, 0.003f, 0.006f}) {
    CAPTURE(below);
    const Solved solved = solve(avoider, network, lowered(network, 0.012f + below));
    CHECK(solved.report.before.contacts > 0);
    CHECK(solved.report.after.holds());
    CHECK(evaluate(Network::pointsOf(network.vessels()[1], solved.points), 4.5f).y >
          evaluate(Network::pointsOf(network.vessels()[0], solved.points), 4.5f).y + 0.0079f);
  }
}

TEST_CASE("what overlaps at rest stays admissible") {
  const Network network = crossing(0.005f);
  Avoider avoider(network);
  CHECK(avoider.restPairCount() > 0);
  const std::vector<vec4> rest(network.points().begin(), network.points().end());
  Solved solved = solve(avoider, network, rest);
  CHECK(solved.report.after.holds());
  CHECK(solved.report.after.restContacts == avoider.restPairCount());
  CHECK(solved.points == rest);
  solved = solve(avoider, network, lowered(network, 0.003f));  // deeper than at rest is not admissible
  CHECK(solved.report.before.contacts > 0);
  CHECK(solved.report.after.holds());
}

TEST_CASE("a squeezed bundle finds room") {
  const Network network = bundle();
  Avoider avoider(network);
  const Solved solved = solve(avoider, network, squeezed(network, 0.5f));
  CHECK(solved.report.before.contacts > 100);
  MESSAGE(solved.report.before.contacts << " contacts, " << solved.report.rounds << " rounds, "
                                        << solved.report.constraints << " constraints, " << solved.report.narrowSpans
                                        << " narrow spans");
  CHECK(solved.report.after.holds());
}

TEST_CASE("a fork stays joined when its vessels are pushed") {
  NetworkBuilder builder;
  const auto hostPoints = line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.004f, 14);
  const VesselId host = builder.addVessel({"host", "", VesselKind::artery}, hostPoints);
  const vec3 root(evaluate(hostPoints, 5.3f));
  const VesselId side = builder.addVessel({"side", "", VesselKind::artery}, line(root, root + vec3(0, 0, 0.1f), 0.003f, 10));
  const VesselId left = builder.addVessel({"left", "", VesselKind::artery}, line({0.1f, 0, 0}, {0.15f, 0, 0.05f}, 0.003f, 9));
  const VesselId right = builder.addVessel({"right", "", VesselKind::artery}, line({0.1f, 0, 0}, {0.15f, 0, -0.05f}, 0.003f, 9));
  builder.addVessel({"bar", "", VesselKind::vein}, line({-0.12f, 0.02f, 0.006f}, {0.2f, 0.02f, 0.006f}, 0.004f, 20));
  const NodeId sideNode = builder.joinToSide({side, false}, {host, 5.3f});
  const NodeId fork = builder.joinEnds({{host, true}, {left, false}, {right, false}});
  const Network network = built(builder);
  std::vector<vec4> posed(network.points().begin(), network.points().end());
  for (std::uint32_t p = network.vessels()[4].firstPoint; p < posed.size(); ++p) posed[p].y -= 0.018f;
  Avoider avoider(network);
  const Solved solved = solve(avoider, network, posed);
  CHECK(solved.report.before.contacts > 0);
  CHECK(solved.report.after.holds());
  CHECK(solved.report.movedMax > 0.001f);
  const vec3 onHost(evaluate(Network::pointsOf(network.vessel(host), solved.points), network.node(sideNode).host->parameter));
  CHECK(glm::distance(vec3(solved.points[network.vessel(side).firstPoint]), onHost) < 1e-6f);
  const auto ends = network.ends(network.node(fork));
  const vec3 meeting(Network::pointsOf(network.vessel(host), solved.points).back());
  CHECK(ends.size() == 3);
  for (const VesselId arm : {left, right}) CHECK(vec3(solved.points[network.vessel(arm).firstPoint]) == meeting);
}

TEST_CASE("a pack that cannot be parted ends within its budget and says so") {
  const Network network = bundle();
  AvoidOptions options{.rounds = 1, .sweeps = 1, .lumenRounds = 0};
  for (const unsigned lumenRounds : {0u, 6u}) {
    CAPTURE(lumenRounds);
    options.lumenRounds = lumenRounds;
    Avoider avoider(network, nullptr, options);
    const Solved solved = solve(avoider, network, squeezed(network, 0.02f));
    CHECK(solved.report.rounds <= 9 * options.rounds);
    CHECK_FALSE(solved.report.after.holds());
    CHECK(solved.report.after.contacts == avoider.remaining().size());
    CHECK(solved.report.after.depth > 0);
    CHECK((solved.report.narrowSpans > 0) == (lumenRounds > 0));
    CHECK(solved.report.narrowSpans == avoider.narrowed().size());
    for (const NarrowPlace& narrow : avoider.narrowed()) CHECK(narrow.factor >= kLeastLumen - 1e-6f);
    for (const vec4& p : solved.points) CHECK((std::isfinite(p.x) && std::abs(p.x) < 1 && p.w > 0));
  }
}

TEST_CASE("where vessels are short of room their lumen gives way") {
  const Network network = crossing(0.012f);
  Avoider avoider(network, nullptr, {.rounds = 0});
  const Solved solved = solve(avoider, network, lowered(network, 0.006f));  // 6 mm for 8 mm
  CHECK(solved.report.after.holds());
  CHECK(solved.report.movedMax == 0);
  CHECK(solved.report.leastLumen == doctest::Approx(0.75).epsilon(0.03));
  REQUIRE_FALSE(avoider.narrowed().empty());
  CHECK(avoider.narrowed().front().vessel == VesselId{0});
}

TEST_CASE("a frame does not depend on threads or on the frames before it") {
  const Network network = bundle();
  const std::vector<float> factors{0.6f, 0.45f, 0.8f};
  std::vector<std::uint64_t> expected;
  for (const unsigned threads : {1u, 2u, 8u}) {
    setThreadCount(threads);
    Avoider avoider(network);
    std::vector<std::uint64_t> hashes(factors.size());
    for (std::size_t k = 0; k < factors.size(); ++k) {
      const std::size_t frame = threads == 2 ? factors.size() - 1 - k : k;
      hashes[frame] = hashOf(std::span<const vec4>(solve(avoider, network, squeezed(network, factors[frame])).points));
    }
    if (expected.empty()) expected = hashes;
    CHECK(hashes == expected);
  }
  setThreadCount(0);
}

TEST_CASE("the certificate sees a planted contact") {
  const Network network = bundle();
  Interference interference(network);
  std::vector<vec4> points(network.points().begin(), network.points().end());
  CHECK(certify(interference, points).holds());
  // One vessel is pulled onto its neighbour until they overlap by a hundredth of a millimetre.
  const Vessel &a = network.vessels()[9], &b = network.vessels()[10];
  const vec4 at = points[a.firstPoint + 8], other = points[b.firstPoint + 8];
  const vec3 between = vec3(other) - vec3(at);
  const vec3 shift = between * (1 - (at.w + other.w - 1e-5f) / glm::length(between));
  for (std::uint32_t l = 0; l < a.pointCount; ++l) points[a.firstPoint + l] += vec4(shift, 0);
  std::vector<Interference::Place> found;
  const Certificate certificate = certify(interference, points, &found);
  CHECK_FALSE(certificate.holds());
  CHECK(certificate.depth > 0.9e-5f);
  REQUIRE_FALSE(found.empty());
  CHECK(interference.layout().address(found[0].contact.i).vessel == VesselId{9});
  CHECK(interference.layout().address(found[0].contact.j).vessel == VesselId{10});
}
