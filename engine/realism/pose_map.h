#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/joint_range.h"
#include "realism/vessel_load.h"
#include "scene/frame.h"
#include "scene/scene.h"

namespace vasa {

/// A way outwards: one joint turns from rest to an end of its range, while another may be held at an angle.
struct PoseRay {
  struct Held {
    JointRange range;
    float angle = 0;  ///< [rad]
  };
  JointRange range;
  bool high = true;  ///< to which end
  std::optional<Held> held;

  std::string name() const;  ///< "left knee flexion to 140", "left knee flexion to 140, left hip flexion 60"
};

/// All ways outwards by one joint at a time.
std::vector<PoseRay> singleRays(std::span<const JointRange> ranges);

/// All ways outwards by two: the first held at 0, step, 2 step … to both ends.
std::vector<PoseRay> pairedRays(const JointRange& held, const JointRange& turned, float step);

/// A load beyond its limit, on one way outwards.
struct PoseFinding {
  VesselId vessel;
  LoadKind kind = LoadKind::kink;
  float from = 0;      ///< [rad] the first angle at which it is beyond its limit
  float angle = 0;     ///< [rad] where it is worst
  float value = 0;     ///< there, in the unit of its kind
  float place = 0;     ///< there, a share of the vessel's parameter
  float severity = 0;  ///< there, in limits
};

/// What was seen on a way outwards.
struct RayReport {
  struct Step {
    float angle = 0;     ///< [rad]
    float severity = 0;  ///< of the worst load: 1 is at its limit
    VesselId vessel;     ///< which has it
    LoadKind kind = LoadKind::kink;
  };
  std::vector<PoseFinding> findings;  ///< the most severe first
  std::vector<Step> steps;            ///< from rest outwards
  std::vector<float> strains;         ///< one a vessel, of all steps the one farthest from 0
};

/// Which poses kink, squeeze or stretch which vessel: joints are turned through their ranges, with vessels
/// sliding and kept apart as in any motion.
///
///   PoseMap map(scene, {});
///   for (const PoseRay& ray : singleRays(ranges)) { auto report = map.walk(ray); … }
///
/// A ray is a function of the scene and itself alone, whatever was walked before.
class PoseMap {
 public:
  /// @param scene  must outlive this
  /// @param step   [rad] between poses that are looked at
  PoseMap(const Scene& scene, FrameOptions options, LoadLimits limits = {}, float step = glm::radians(10.0f));

  /// Fails with badInput where the scene's skeleton has no such joint. O(steps · solving a frame)
  Result<RayReport> walk(const PoseRay& ray);

 private:
  const Scene* scene_;
  LoadLimits limits_;
  float step_;
  FrameMaker maker_;
  LoadMeter meter_;
};

}  // namespace vasa
