// Inside a triangle: the R2 sequence, whose steps are the powers of 1/g for g³ = g + 1 (Roberts 2018), folded
// onto the triangle along its diagonal.
#include "mesh/surface_samples.h"

#include <cmath>

namespace vasa {

std::vector<vec3> sampleSurface(const TriangleMesh& mesh, std::size_t count) {
  std::vector<vec3> samples;
  const double total = mesh.area();
  if (!(total > 0) || count == 0) return samples;
  samples.reserve(count);
  constexpr double kG = 1.32471795724474602596;
  const double step = total / double(count);
  double reached = 0;
  for (const uvec3& t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    reached += 0.5 * glm::length(glm::cross(dvec3(b) - dvec3(a), dvec3(c) - dvec3(a)));
    while (samples.size() < count && (double(samples.size()) + 0.5) * step <= reached) {
      const double n = double(samples.size()) + 1;
      double u = std::fmod(n / kG, 1.0), v = std::fmod(n / (kG * kG), 1.0);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      samples.push_back(a + float(u) * (b - a) + float(v) * (c - a));
    }
  }
  return samples;
}

}  // namespace vasa
