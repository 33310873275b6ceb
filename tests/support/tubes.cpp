#include "support/tubes.h"

#include <array>
#include <cmath>
#include <map>

namespace vasa::test {

TriangleMesh isosurface(const std::function<float(vec3)>& field, vec3 low, vec3 high, float cell) {
  const int nx = int((high.x - low.x) / cell) + 1, ny = int((high.y - low.y) / cell) + 1,
            nz = int((high.z - low.z) / cell) + 1;
  const auto number = [&](int x, int y, int z) { return std::uint32_t((z * (ny + 1) + y) * (nx + 1) + x); };
  std::vector<vec3> place;
  std::vector<float> value;
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x) {
        place.push_back(low + cell * vec3(float(x), float(y), float(z)));
        value.push_back(field(place.back()));
      }
  TriangleMesh mesh;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> vertexOf;
  const auto vertex = [&](std::uint32_t a, std::uint32_t b) {
    const auto key = std::minmax({a, b});
    const auto [found, fresh] = vertexOf.emplace(key, std::uint32_t(mesh.positions.size()));
    if (fresh) {
      // Away from the ends, so that no two vertices fall together.
      const float t = glm::clamp(value[key.first] / (value[key.first] - value[key.second]), 0.05f, 0.95f);
      mesh.positions.push_back(glm::mix(place[key.first], place[key.second], t));
    }
    return found->second;
  };
  // The six tetrahedra around the cube's diagonal: one for each order of the axes.
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, vec3 inside) {
    const vec3 pa = mesh.positions[a], pb = mesh.positions[b], pc = mesh.positions[c];
    const bool outward = glm::dot(glm::cross(pb - pa, pc - pa), pa - inside) > 0;
    mesh.triangles.push_back(outward ? uvec3(a, b, c) : uvec3(a, c, b));
  };
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (const auto& order : kOrders) {
          int at[3] = {x, y, z};
          std::array<std::uint32_t, 4> corner{number(x, y, z)};
          for (std::size_t k = 0; k < 3; ++k) {
            ++at[order[k]];
            corner[k + 1] = number(at[0], at[1], at[2]);
          }
          std::vector<std::uint32_t> in, out;
          for (const std::uint32_t c : corner) (value[c] < 0 ? in : out).push_back(c);
          if (in.empty() || out.empty()) continue;
          const vec3 inside = place[in[0]];
          if (in.size() == 1)
            emit(vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2]), inside);
          if (in.size() == 3)
            emit(vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0]), inside);
          if (in.size() == 2) {
            const std::uint32_t a = vertex(in[0], out[0]), b = vertex(in[0], out[1]),
                                c = vertex(in[1], out[1]), d = vertex(in[1], out[0]);
            emit(a, b, c, 0.5f * (inside + place[in[1]]));
            emit(a, c, d, 0.5f * (inside + place[in[1]]));
          }
        }
  return mesh;
}

TriangleMesh forkedSurface() {
  struct Limb {
    vec3 a, b;
    float radius;
  };
  const Limb limbs[] = {{{0, 0, 0}, {0, 0.12f, 0}, 0.008f},
                        {{0, 0.12f, 0}, {0.045f, 0.2f, 0.01f}, 0.006f},
                        {{0, 0.12f, 0}, {-0.05f, 0.19f, 0}, 0.0055f},
                        {{0, 0.06f, 0}, {0.07f, 0.07f, 0.01f}, 0.0035f}};
  const auto field = [&](vec3 p) {
    constexpr float kSoft = 0.0008f;
    float sum = 0;
    for (const Limb& limb : limbs)
      sum += std::exp(-std::min(capsuleDistance(p, limb.a, limb.b, limb.radius), 0.05f) / kSoft);
    return -kSoft * std::log(sum);
  };
  return isosurface(field, {-0.065f, -0.02f, -0.02f}, {0.085f, 0.215f, 0.025f}, 0.0016f);
}

}  // namespace vasa::test
