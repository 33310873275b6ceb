#pragma once
#include "convert/source.h"
#include "support/tubes.h"

// Elements and strands that tests are made of.
namespace vasa::test {

/// A straight tube from a to b with flat or open ends.
inline TriangleMesh tubeBetween(vec3 a, vec3 b, float radius, TubeEnds ends = TubeEnds::flat,
                                int steps = 40) {
  return tube([=](float t) { return a + t * (b - a); }, [=](float) { return radius; }, steps, 16, ends);
}

inline SourceElement source(std::string name, TriangleMesh mesh, VesselKind kind = VesselKind::artery) {
  return {{name, {}, {}, std::move(mesh)}, kind, name};
}

/// Sections every `step` from a to b.
inline std::vector<vec4> sectionsBetween(vec3 a, vec3 b, float radius, float step = 0.002f) {
  const int count = std::max(1, int(std::lround(glm::distance(a, b) / step)));
  std::vector<vec4> sections;
  for (int i = 0; i <= count; ++i) sections.push_back(vec4(glm::mix(a, b, float(i) / float(count)), radius));
  return sections;
}

}  // namespace vasa::test
