#pragma once
#include <array>
#include <optional>
#include <span>

#include "network/fork_patch.h"
#include "surface/fork_plan.h"

// The rings of a planned fork, and how they move out along their vessels, into the tubes behind them.
namespace vasa {

/// The trunk's two rings, then one a branch.
struct ForkRings {
  std::array<const shared::ForkRing*, ForkPatch::kMostRings> ring{};
  std::array<std::uint32_t, ForkPatch::kMostRings> vessel{};
  std::size_t count = 0;

  /// Which way a ring's vessel leaves the fork: 1 or -1, times its parameter.
  float outward(std::size_t i) const { return i == 0 ? -ring[i]->turn : ring[i]->turn; }
};
/// Good until the plan changes.
ForkRings ringsOf(const ForkPlan& plan, const shared::ForkRecord& fork);

/// A ring's place on its vessel, in [0, spans].
float forkRingParameter(const Network& network, const shared::ForkRing& ring, std::uint32_t vessel);

/// The tube that begins at a ring, and its end there and its other one.
struct TubeBehind {
  std::size_t tube = 0;
  float near = 0, far = 0;
  bool capped = false;  ///< at its far end
};
/// None where another fork takes over at the ring. O(log tubes).
std::optional<TubeBehind> tubeBehind(const ForkPlan& plan, std::uint32_t vessel, float parameter,
                                     float outward);

/// Moves a fork's rings to places at or behind them, and shortens the tubes there.
/// @param parameters  one a ring
/// @return false where a tube is too short for that, or there is none; the plan is then as it was
bool moveRings(const Network& network, ForkPlan& plan, std::size_t fork, std::span<const float> parameters);

}  // namespace vasa
