#include "io/colour_runs.h"

namespace vasa {

void addColourRuns(const TriangleMesh& mesh, std::uint32_t first, std::size_t end,
                   std::span<const vec3> colours, std::size_t firstVertex, const MeshMaterial& base,
                   std::vector<MeshMaterial>& materials) {
  constexpr std::size_t kMostRuns = 64;
  const vec3 own = base.colour.value_or(vec3(1));
  const std::size_t before = materials.size();
  vec3 last(-1), sum(0);
  for (std::uint32_t t = first; t < end; ++t) {
    const vec3 colour = colours[mesh.triangles[t].x - firstVertex];
    sum += colour;
    if (colour == last || materials.size() - before > kMostRuns) continue;
    materials.push_back({base.name, own * colour, t});
    last = colour;
  }
  if (materials.size() - before <= kMostRuns) return;
  materials.resize(before);
  materials.push_back({base.name, own * sum / float(end - first), first});
}

}  // namespace vasa
