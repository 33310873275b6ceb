#pragma once
#include <span>
#include <string>
#include <string_view>

#include "body/motion.h"

namespace vasa {

/// Metres that a unit of the motion is, judged by the length of a leg: 1, 0.01, 0.0254, 0.0564 (CMU's),
/// 0.001; 0 where none of them makes a person of it. Motions are carried in any unit: this is for telling
/// only.
double metresAUnit(const Motion& motion, std::span<const std::string_view> parts);

/// How many times larger the places in a motion's frames, and its offsets, must be so that both are of one
/// person. Exporters scale skeletons and leave the roots' ways as they are, or the other way round.
struct MotionUnits {
  float places = 1;   ///< of the joints that move, as far as the hips
  float offsets = 1;  ///< where all joints move, so that the offsets make another one's legs
  bool one() const { return places == 1 && offsets == 1; }
};

/// Offsets: by the legs of the zero pose against those of the first frame. Places: by the foot that stands.
/// It goes back, beside the hips, as far as these go forward; the middle of what the frames say is taken
/// where most that tell anything agree with it. Twice as far, or half as far, is left as it is; what
/// comes near a ratio of two units is that ratio. O(joints) for each of some frames.
/// @param parts  what each joint is (body/humanoid.h)
MotionUnits motionUnits(const Motion& motion, std::span<const std::string_view> parts);

/// The same motion in one unit.
Motion inOneUnit(Motion motion, const MotionUnits& units);

/// "its root moves in another unit than its OFFSETs: the way is taken 100 times as long, ..."; empty where
/// both are in one.
std::string describeUnits(const MotionUnits& units);

}  // namespace vasa
