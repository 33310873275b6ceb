#pragma once
#include <functional>

#include "avoid/solver.h"

namespace vasa::test {

/// A network and its joints as a body poses them.
struct Posed {
  std::vector<vec4> points;
  std::vector<quat> rotations;  ///< one a point
  std::vector<mat4> joints = {};

  operator PosedVessels() const { return {points, rotations, joints}; }
};

/// The network in its rest pose, with a point's surroundings and joints unturned.
Posed atRest(const Network& network, std::size_t joints = 0);

/// Another pose with these points, unturned.
Posed unturned(std::vector<vec4> points, std::vector<mat4> joints = {});

/// Straight from one pose to another, joints too; surroundings turn along the shorter arc.
Posed between(const Posed& from, const Posed& to, float share);

/// Pairs of vessels that have changed sides since rest (avoid/sides.h), by a look of its own.
std::size_t changedSides(const Network& network, const Posed& posed, std::span<const vec4> points);

/// Goes through poses as FrameMaker does, in steps that are cut in halves where the solver asks for it.
class Walker {
 public:
  static constexpr float kStep = 0.001f;  ///< [m] that a step moves a point at most
  static constexpr float kStepSeconds = 1 / 30.0f;

  /// @param volume  or null; all must outlive this
  Walker(Avoider& avoider, const Posed& rest, const VolumeKeeper* volume = nullptr);

  /// Along a way, whose share in [0, 1] gives a pose; its beginning is where this stands. All of its steps
  /// are reported to `seen`. @return the report of the last step
  AvoidReport along(const std::function<Posed(float)>& way, unsigned steps, float seconds);
  /// Straight to a pose in steps of kStep.
  AvoidReport to(const Posed& target);
  /// Stays where it is for some steps.
  AvoidReport stay(unsigned steps, float seconds = kStepSeconds);
  /// One step, however long.
  AvoidReport jump(const Posed& target, float seconds = kStepSeconds);

  const Posed& posed() const { return posed_; }
  const std::vector<vec4>& points() const { return points_; }
  /// [m] how far each point is from its posed place.
  const std::vector<vec3>& corrections() const { return corrections_; }
  /// [m] by how much the last step changed the correction that it changed most.
  float correctionStep() const { return correctionStep_; }

  std::function<void(const AvoidReport&)> seen = [](const AvoidReport&) {};

 private:
  void arrive(const Posed& posed, const AvoidReport& report);

  Avoider* avoider_;
  const VolumeKeeper* volume_;
  Posed posed_;
  std::vector<vec4> points_;
  std::vector<vec3> corrections_;
  float correctionStep_ = 0;
};

struct Solved {
  PosedLook before;  ///< of the pose without any correction
  AvoidReport report;
  std::vector<vec4> points;
};

/// From rest straight to a pose.
Solved solve(Avoider& avoider, const Posed& rest, const Posed& pose);

/// Where a way ends, and the largest step of a correction on it.
struct Way {
  std::vector<vec4> end;
  float largest = 0;
};
/// Walker::along() in a second.
Way wayOf(Walker& walker, const std::function<Posed(float)>& way, unsigned steps);
/// Shorter steps lead to about the same place, and change corrections the less: a way made in 30, 120 and
/// 480.
/// @param apart  [m] between the ends, at most  @param share  of the largest step with a fourth as many, at
/// most
void checkShorterSteps(const std::function<Way(unsigned)>& made, float apart, float share);

/// Control points evenly along a line.
std::vector<vec4> line(vec3 from, vec3 to, float radius, std::uint32_t count);

}  // namespace vasa::test
