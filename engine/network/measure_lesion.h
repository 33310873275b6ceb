#pragma once
#include <optional>
#include <span>

#include "network/measure_profile.h"

namespace vasa {

/// A place where a vessel is narrower or wider than on both sides of it. Its shoulders are where the radius
/// stops changing as one goes away from it: the farthest from its own, where every metre of way counts
/// against it by kTaper, and where no better is met within a radius farther on. Proximal is towards the
/// vessel's start. All measures are of the lumen, circles at right angles to the centre line.
struct Lesion {
  float along = 0;                             ///< [m] of arc to where it is narrowest or widest
  float radius = 0;                            ///< [m] there
  float proximalRadius = 0, distalRadius = 0;  ///< [m] at its shoulders
  float proximal = 0, distal = 0;              ///< [m] of arc to them
  /// [m] of radius that the vessel would have: between the shoulders', by the way
  float reference = 0;

  float length() const { return distal - proximal; }
};

constexpr float kTaper = 0.02f;  ///< [m of radius for a metre]: healthy vessels thin by less than 1 mm in 50

/// Stenosis::ecst() and Aneurysm::ratio() from which on people are told: less is a vessel's own taper.
constexpr double kNotableStenosis = 0.1, kNotableAneurysm = 1.2;

/// [m] > 0 between stations that no lesion is lost between: a quarter of the least radius of these de Boor
/// points, a two-hundredth of their arc, whichever is less, and a tenth of a millimetre at least.
float lesionStep(std::span<const vec4> points);

/// The narrowing that takes most of the diameter away; none where the radius has no inner minimum (a vessel
/// that is narrowest at its very end tells nothing of what it would be there).
struct Stenosis : Lesion {
  /// 1 - least diameter / healthy diameter distal of it (NASCET 1991).
  float nascet() const { return 1 - radius / distalRadius; }
  /// 1 - least diameter / what the vessel would measure there (ECST 1991).
  float ecst() const { return 1 - radius / reference; }
  /// 1 - least area / area that the vessel would have there.
  float area() const { return 1 - (radius * radius) / (reference * reference); }
};
std::optional<Stenosis> worstStenosis(std::span<const ProfileStation> stations);

/// The widening of most diameter beyond what the vessel would measure there; none where the radius has no
/// inner maximum.
struct Aneurysm : Lesion {
  float diameter() const { return 2 * radius; }  ///< [m] at right angles to the centre line
  float ratio() const { return radius / reference; }
  float saccularIndex() const { return diameter() / length(); }
};
std::optional<Aneurysm> widestAneurysm(std::span<const ProfileStation> stations);

}  // namespace vasa
