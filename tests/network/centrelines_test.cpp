#include <doctest/doctest.h>

#include "network/centrelines.h"

using namespace vasa;

namespace {

// A trunk along y with a branch that leaves it at its third sample.
Centrelines forkedLines() {
  Centrelines lines;
  lines.lines.resize(2);
  lines.lines[0] = {"trunk", "FMA1", VesselKind::artery, {}};
  for (int i = 0; i < 6; ++i)
    lines.lines[0].samples.push_back(vec4(0, 0.01f * float(i), 0.001f * float(i * i), 0.003f));
  lines.lines[1] = {"branch", {}, VesselKind::artery, {}};
  for (int i = 0; i < 4; ++i)
    lines.lines[1].samples.push_back(
        vec4(vec3(lines.lines[0].samples[2]) + 0.01f * float(i) * vec3(1, 0.2f, 0), 0.001f));
  lines.joints = {{Centrelines::Place{0, 2}, {{1, false}}}};
  return lines;
}

}  // namespace

TEST_CASE("centre lines become vessels that pass through their samples and meet where the lines do") {
  const Centrelines lines = forkedLines();
  const auto made = networkOfCentrelines(lines);
  REQUIRE(made.ok());
  const Network& network = made->network;
  REQUIRE(network.vessels().size() == 2);
  CHECK(network.vessels()[0].name == "trunk");
  CHECK(network.vessels()[0].ontologyId == "FMA1");
  CHECK(network.junctionCount() == 1);
  CHECK(network.bodyHeight() == doctest::Approx(0.056f));
  // What lies across is as large as what stands.
  Centrelines lying = lines;
  for (auto& line : lying.lines)
    for (vec4& s : line.samples) std::swap(s.x, s.y);
  const auto across = networkOfCentrelines(lying);
  REQUIRE(across.ok());
  CHECK(across->network.bodyHeight() == doctest::Approx(0.056f));
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t s = 0; s < lines.lines[i].samples.size(); ++s) {
      const vec4 at = evaluate(network.pointsOf(network.vessels()[i]), made->parameters[i][s]),
                 wanted = lines.lines[i].samples[s];
      CHECK(std::abs(at.w - wanted.w) <= 0.006f * wanted.w);
      CHECK(glm::distance(vec3(at), vec3(wanted)) <= 0.06f * wanted.w);
    }
}

TEST_CASE("a network's centre lines have a sample where a branch leaves, and give the same network again") {
  const auto made = networkOfCentrelines(forkedLines());
  REQUIRE(made.ok());
  const Centrelines again = centrelinesOfNetwork(made->network, made->network.points(), 3);
  REQUIRE(again.lines.size() == 2);
  REQUIRE(again.joints.size() == 1);
  REQUIRE(again.joints[0].host.has_value());
  const auto& place = *again.joints[0].host;
  CHECK(glm::distance(vec3(again.lines[0].samples[place.sample]), vec3(again.lines[1].samples.front())) <
        1e-6f);
  const auto second = networkOfCentrelines(again);
  REQUIRE(second.ok());
  CHECK(second->network.junctionCount() == 1);
}

TEST_CASE("no lines are refused") {
  const auto made = networkOfCentrelines({});
  REQUIRE(!made.ok());
  CHECK(made.error().fault == Fault::badInput);
}
