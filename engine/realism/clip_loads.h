#pragma once
#include "realism/vessel_load.h"

namespace vasa {

/// A vessel that a motion bends, strains or lengthens beyond a limit, in its worst frame.
struct VesselBeyond {
  VesselId vessel;
  float value = 0;          ///< of a kink radius by bending radius, else a change of length by the length
  float place = 0;          ///< of a kink, as VesselLoad::kinkPlace
  std::uint32_t frame = 0;  ///< the worst
};

/// Which vessels a motion bends to a kink, makes longer or shorter than at rest, or lengthens or shortens
/// fast. Lengths of vessels up to 5 mm are not looked at, nor bends as sharp as at rest
/// (realism/vessel_load.h).
///
///   ClipLoads loads(network);
///   for (std::uint32_t frame = 0; frame < count; ++frame) {
///     maker.make(&clip, clip.timeOfFrame(frame));
///     loads.look(frame, maker.points(), *maker.avoider());
///   }
///   for (const VesselBeyond& vessel : loads.kinked()) ...
class ClipLoads {
 public:
  /// Of a vessel's length, from one frame to the next, whatever the rate: what looks like a jerk at 30 a
  /// second.
  static constexpr float kFast = 0.05f;

  /// @param network  at rest; must outlive this
  explicit ClipLoads(const Network& network, const LoadLimits& limits = {});

  /// One frame after the other. @param points  as Network::points() @param avoider  of the same frame
  /// O(spans)
  void look(std::uint32_t frame, std::span<const vec4> points, const Avoider& avoider);

  /// Those beyond LoadLimits::kink, LoadLimits::strain and kFast, in the order of vessels.
  std::vector<VesselBeyond> kinked() const { return beyond(kinks_, limits_.kink); }
  std::vector<VesselBeyond> strained() const { return beyond(strains_, limits_.strain); }
  std::vector<VesselBeyond> fast() const { return beyond(steps_, kFast); }

 private:
  static std::vector<VesselBeyond> beyond(std::span<const VesselBeyond> worst, float limit);

  LoadMeter meter_;
  LoadLimits limits_;
  std::vector<VesselBeyond> kinks_, strains_, steps_;  // the worst of each vessel
  std::vector<float> lengths_;                         // by those at rest, in the frame before
};

}  // namespace vasa
