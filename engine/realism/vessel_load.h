#pragma once
#include <span>
#include <vector>

#include "avoid/solver.h"
#include "network/network.h"

namespace vasa {

/// What a pose does to a vessel.
enum class LoadKind : std::uint8_t { kink, squeeze, stretch, shortening, bone };

std::string_view loadName(LoadKind kind);
std::string_view loadUnit(LoadKind kind);

/// From where on a load is told as a finding.
struct LoadLimits {
  float kink = 1;        ///< radius by bending radius: the inside of the bend folds
  float lumen = 0.5f;    ///< least area by that at rest
  float strain = 0.4f;   ///< change of the vessel's length by that at rest
  float depth = 0.001f;  ///< [m] in a bone, by more than at rest
};

/// One vessel in one pose. Places are shares of its parameter, as in the landmark NAME@share.
struct VesselLoad {
  float kink = 0,
        kinkPlace = 0;              ///< largest r κ where the pose bends more than rest
  float lumen = 1, lumenPlace = 0;  ///< least area by that at rest
  float strain = 0;                 ///< length by that at rest, less 1
  float depth = 0, depthPlace = 0;  ///< [m] in a bone or the heart, by more than at rest

  /// In the unit of the kind; the strain is a stretch where it is positive, else a shortening.
  float value(LoadKind kind) const;
  float place(LoadKind kind) const;
  /// 0: nothing of this kind; 1: at its limit; in between and beyond in proportion.
  float severity(LoadKind kind, const LoadLimits& limits) const;
};

/// Measures what poses do to all vessels of a network.
class LoadMeter {
 public:
  /// @param network  at rest; must outlive this
  explicit LoadMeter(const Network& network);

  /// @param points   as Network::points(), in the pose
  /// @param avoider  of the same frame: what is in bones
  /// O(spans)
  std::vector<VesselLoad> run(std::span<const vec4> points, const Avoider& avoider) const;

 private:
  const Network* network_;
  std::vector<float> lengths_;  // [m] at rest, one a vessel
  std::vector<float> bends_;    // r κ at rest, one a span
};

}  // namespace vasa
