#include "network/join_lines.h"

#include <doctest/doctest.h>

using namespace vasa;

namespace {

Centrelines::Line trace(const char* name, std::vector<vec4> samples, VesselKind kind = VesselKind::artery) {
  return {name, {}, kind, std::move(samples)};
}

std::vector<vec4> straight(vec3 from, vec3 to, float radius, int count) {
  std::vector<vec4> samples;
  for (int i = 0; i <= count; ++i)
    samples.push_back(vec4(glm::mix(from, to, float(i) / float(count)), radius));
  return samples;
}

}  // namespace

TEST_CASE("traces that start in another's tube join it where they touch, at a sample or between two") {
  Centrelines lines;
  lines.lines.push_back(trace("trunk", straight({0, 0, 0}, {0, 10, 0}, 1, 4)));
  lines.lines.push_back(trace("at a sample", straight({0, 5, 0}, {6, 5, 0}, 0.3f, 6)));
  lines.lines.push_back(trace("from the wall", straight({0.9f, 3, 0}, {6, 3, 0}, 0.3f, 6)));
  lines.lines.push_back(trace("on the branch", straight({4, 5, 0.1f}, {4, 5, 5}, 0.1f, 6)));
  lines.lines.push_back(trace("elsewhere", straight({30, 3, 0}, {36, 3, 0}, 0.3f, 6)));
  lines.lines.push_back(
      trace("a vein through it", straight({0.2f, 7, 0}, {6, 7, 0}, 0.3f, 6), VesselKind::vein));
  lines.lines.push_back(trace("goes on", straight({0.1f, 10.2f, 0}, {0, 14, 0}, 0.9f, 4)));
  CHECK(joinTouchingLines(lines) == 4);
  const auto made = networkOfCentrelines(lines);
  if (!made.ok()) FAIL(made.error().message);
  CHECK(made->network.componentCount() == 3);
  for (const auto& joint : lines.joints)
    for (const auto& end : joint.ends) {
      const auto& samples = lines.lines[end.line].samples;
      const vec3 at(end.last ? samples.back() : samples.front());
      if (joint.host)
        CHECK(glm::distance(at, vec3(lines.lines[joint.host->line].samples[joint.host->sample])) < 0.11f);
    }
  CHECK(joinTouchingLines(lines) == 0);
}

TEST_CASE("lines in a triangle, each beginning on the next one's side: the last beginning stays free") {
  Centrelines lines;
  const vec3 corners[] = {{0, 0, 0}, {10, 0, 0}, {5, 8, 0}};
  for (int k = 0; k < 3; ++k) {
    const vec3 from = corners[k], to = corners[(k + 1) % 3];
    const vec3 beyond = to + 0.5f * (to - from);  // so that the next one begins on its side
    lines.lines.push_back(trace("side", straight(from, beyond, 0.5f, 9)));
  }
  CHECK(joinTouchingLines(lines) == 2);
  const auto made = networkOfCentrelines(lines);
  if (!made.ok()) FAIL(made.error().message);
  CHECK(made->network.componentCount() == 1);
}

TEST_CASE("a trace of no known kind joins arteries or veins, but leads from none of these to the others") {
  const auto partsWith = [](VesselKind second) {
    Centrelines lines;
    lines.lines.push_back(trace("artery", straight({0, 0, 0}, {0, 10, 0}, 1, 4)));
    lines.lines.push_back(trace("untold", straight({0, 5, 0}, {6, 5, 0}, 0.3f, 6), VesselKind::other));
    lines.lines.push_back(trace("second", straight({6, 0, 0}, {6, 10, 0}, 1, 4), second));
    joinTouchingLines(lines);
    const auto made = networkOfCentrelines(lines);
    if (!made.ok()) FAIL(made.error().message);
    return made->network.componentCount();
  };
  CHECK(partsWith(VesselKind::artery) == 1);
  CHECK(partsWith(VesselKind::vein) == 2);
}
