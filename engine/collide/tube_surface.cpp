#include "collide/tube_surface.h"

#include <cassert>
#include <cmath>

#include "curve/frame.h"

namespace vasa {

TubeSurface::TubeSurface(std::uint32_t around, std::uint32_t along) : around_(around), along_(along) {
  assert(around >= 3 && along >= 1);
  for (std::uint32_t ring = 0; ring < along; ++ring)
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = ring * around + k, b = ring * around + (k + 1) % around;
      triangles_.push_back({a, b, b + around});
      triangles_.push_back({a, b + around, a + around});
    }
}

void TubeSurface::shape(std::span<const Bezier> tubes, std::vector<vec3>& positions) const {
  std::vector<vec2> directions;
  for (std::uint32_t k = 0; k < around_; ++k) {
    const float angle = 2 * kPi * float(k) / float(around_);
    directions.emplace_back(std::cos(angle), std::sin(angle));
  }
  std::vector<vec3> centres(along_ + 1), tangents(along_ + 1);
  std::vector<float> radii(along_ + 1);
  std::vector<Frame> frames(along_ + 1);
  positions.resize(tubes.size() * verticesPerTube());
  vec3* out = positions.data();
  for (const Bezier& tube : tubes) {
    for (std::uint32_t ring = 0; ring <= along_; ++ring) {
      const float t = float(ring) / float(along_);
      const vec4 centre = tube.at(t);
      const vec3 derivative(tube.derivative(t)), chord(tube.b[3] - tube.b[0]);
      const float length = glm::length(derivative), across = glm::length(chord);
      centres[ring] = vec3(centre);
      radii[ring] = centre.w;
      tangents[ring] = length > 0 ? derivative / length : across > 0 ? chord / across : vec3(0, 0, 1);
    }
    minimisingFrames(centres, tangents, anyPerpendicular(tangents.front()), frames);
    for (std::uint32_t ring = 0; ring <= along_; ++ring)
      for (const vec2& d : directions)
        *out++ = centres[ring] + radii[ring] * (d.x * frames[ring].u + d.y * frames[ring].v);
  }
}

}  // namespace vasa
