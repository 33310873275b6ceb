#pragma once
#include <vector>

#include "network/network.h"

namespace vasa {

/// What a vessel keeps while a pose changes its length.
enum class Keep : std::uint8_t {
  volume,  ///< its volume, exactly: the paper's way
  wall,    ///< arteries their volume as far as their radii change by 10 % at the most (areas of carotid
         ///< arteries in turned heads change by less, Aristokleous 2011); veins theirs as far as they do not
         ///< widen: they give way where they are drawn out and do not fill where they are shortened
  radii,
};

/// Keeps each vessel's volume as its centre line is stretched, squeezed and bent: radii inside the vessel
/// change, r_l <- r_l + λ w_l r_l, while the rings at its nodes stay as they are (w = 0), so that vessels
/// still fit where they meet. One λ a vessel, from a quadratic in closed form: exact to the quadrature (4
/// Gauss points a span). After Hyun, Yoon, Chang, Seong, Kim, Jüttler 2005, "Sweep-based human deformation"
/// (the paper's §3.2).
class VolumeKeeper {
 public:
  /// The volumes of the network at rest are the ones to keep.
  /// @param keep  wall, or else volume
  explicit VolumeKeeper(const Network& network, Keep keep = Keep::volume);

  struct Outcome {
    float largestError = 0;          ///< |V - V0| / V0 of the worst vessel whose radii could do it
    float clampedError = 0;          ///< ... of the worst that could not
    std::uint32_t clampedCount = 0;  ///< vessels whose radii would have left the sane range, or were held
    void add(const Outcome& other);
  };

  /// @param points  a posed network's points; radii must be those at rest. O(spans), parallel.
  /// @param most    if given, one a point: radii may not be larger; the rest of the vessel makes up for it
  Outcome run(std::span<vec4> points, std::span<const float> most = {}) const;

  /// What a run was given and made of it. One network's alone.
  struct Memory {
    std::vector<vec4> given;  ///< one a point
    std::vector<float> most, radii;
    std::vector<Outcome> outcomes;  ///< one a vessel
  };
  /// The same, bit for bit, where vessels that come as they came to the last such run need no computation.
  Outcome run(std::span<vec4> points, std::span<const float> most, Memory& last) const;

  /// The same for one vessel; its errors are added to an outcome.
  void keep(VesselId vessel, std::span<vec4> points, std::span<const float> most, Outcome& outcome) const;

  /// How far radii may go, by those at rest.
  struct Range {
    float lowest, highest;
  };
  static Range rangeOf(VesselKind kind, Keep keep);
  static constexpr float kLowestFactor = 0.5f, kHighestFactor = 2.0f;  ///< the widest of these ranges

 private:
  const Network* network_;
  Keep keep_;
  std::vector<double> restVolumes_;  // one a vessel
};

}  // namespace vasa
