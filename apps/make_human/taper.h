#pragma once
#include <span>

namespace vasa::human {

/// Lets a vessel that nothing goes on from thin out over its last stretch, the longer the wider it is, down
/// to where capillaries take over (0.25 mm; what is thinner already stays).
///
///   std::vector<float> radii{0.8e-3f, 0.7e-3f, 0.6e-3f};
///   thinOut(radii, 0.05f, 0.05f);  // the last one is 0.25 mm
///
/// @param radii  [m] at equal steps along it
/// @param length  [m] of the whole vessel
/// @param most  [m] of the stretch, as where branches leave that must not be wider than their stem
void thinOut(std::span<float> radii, float length, float most);

}  // namespace vasa::human
