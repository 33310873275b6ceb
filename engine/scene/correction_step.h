#pragma once
#include <optional>
#include <vector>

#include "avoid/nearby_steps.h"
#include "network/network.h"

namespace vasa {

/// How smoothly the correction of a network moves: vessels that are moved apart from one another jump where
/// the correction changes much from a frame to the next while little around them moves.
///
/// The correction of a sample is its corrected place less its posed place; its step is the distance between
/// its corrections in two frames that follow one another. A step is in excess where it is longer than
/// kAllowed and than every posed step near by: that of the samples whose places, posed in the later frame,
/// differ by less than kNear along each axis. So a correction may change as fast as the body there moves.
///
/// Samples lie where `vasa export` puts those of a .vtp file: kSamplesPerSpan a span, evenly in the
/// parameter, a vessel's two ends, and on a host where each of its side branches leaves.
class CorrectionSteps {
 public:
  static constexpr float kAllowed = 0.0015f;  ///< [m]
  static constexpr float kNear = 0.05f;       ///< [m]
  static constexpr std::uint32_t kSamplesPerSpan = 2;

  /// @param network  is not kept
  explicit CorrectionSteps(const Network& network);

  struct Place {
    VesselId vessel;
    float parameter = 0;  ///< u in [0, spans]
    float step = 0;       ///< [m]
    float bound = 0;      ///< [m] that it may have
  };
  struct Steps {
    float largest = 0;           ///< [m] of all, whether in excess or not
    std::uint32_t excess = 0;    ///< samples beyond their bound
    std::optional<Place> worst;  ///< the farthest beyond its bound; none without excess
  };

  /// The steps since the frame before; nothing at the first. O(samples), 1 ms for 14,000 spans; and for each
  /// step longer than kAllowed a look at 27 cells of a grid.
  /// @param posed      de Boor points without avoidance (FrameMaker::posedPoints), as Network::points()
  /// @param corrected  with it (FrameMaker::points)
  std::optional<Steps> next(std::span<const vec4> posed, std::span<const vec4> corrected);

 private:
  struct Sample {
    VesselId vessel;
    float parameter;
    std::uint32_t firstPoint;  // of the four that shape it
    vec4 weights;
  };
  void addSamples(const Network& network, VesselId id, std::vector<float> parameters);

  std::vector<Sample> samples_;
  std::vector<vec3> lastPosed_, lastCorrection_;  // a sample each; empty before the first frame
  NearbySteps posedSteps_{kNear};
};

}  // namespace vasa
