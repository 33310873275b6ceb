#include "avoid/solver.h"

#include <doctest/doctest.h>

#include <random>

#include "core/hash.h"
#include "core/parallel.h"
#include "support/networks.h"
#include "support/walk.h"

using namespace vasa;

namespace {

Network separateVessels(const std::vector<std::vector<vec4>>& vessels) {
  NetworkBuilder builder;
  for (std::size_t v = 0; v < vessels.size(); ++v)
    builder.addVessel({"vessel " + std::to_string(v), "", VesselKind::artery}, vessels[v]);
  return test::built(builder);
}

// From rest straight to a pose.
test::Solved solve(Avoider& avoider, const Network& network, const std::vector<vec4>& points) {
  return test::solve(avoider, test::atRest(network), test::unturned(points));
}

// 64 vessels along z in a jittered square, and a pose that squeezes it.
Network bundle() {
  std::mt19937 random(5);
  const auto jitter = [&] { return 0.001f * float(random() % 1000) / 1000; };
  std::vector<std::vector<vec4>> vessels;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y) {
      const vec3 foot(0.01f * float(x) + jitter(), 0.01f * float(y) + jitter(), 0);
      vessels.push_back(test::line(foot, foot + vec3(jitter(), jitter(), 0.3f), 0.003f, 16));
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
  return separateVessels({test::line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.004f, 12),
                          test::line({0, height, -0.1f}, {0, height, 0.1f}, 0.004f, 12)});
}

std::vector<vec4> lowered(const Network& network, float by) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (std::uint32_t p = network.vessels()[1].firstPoint; p < points.size(); ++p) points[p].y -= by;
  return points;
}

// Two vessels that come together while all turns around, so that corrections turn along.
struct Turning {
  Network network = crossing(0.012f);
  VolumeKeeper volume{network};

  test::Posed at(float share) const {
    test::Posed posed = test::unturned(lowered(network, 0.016f * share));
    const quat turn = glm::angleAxis(share, glm::normalize(vec3(1, 2, -1)));
    for (vec4& p : posed.points) p = vec4(turn * vec3(p), p.w);
    std::ranges::fill(posed.rotations, turn);
    return posed;
  }
};

// How far the second vessel's middle is above the first one's.
float heightAbove(const Network& network, std::span<const vec4> points) {
  return evaluate(Network::pointsOf(network.vessels()[1], points), 4.5f).y -
         evaluate(Network::pointsOf(network.vessels()[0], points), 4.5f).y;
}

}  // namespace

TEST_CASE("what does not interfere is not touched") {
  const Network network = crossing(0.02f);
  Avoider avoider(network);
  const std::vector<vec4> posed = lowered(network, 0.005f);
  const test::Solved solved = solve(avoider, network, posed);
  CHECK(solved.points == posed);
  CHECK(solved.report.after.holds());
  CHECK(solved.report.movedMax == 0);
}

TEST_CASE("two crossing vessels are pushed apart by the same amount") {
  const Network network = crossing(0.012f);
  Avoider avoider(network);
  const auto posed = lowered(network, 0.008f);  // centre lines 4 mm apart, radii 8 mm
  const test::Solved solved = solve(avoider, network, posed);
  CHECK(solved.before.vessels.contacts > 0);
  CHECK(std::abs(solved.before.vessels.depth - 0.004f) < 1e-5f);
  CHECK(solved.report.after.holds());
  CHECK(solved.report.narrowSpans == 0);
  const std::uint32_t second = network.vessels()[1].firstPoint;
  for (std::uint32_t k = 0; k < second; ++k)
    CHECK(std::abs((posed[k].y - solved.points[k].y) - (solved.points[second + k].y - posed[second + k].y)) <
          5e-5f);
  CHECK(std::abs(heightAbove(network, solved.points) - 0.00816f) < 5e-5f);
}

TEST_CASE("a vessel that is swept across another never passes through it") {
  // Near one another at rest or not, at right angles or nearly along one another, and beyond one another in
  // the end.
  for (const float angle : {0.3f, 0.8f, kPi / 2})
    for (const float height : {0.012f, 0.08f}) {
      CAPTURE(angle);
      CAPTURE(height);
      const vec3 along(std::cos(angle), 0, std::sin(angle)), up(0, height, 0);
      const Network network = separateVessels({test::line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.004f, 12),
                                               test::line(up - 0.1f * along, up + 0.1f * along, 0.004f, 12)});
      Avoider avoider(network);
      test::Walker walker(avoider, test::atRest(network));
      walker.seen = [&](const AvoidReport& report) {
        CHECK(report.after.holds());
        CHECK(report.narrowSpans == 0);
        CHECK(heightAbove(network, walker.points()) > 0.0079f);
        CHECK(test::changedSides(network, walker.posed(), walker.points()) == 0);
      };
      for (const float beyond : {0.0f, 0.003f, 0.008f, 0.012f, 0.03f}) {
        CAPTURE(beyond);
        walker.to(test::unturned(lowered(network, height + beyond)));
      }
      // Back again, and nothing is left of it.
      walker.to(test::atRest(network));
      CHECK(walker.stay(360).movedMax < 1e-6f);
    }
}

TEST_CASE("a vessel whose end leaves another comes back on the side on which it was") {
  // It crosses over another vessel, and ends shortly beyond. Drawn back, it is lowered, and then pushed
  // forward again to where it would cross beneath.
  const Network network =
      separateVessels({test::line({0, 0, -0.1f}, {0, 0, 0.1f}, 0.002f, 20),
                       test::line({-0.2f, 0.0045f, 0}, {0.006f, 0.0045f, 0}, 0.002f, 20)});
  const auto posed = [&](float back, float down) {
    test::Posed pose = test::atRest(network);
    for (std::uint32_t p = network.vessels()[1].firstPoint; p < pose.points.size(); ++p)
      pose.points[p] -= vec4(back, down, 0, 0);
    return pose;
  };
  Avoider avoider(network);
  test::Walker walker(avoider, test::atRest(network));
  walker.seen = [&](const AvoidReport& report) {
    CHECK(report.after.holds());
    CHECK(report.narrowSpans == 0);
    CHECK(test::changedSides(network, walker.posed(), walker.points()) == 0);
  };
  walker.to(posed(0.012f, 0));
  walker.to(posed(0.012f, 0.007f));
  walker.to(posed(0, 0.007f));
  walker.to(test::atRest(network));
  CHECK(walker.stay(360).movedMax < 1e-6f);
}

TEST_CASE("crossing vessels that lie on the other side than at rest stay there, and apart") {
  const Network network = separateVessels({test::line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.001f, 12),
                                           test::line({0, 0.003f, -0.1f}, {0, 0.003f, 0.1f}, 0.001f, 12)});
  Avoider avoider(network);
  const test::Posed below = test::unturned(lowered(network, 0.024f));
  std::vector<vec4> points(network.points().size());
  avoider.start({}, below, nullptr, points);
  for (int step = 0; step < 40; ++step) {
    const auto report = avoider.step(below, nullptr, {1 / 30.0f, true, true}, points);
    REQUIRE(report);
    CHECK(report->after.holds());
    CHECK(report->movedMax == 0);
  }
}

TEST_CASE("a vessel that is swept across a bundle passes none of its vessels") {
  // All stay in their order along the sweep's way where they cross it.
  std::vector<std::vector<vec4>> vessels;
  for (int k = 0; k < 4; ++k) {
    const float y = -0.01f * float(k);
    vessels.push_back(test::line({-0.1f, y, 0}, {0.1f, y, 0}, 0.003f, 12));
  }
  vessels.push_back(test::line({0, 0.012f, -0.1f}, {0, 0.012f, 0.1f}, 0.004f, 12));
  const Network network = separateVessels(vessels);
  const auto swept = [&](float by) {
    test::Posed posed = test::atRest(network);
    for (std::uint32_t p = network.vessels()[4].firstPoint; p < posed.points.size(); ++p)
      posed.points[p].y -= by;
    return posed;
  };
  Avoider avoider(network);
  test::Walker walker(avoider, test::atRest(network));
  walker.seen = [&](const AvoidReport& report) {
    CHECK(report.after.holds());
    CHECK(test::changedSides(network, walker.posed(), walker.points()) == 0);
    for (std::size_t v = 0; v < 4; ++v) {
      const auto middle = [&](std::size_t of) {
        return evaluate(Network::pointsOf(network.vessels()[of], walker.points()), 4.5f).y;
      };
      CHECK((v == 0 ? middle(4) : middle(v - 1)) > middle(v) + 0.0058f);
    }
  };
  walker.to(swept(0.06f));
}

TEST_CASE("a correction that nothing asks for fades, slowly, to nothing") {
  const Network network = crossing(0.012f);
  for (const float perSecond : {30.0f, 120.0f}) {
    CAPTURE(perSecond);
    Avoider avoider(network);
    test::Walker walker(avoider, test::atRest(network));
    const float most = walker.to(test::unturned(lowered(network, 0.022f))).movedMax;
    CHECK(most > 0.008f);
    walker.seen = [&](const AvoidReport& report) {
      CHECK(report.after.holds());
      CHECK(walker.correctionStep() <= most / perSecond * 1.001f);
    };
    walker.jump(test::unturned(lowered(network, -0.2f)), 1 / perSecond);  // the other one is gone
    const AvoidReport later = walker.stay(unsigned(perSecond) - 1, 1 / perSecond);
    CHECK(later.movedMax < 0.39f * most);
    CHECK(later.movedMax > 0.35f * most);
    CHECK(walker.stay(unsigned(11 * perSecond), 1 / perSecond).movedMax == 0);
  }
}

TEST_CASE("thin vessels that hold one another aside are not let into one another first") {
  const Network network = separateVessels({test::line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.0005f, 24),
                                           test::line({0, 0.003f, -0.1f}, {0, 0.003f, 0.1f}, 0.0005f, 24)});
  Avoider avoider(network);
  test::Walker walker(avoider, test::atRest(network));
  const test::Posed held = test::unturned(lowered(network, 0.012f));
  CHECK(walker.to(held).movedMax > 0.004f);
  std::vector<vec4> points(network.points().size());
  for (int step = 0; step < 30; ++step) {
    const auto report = avoider.step(held, nullptr, {1 / 30.0f, false, true}, points);
    REQUIRE(report);  // where the side is a guess, a step is refused
    CHECK(report->after.holds());
  }
}

TEST_CASE("shorter steps lead to about the same place, and change corrections the less") {
  // Down onto another vessel and along it, so that it is pushed, held and let go.
  const Network network = crossing(0.012f);
  const auto swept = [&](float share) {
    test::Posed posed = test::unturned(lowered(network, 0.018f * std::sin(0.75f * kPi * share)));
    for (std::uint32_t p = network.vessels()[1].firstPoint; p < posed.points.size(); ++p)
      posed.points[p].x += 0.02f * share;
    return posed;
  };
  const auto go = [&](unsigned steps) {
    Avoider avoider(network);
    test::Walker walker(avoider, test::atRest(network));
    walker.seen = [&](const AvoidReport& report) { CHECK(report.after.holds()); };
    return test::wayOf(walker, swept, steps);
  };
  test::checkShorterSteps(go, 0.05f * 0.004f, 0.33f);
}

TEST_CASE("what overlaps at rest stays admissible") {
  const Network network = crossing(0.005f);
  Avoider avoider(network);
  CHECK(avoider.restPairCount() > 0);
  const std::vector<vec4> rest(network.points().begin(), network.points().end());
  test::Solved solved = solve(avoider, network, rest);
  CHECK(solved.report.after.holds());
  CHECK(solved.report.after.restContacts == avoider.restPairCount());
  CHECK(solved.points == rest);
  solved = solve(avoider, network, lowered(network, 0.003f));  // deeper than at rest is not admissible
  CHECK(solved.before.vessels.contacts > 0);
  CHECK(solved.report.after.holds());
}

TEST_CASE("a squeezed bundle finds room") {
  const Network network = bundle();
  Avoider avoider(network);
  const test::Solved solved = solve(avoider, network, squeezed(network, 0.5f));
  CHECK(solved.before.vessels.contacts > 100);
  MESSAGE(solved.before.vessels.contacts << " contacts, " << solved.report.rounds << " rounds, "
                                         << solved.report.constraints << " constraints, "
                                         << solved.report.narrowSpans << " narrow spans");
  CHECK(solved.report.after.holds());
}

TEST_CASE("a fork stays joined when its vessels are pushed") {
  NetworkBuilder builder;
  const auto hostPoints = test::line({-0.1f, 0, 0}, {0.1f, 0, 0}, 0.004f, 14);
  const VesselId host = builder.addVessel({"host", "", VesselKind::artery}, hostPoints);
  const vec3 root(evaluate(hostPoints, 5.3f));
  const VesselId side = builder.addVessel({"side", "", VesselKind::artery},
                                          test::line(root, root + vec3(0, 0, 0.1f), 0.003f, 10));
  const VesselId left = builder.addVessel({"left", "", VesselKind::artery},
                                          test::line({0.1f, 0, 0}, {0.15f, 0, 0.05f}, 0.003f, 9));
  const VesselId right = builder.addVessel({"right", "", VesselKind::artery},
                                           test::line({0.1f, 0, 0}, {0.15f, 0, -0.05f}, 0.003f, 9));
  builder.addVessel({"bar", "", VesselKind::vein},
                    test::line({-0.12f, 0.02f, 0.006f}, {0.2f, 0.02f, 0.006f}, 0.004f, 20));
  const NodeId sideNode = builder.joinToSide({side, false}, {host, 5.3f});
  const NodeId fork = builder.joinEnds({{host, true}, {left, false}, {right, false}});
  const Network network = test::built(builder);
  std::vector<vec4> posed(network.points().begin(), network.points().end());
  for (std::uint32_t p = network.vessels()[4].firstPoint; p < posed.size(); ++p) posed[p].y -= 0.018f;
  Avoider avoider(network);
  const test::Solved solved = solve(avoider, network, posed);
  CHECK(solved.before.vessels.contacts > 0);
  CHECK(solved.report.after.holds());
  CHECK(solved.report.movedMax > 0.001f);
  const vec3 onHost(evaluate(Network::pointsOf(network.vessel(host), solved.points),
                             network.node(sideNode).host->parameter));
  CHECK(glm::distance(vec3(solved.points[network.vessel(side).firstPoint]), onHost) < 1e-6f);
  const auto ends = network.ends(network.node(fork));
  const vec3 meeting(Network::pointsOf(network.vessel(host), solved.points).back());
  CHECK(ends.size() == 3);
  for (const VesselId arm : {left, right})
    CHECK(vec3(solved.points[network.vessel(arm).firstPoint]) == meeting);
}

TEST_CASE("a pack that there is no time to part gives way, or says that it could not") {
  const Network network = bundle();
  for (const unsigned rounds : {0u, 6u}) {
    CAPTURE(rounds);
    Avoider avoider(network, nullptr, {.rounds = rounds, .sweeps = 1});
    test::Walker walker(avoider, test::atRest(network));
    const AvoidReport report = walker.jump(test::unturned(squeezed(network, 0.02f)));
    // Four tries, each looked at once more for the certificate.
    CHECK(report.rounds <= 4 * 2 * rounds);
    CHECK(report.after.holds() == (rounds > 0));
    CHECK(report.after.contacts == avoider.remaining().size());
    CHECK((report.narrowSpans > 0) == (rounds > 0));
    CHECK(report.narrowSpans == avoider.narrowed().size());
    for (const NarrowPlace& narrow : avoider.narrowed()) CHECK(narrow.factor >= kLeastLumen - 1e-6f);
    for (const vec4& p : walker.points()) CHECK((std::isfinite(p.x) && std::abs(p.x) < 1 && p.w > 0));
  }
}

TEST_CASE("where vessels are short of room their lumen gives way") {
  const Network network = crossing(0.012f);
  Avoider avoider(network, nullptr, {.sweeps = 0});                               // nothing is moved
  const test::Solved solved = solve(avoider, network, lowered(network, 0.006f));  // 6 mm for 8 mm
  CHECK(solved.report.after.holds());
  CHECK(solved.report.movedMax == 0);
  CHECK(std::abs(solved.report.leastLumen - 0.75f) < 0.05f);
  REQUIRE_FALSE(avoider.narrowed().empty());
  CHECK(avoider.narrowed().front().vessel == VesselId{0});
}

TEST_CASE("to start from a step's correction is to go on from that step, to the byte") {
  const Turning motion;
  for (const bool keepsVolume : {false, true})
    for (const unsigned steps : {40u, 5u}) {  // the long ones bring the two deep into one another
      CAPTURE(keepsVolume);
      CAPTURE(steps);
      const VolumeKeeper* const volume = keepsVolume ? &motion.volume : nullptr;
      Avoider avoider(motion.network), later(motion.network);
      std::vector<vec4> points(motion.network.points().size()), again(points);
      avoider.start({}, motion.at(0), volume, points);
      for (unsigned k = 1; k <= steps; ++k) {
        CAPTURE(k);
        const auto posed = [&](unsigned step) { return motion.at(1.3f * float(step) / float(steps)); };
        later.start(avoider.correction(), posed(k - 1), volume, again);
        CHECK(again == points);
        REQUIRE(avoider.step(posed(k), volume, {1 / 30.0f, true, true}, points));
        REQUIRE(later.step(posed(k), volume, {1 / 30.0f, true, true}, again));
        CHECK(again == points);
        CHECK(later.correction().motions == avoider.correction().motions);
        CHECK(later.correction().widest == avoider.correction().widest);
      }
    }
}

TEST_CASE("a step that is refused leaves everything as it was, and so does a look") {
  const Turning motion;
  Avoider avoider(motion.network), asked(motion.network);
  std::vector<vec4> points(motion.network.points().size()), again(points);
  avoider.start({}, motion.at(0), nullptr, points);
  asked.start({}, motion.at(0), nullptr, again);
  std::uint32_t refused = 0;
  for (int k = 1; k < 40; ++k) {
    CAPTURE(k);
    const std::vector<vec4> before = again;
    const Correction correction = asked.correction();
    const std::size_t remaining = asked.remaining().size();
    if (asked.step(motion.at(float(k) / 30 + 0.5f), nullptr, {0.5f, false, true},
                   again)) {  // 8 mm deeper at once
      asked.start(correction, motion.at(float(k - 1) / 30), nullptr, again);
    } else {
      ++refused;
      CHECK(again == before);
      CHECK(asked.remaining().size() == remaining);
      CHECK(asked.correction().motions == correction.motions);
    }
    const std::size_t left = asked.remaining().size();
    const test::Posed other = motion.at(0.7f);
    CHECK(asked.look(other, other.points).vessels.contacts > 0);
    CHECK(asked.remaining().size() == left);
    REQUIRE(avoider.step(motion.at(float(k) / 30), nullptr, {1 / 30.0f, true, true}, points));
    REQUIRE(asked.step(motion.at(float(k) / 30), nullptr, {1 / 30.0f, true, true}, again));
    CHECK(again == points);
  }
  CHECK(refused > 5);
}

TEST_CASE("a step that leaves vessels in one another is refused once solved, and told with the next one") {
  const Turning motion;
  const AvoidOptions idle{.rounds = 1, .sweeps = 0};  // finds, and moves nothing
  Avoider avoider(motion.network, nullptr, idle), asked(motion.network, nullptr, idle);
  std::vector<vec4> points(motion.network.points().size()), again(points);
  avoider.start({}, motion.at(0), nullptr, points);
  asked.start({}, motion.at(0), nullptr, again);
  std::uint32_t refused = 0;
  for (int k = 1; k < 13; ++k) {
    CAPTURE(k);
    const test::Posed next = motion.at(float(k) / 10);
    const std::vector<vec4> before = again;
    const bool isMade = asked.step(next, nullptr, {0.1f, false, false}, again).has_value();
    const auto report = avoider.step(next, nullptr, {0.1f, true, false}, points);
    REQUIRE(report);
    if (!isMade) {
      CHECK(again == before);
      const auto told = asked.step(next, nullptr, {0.1f, true, false}, again);
      REQUIRE(told);
      refused += told->rounds > report->rounds;
    }
    CHECK(again == points);
  }
  CHECK(refused > 0);
}

TEST_CASE("a motion does not depend on threads or on the motions before it") {
  const Network network = bundle();
  const std::vector<float> factors{0.6f, 0.45f, 0.8f};
  std::vector<std::uint64_t> expected;
  for (const unsigned threads : {1u, 2u, 8u}) {
    setThreadCount(threads);
    Avoider avoider(network);
    std::vector<std::uint64_t> hashes(factors.size());
    for (std::size_t k = 0; k < factors.size(); ++k) {
      const std::size_t frame = threads == 2 ? factors.size() - 1 - k : k;
      hashes[frame] =
          hashOf(std::span<const vec4>(solve(avoider, network, squeezed(network, factors[frame])).points));
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
  CHECK(certificateOf(interference.find(points)).holds());
  // One vessel is pulled onto its neighbour until they overlap by a hundredth of a millimetre.
  const Vessel &a = network.vessels()[9], &b = network.vessels()[10];
  const vec4 at = points[a.firstPoint + 8], other = points[b.firstPoint + 8];
  const vec3 between = vec3(other) - vec3(at);
  const vec3 shift = between * (1 - (at.w + other.w - 1e-5f) / glm::length(between));
  for (std::uint32_t l = 0; l < a.pointCount; ++l) points[a.firstPoint + l] += vec4(shift, 0);
  std::vector<Interference::Place> found;
  const Certificate certificate = certificateOf(interference.find(points), &found);
  CHECK_FALSE(certificate.holds());
  CHECK(certificate.depth > 0.9e-5f);
  REQUIRE_FALSE(found.empty());
  CHECK(interference.layout().address(found[0].contact.i).vessel == VesselId{9});
  CHECK(interference.layout().address(found[0].contact.j).vessel == VesselId{10});
}
