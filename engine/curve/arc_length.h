#pragma once
#include <span>
#include <vector>

#include "curve/bspline.h"

namespace vasa {

/// Arc length along a spline's centre line, from parameter to metres and back. 16 chords a span, each as long
/// as the Simpson rule says the curve is: true to a millionth of a span where the curve is no sharper than
/// its tube.
class ArcLength {
 public:
  /// @param points  de Boor points of one vessel; read, not kept
  explicit ArcLength(std::span<const vec4> points);

  float length() const { return at_.back(); }
  /// [m] from the start. O(1)
  float along(float parameter) const;
  /// u of a place so many metres from the start; clamped to the spline. O(log spans)
  float parameterAt(float along) const;

 private:
  std::vector<float> at_;  // [m] at every sixteenth of a span
};

}  // namespace vasa
