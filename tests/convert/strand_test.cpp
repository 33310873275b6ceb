#include "convert/strand.h"

#include <doctest/doctest.h>

#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

namespace {

std::uint32_t addLine(StrandGraph& graph, vec3 a, vec3 b, float radius = 0.001f) {
  return graph.add({sectionsBetween(a, b, radius), 0, VesselKind::artery});
}

}  // namespace

TEST_CASE("places along a polyline") {
  const Sections line = sectionsBetween(vec3(0), vec3(0, 0.01f, 0), 0.001f);
  const Along at = nearestAlong(line, vec3(0.003f, 0.0071f, 0));
  CHECK(at.arc == doctest::Approx(0.0071f));
  CHECK(at.distance == doctest::Approx(0.003f));
  CHECK(at.section.w == doctest::Approx(0.001f));
  CHECK(lengthOf(line) == doctest::Approx(0.01f));
  CHECK(atArc(line, 0.004f).section.y == doctest::Approx(0.004f));
  CHECK(atArc(line, 9).section.y == doctest::Approx(0.01f));
  CHECK(glm::distance(outwardDirection(line, true), vec3(0, 1, 0)) < 1e-5f);
  CHECK(glm::distance(outwardDirection(line, false), vec3(0, -1, 0)) < 1e-5f);
}

TEST_CASE("an end that tapers is judged by the tube behind it") {
  Sections line = sectionsBetween(vec3(0), vec3(0, 0.02f, 0), 0.003f, 0.001f);
  line.back().w = 0.001f;
  CHECK(endRadius(line, true) == doctest::Approx(0.003f));
}

TEST_CASE("splitting a strand keeps its ends, its length and what hangs on it") {
  StrandGraph graph;
  const auto trunk = addLine(graph, vec3(0), vec3(0, 0.1f, 0));
  const auto low = addLine(graph, vec3(0, 0.02f, 0), vec3(0.03f, 0.02f, 0));
  const auto high = addLine(graph, vec3(0, 0.08f, 0), vec3(0.03f, 0.08f, 0));
  const auto next = addLine(graph, vec3(0, 0.1f, 0), vec3(0, 0.2f, 0));
  const StrandEnd lowEnd{low, false}, highEnd{high, false};
  const auto lowJoint = graph.join(trunk, vec3(0, 0.02f, 0), std::span(&lowEnd, 1));
  const auto highJoint = graph.join(trunk, vec3(0, 0.08f, 0), std::span(&highEnd, 1));
  const StrandEnd meeting[] = {{trunk, true}, {next, false}};
  const auto endJoint = graph.join(std::nullopt, vec3(0, 0.1f, 0), meeting);
  const auto cut = graph.split(trunk, 0.05f);
  const std::uint32_t second = graph.joints[highJoint].host.value();
  CHECK(graph.joints[lowJoint].host == trunk);
  CHECK(second != trunk);
  CHECK(graph.strands[second].endJoint == endJoint);
  CHECK(graph.joints[endJoint].ends[0] == StrandEnd{second, true});
  CHECK(graph.joints[cut].ends.size() == 2);
  CHECK(lengthOf(graph.strands[trunk].sections) + lengthOf(graph.strands[second].sections) ==
        doctest::Approx(0.1f));
}

TEST_CASE("a circle of hosts is broken by splitting one of them") {
  // Two strands, each hanging with its end on the other's side.
  StrandGraph graph;
  const auto a = addLine(graph, vec3(0), vec3(0, 0.1f, 0)),
             b = addLine(graph, vec3(0.03f, 0.1f, 0), vec3(0.03f, 0, 0));
  const StrandEnd endA{a, true}, endB{b, true};
  graph.join(b, vec3(0.03f, 0.05f, 0), std::span(&endA, 1));
  graph.join(a, vec3(0, 0.05f, 0), std::span(&endB, 1));
  graph.breakCircles();
  CHECK(graph.strands.size() == 3);
  int hosted = 0, ends = 0;
  for (const Joint& joint : graph.joints) hosted += joint.host.has_value(), ends += int(joint.ends.size());
  CHECK(hosted == 1);
  CHECK(ends == 4);  // one on a side; the two halves and the other end in the meeting
}

TEST_CASE("dropping a strand frees what hung on it") {
  StrandGraph graph;
  const auto trunk = addLine(graph, vec3(0), vec3(0, 0.1f, 0));
  const auto twig = addLine(graph, vec3(0, 0.02f, 0), vec3(0.03f, 0.02f, 0));
  const StrandEnd end{twig, false};
  graph.join(trunk, vec3(0, 0.02f, 0), std::span(&end, 1));
  CHECK(!graph.isFree(end));
  graph.drop(trunk);
  CHECK(graph.strands[trunk].dropped());
  CHECK(graph.isFree(end));
}

TEST_CASE("what a tube would fold at is taken out of a strand, but for what branches hang on") {
  const auto line = [](std::initializer_list<vec3> corners) {
    Sections sections;
    for (const vec3* corner = corners.begin(); corner + 1 < corners.end(); ++corner)
      for (const vec4& section : sectionsBetween(corner[0], corner[1], 0.001f, 0.0005f))
        if (sections.empty() || sections.back() != section) sections.push_back(section);
    return sections;
  };
  const auto hooked = line({vec3(0), vec3(0, 0.01f, 0), vec3(0, 0.0092f, 0), vec3(0, 0.02f, 0)});
  const auto spiked =
      line({vec3(0), vec3(0, 0.01f, 0), vec3(0.0018f, 0.01f, 0), vec3(0, 0.0101f, 0), vec3(0, 0.02f, 0)});
  const auto looped =
      line({vec3(0), vec3(0, 0.01f, 0), vec3(0.005f, 0.01f, 0), vec3(0, 0.0101f, 0), vec3(0, 0.02f, 0)});
  const auto bent = line({vec3(0), vec3(0, 0.01f, 0), vec3(0.01f, 0.01f, 0)});
  const auto unfolded = [](const Sections& sections, bool branch, vec3 place = vec3(0)) {
    StrandGraph graph;
    const auto host = graph.add({sections, 0, VesselKind::artery});
    const StrandEnd foot{addLine(graph, place, place + vec3(0.03f, 0, 0)), false};
    if (branch) graph.join(host, place, std::span(&foot, 1));
    graph.removeFolds();
    if (branch) {  // led to the axis that is left
      const vec3 at = graph.joints[0].place;
      CHECK(nearestAlong(graph.strands[host].sections, at).distance < 1e-6f);
      CHECK(vec3(graph.strands[foot.strand].sections.front()) == at);
    }
    CHECK(graph.strands[host].sections.front() == sections.front());
    CHECK(graph.strands[host].sections.back() == sections.back());
    return graph.strands[host].sections;
  };
  CHECK(lengthOf(unfolded(hooked, false)) == doctest::Approx(0.02f));
  CHECK(lengthOf(unfolded(hooked, true, vec3(0, 0.01f, 0))) ==
        doctest::Approx(0.02f));  // hangs on what stays
  const vec3 tip(0.0018f, 0.01f, 0);
  CHECK(nearestAlong(unfolded(spiked, false), tip).distance == doctest::Approx(tip.x));
  CHECK(nearestAlong(unfolded(spiked, true, tip), tip).distance <= 0.001f);
  CHECK(lengthOf(unfolded(looped, false)) > 0.024f);  // farther out than a diameter
  CHECK(lengthOf(unfolded(bent, false)) > 0.0185f);   // its corner cut, no more
}
