#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "body/motion_rest.h"

namespace vasa {

/// How a person stands in a pose of a motion, as far as its joints tell.
class RestStance {
 public:
  /// @param parts  what each joint is (body/humanoid.h); must outlive this
  explicit RestStance(std::span<const std::string_view> parts);

  std::uint32_t hips() const { return hips_; }
  /// Where a leg ends as far as it is known: the ankle, which may be an End Site of the shin, or a joint
  /// above.
  std::optional<vec3> legEnd(const MotionPose& pose, const std::string& side) const;
  /// From the feet, or what is known of the legs, to the top of the trunk; zero where nothing tells.
  vec3 up(const MotionPose& pose) const;
  /// The lower of both feet along an axis, or of what is known of the legs.
  float lowFoot(const MotionPose& pose, vec3 axis) const;
  /// The foot on which a person stands, as their own legs are stretched: seen from the hips.
  struct StandingFoot {
    int side = -1;  ///< of kBothSides
    vec3 fromHips{0};
  };
  StandingFoot standingFoot(const MotionPose& pose) const;
  /// The ways of the hips, and of the foot as seen from them, between two poses; nothing where a person does
  /// not stand on one foot all the time. Of a foot that stays where it is they are opposite.
  struct StandingStep {
    vec3 hips, foot;
  };
  std::optional<StandingStep> standingStep(const MotionPose& before, const MotionPose& after) const;
  /// Cosines of the trunk with an axis and of each bone of the legs with its opposite.
  struct Uprightness {
    float trunk = 0, worstLeg = 1, sum = 0;
  };
  Uprightness uprightness(const MotionPose& pose, vec3 axis = {0, 1, 0}) const;
  bool stands(const MotionPose& pose, vec3 axis) const;
  /// Of the longer one, thigh and shin; 0 where none is known.
  float legLength(const MotionPose& pose) const;

 private:
  std::uint32_t of(std::string_view part) const;

  std::span<const std::string_view> parts_;
  std::uint32_t hips_, top_;
};

inline constexpr const char* kBothSides[] = {"left", "right"};

}  // namespace vasa
