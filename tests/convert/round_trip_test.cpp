#include <doctest/doctest.h>

#include <map>
#include <string>

#include "convert/convert.h"
#include "convert/sources.h"
#include "curve/arc_length.h"
#include "network/builder.h"
#include "support/frames.h"
#include "surface/surface_mesh.h"

using namespace vasa;

namespace {

// Each vessel's part of the drawn surface, as `vasa export` writes it.
std::vector<SourceElement> partsOf(const Network& network) {
  const SurfaceMesh mesh = surfaceMesh(network, network.points(), test::framesOf(network), {8, 3});
  std::vector<SourceElement> parts;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    TriangleMesh own;
    std::map<std::uint32_t, std::uint32_t> numberOf;
    for (const uvec3& t : mesh.triangles) {
      if (mesh.vesselOfVertex[t.x] != v) continue;
      uvec3 triangle;
      for (int k = 0; k < 3; ++k) {
        const auto [at, isNew] = numberOf.try_emplace(t[k], std::uint32_t(own.positions.size()));
        if (isNew) own.positions.push_back(mesh.positions[t[k]]);
        triangle[k] = at->second;
      }
      own.triangles.push_back(triangle);
    }
    parts.push_back(test::source(network.vessels()[v].name, std::move(own)));
  }
  return parts;
}

std::vector<vec4> line(vec3 a, vec3 b, float radius) {
  std::vector<vec4> points;
  for (int k = 0; k <= 10; ++k) points.emplace_back(glm::mix(a, b, float(k) / 10), radius);
  return points;
}

double lengthOf(const Network& network, std::uint32_t vessel) {
  return ArcLength(network.pointsOf(network.vessels()[vessel])).length();
}

}  // namespace

TEST_CASE("three vessels that meet come back from their drawn surface in one place, each as long as it was") {
  NetworkBuilder builder;
  const auto add = [&](const char* name, vec3 a, vec3 b, float radius) {
    return builder.addVessel({name, "", VesselKind::artery}, line(a, b, radius));
  };
  const vec3 fork(0, 0.1f, 0);
  const VesselId trunk = add("trunk", vec3(0), fork, 0.003f);
  const VesselId left = add("left", fork, {0.03f, 0.19f, 0}, 0.0026f);
  const VesselId right = add("right", fork, {-0.06f, 0.17f, 0}, 0.002f);
  builder.joinEnds({{trunk, true}, {left, false}, {right, false}});
  auto network = builder.build(1.7f);
  REQUIRE(network);
  const auto back = convertElements(partsOf(*network));
  REQUIRE(back);
  REQUIRE(back->network.vessels().size() == 3);
  CHECK(back->report.summary.components == 1);
  const Node* meeting = nullptr;
  for (const Node& node : back->network.nodes())
    if (!node.host && node.endCount == 3) meeting = &node;
  CHECK(meeting != nullptr);
  for (std::uint32_t v = 0; v < 3; ++v) {
    CHECK(back->network.vessels()[v].name == network->vessels()[v].name);
    const double length = lengthOf(*network, v), now = lengthOf(back->network, v);
    CAPTURE(network->vessels()[v].name);
    CHECK(now == doctest::Approx(length).epsilon(0.02));
  }
}
