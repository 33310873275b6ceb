#pragma once
#include <cstdint>
#include <vector>

#include "math/types.h"
#include "shared/sweep.h"

namespace vasa {

/// How finely each sweep is cut: quads around (m, 3..16) and along (n, 2..20).
struct SweepShape {
  std::uint32_t around = 8, along = 5;

  bool valid() const {
    return around >= shared::kMinAround && around <= shared::kMaxAround && along >= shared::kMinAlong &&
           along <= shared::kMaxAlong;
  }
  std::uint32_t sweepVertices() const { return (along + 1) * around; }
  std::uint32_t sweepTriangles() const { return 2 * along * around; }
  std::uint32_t capVertices() const { return shared::kCapRings * around + 1; }
  std::uint32_t capTriangles() const { return (2 * shared::kCapRings - 1) * around; }
};

/// (cos θ, sin θ) of the m directions around a section, θ = 2πk/m: (1, 0) turned by the second direction
/// again and again, in single precision (off by less than 2e-6), so that shaders, which have no exact cosine,
/// find the same numbers from that one.
/// @param around  at least 3
std::vector<vec2> ringDirections(std::uint32_t around);

/// (cos φ, sin φ) of a cap's rings, rim (1, 0) first, and of its pole (0, 1) last: kCapRings + 1 of them.
std::vector<vec2> capAngles();

/// Triangles of one sweep's m×n template, counter-clockwise seen from outside. Vertex i·m + k is direction k
/// of ring i.
std::vector<uvec3> sweepTriangles(const SweepShape& shape);

/// Triangles of one cap; vertex j·m + k is direction k of cap ring j, the last vertex is the pole. The
/// winding is that of a vessel's last section; of a first one's cap the ring is run through backwards
/// (capDirection), so that one template serves both.
std::vector<uvec3> capTriangles(const SweepShape& shape);

/// The ring direction that stands at place k of a cap.
inline std::uint32_t capDirection(std::uint32_t k, std::uint32_t around, bool last) {
  return last ? k : (around - k) % around;
}

}  // namespace vasa
