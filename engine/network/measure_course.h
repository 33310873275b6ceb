#pragma once
#include <span>

#include "network/measure_profile.h"

namespace vasa {

/// How a vessel winds and bends.
struct CourseMeasures {
  float arc = 0, chord = 0;       ///< [m] along it, and straight from end to end
  float tortuosity = 1;           ///< arc / chord (the distance metric); 0 where the ends meet
  std::uint32_t inflections = 0;  ///< places where the bend turns to the other side
  float inflectionMetric = 1;     ///< (inflections + 1) · arc / chord
  /// [radians a metre] total angles, in the plane of the bend and out of it, over the arc
  float sumOfAngles = 0;
  float leastBendRadius = 0;  ///< [m] of the centre line's circle where it bends most; 0: it is straight
  float bendAt = 0;           ///< [m] of arc to there
  float greatestKink = 0;     ///< radius · curvature: from 1 on the wall folds over itself
};

/// Bullitt, Gerig, Pizer, Lin, Aylward 2003, IEEE Trans Med Imaging 22:1163: inflection count and sum of
/// angles metrics, on stations a sixtieth of the arc or a millimetre apart, whichever is more: what is finer
/// is not the vessel's course. O(spans)
CourseMeasures measureCourse(std::span<const vec4> points);

}  // namespace vasa
