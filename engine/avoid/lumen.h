#pragma once
#include <span>
#include <vector>

#include "avoid/interference.h"
#include "solids/bones.h"

namespace vasa {

/// A stretch of a vessel that gave way because there was no room.
struct NarrowPlace {
  VesselId vessel;
  std::uint32_t span = 0;
  float factor = 1;  ///< the least radius there by that at rest
  bool operator==(const NarrowPlace&) const = default;
};

/// How thin a vessel may become: a share of its radius at rest. With 0.25 an artery and a vein at a
/// scanned body's knee still met in a deep squat, and what started anew with them jumped by 35 mm.
constexpr float kLeastLumen = 0.1f;

/// Lowers what radii may be at each place, in both tubes, or where a bone leaves a tube too little room, as
/// far as the place asks for and kLeastLumen lets it. Points at nodes keep their radius unless `ringsToo`,
/// and then all that share one get the same.
/// @param places  that interfere (avoid/certificate.h)
/// @param bones   that tubes have entered
/// @param shape   the tubes in which they were found
/// @param points  the network with them
/// @param most    the largest radius a point may have, one a point
void narrow(const Network& network, const NetworkTubes& layout, std::span<const Interference::Place> places,
            std::span<const BoneContact> bones, std::span<const Bezier> shape, std::span<const vec4> points,
            bool ringsToo, std::span<float> most);

/// Spans one of whose points is thinner than in `before`, in order.
std::vector<NarrowPlace> narrowPlaces(const Network& network, std::span<const vec4> before,
                                      std::span<const vec4> points);

}  // namespace vasa
