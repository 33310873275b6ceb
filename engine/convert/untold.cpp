#include "convert/untold.h"

#include <algorithm>

namespace vasa {
namespace {

constexpr float kBeside = 3;  // radii from a section's centre within which vertices are of its own wall

}  // namespace

void dropUntold(std::vector<vec4>& sections, const TriangleMesh& mesh, const TriangleTree& tree) {
  const std::size_t n = sections.size();
  std::vector<bool> told(n, false);
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == 0 || i + 1 == n) {
      told[i] = true;
      continue;
    }
    const vec3 centre(sections[i]), before(sections[i - 1]), after(sections[i + 1]);
    const float length = glm::distance(before, after), radius = sections[i].w;
    if (!(length > 0)) continue;
    const vec3 along = (after - before) / length;
    triangles.clear();
    tree.nearPlane(centre, along, kBeside * radius, triangles);
    // As far as halfway to the next sections.
    const float back = -0.5f * glm::dot(centre - before, along),
                ahead = 0.5f * glm::dot(after - centre, along);
    told[i] = std::ranges::any_of(triangles, [&](std::uint32_t t) {
      for (int k = 0; k < 3; ++k) {
        const vec3 way = mesh.positions[mesh.triangles[t][k]] - centre;
        const float at = glm::dot(way, along);
        if (at >= back && at <= ahead && glm::dot(way, way) < kBeside * kBeside * radius * radius)
          return true;
      }
      return false;
    });
  }
  std::vector<vec4> kept;
  for (std::size_t i = 0; i < n;) {
    if (told[i]) {
      kept.push_back(sections[i++]);
      continue;
    }
    std::size_t end = i;
    while (!told[end]) ++end;
    const float run = glm::distance(vec3(sections[i - 1]), vec3(sections[end]));
    if (run < kUntoldRadii * sections[i].w)
      kept.insert(kept.end(), sections.begin() + std::ptrdiff_t(i), sections.begin() + std::ptrdiff_t(end));
    i = end;
  }
  sections = std::move(kept);
}

}  // namespace vasa
