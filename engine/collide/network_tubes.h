#pragma once
#include "collide/exclusions.h"
#include "network/network.h"

namespace vasa {

/// A network seen as detection sees it: a plain array of tubes, one a span, vessel after vessel, and who is
/// whose neighbour.
class NetworkTubes {
 public:
  struct Address {
    VesselId vessel;
    std::uint32_t span;
  };

  static constexpr float kReach = 2;

  /// Finds the neighbours at rest: along vessels, across nodes, and from a side branch into its host's spans.
  /// A path counts while it is shorter than `reach` times the sum of the largest radii at its two ends.
  /// Neighbours belong together and are left out of detection, as whole tubes: where a vessel folds over
  /// itself so tightly, that is a kink (network/kinks.h).
  explicit NetworkTubes(const Network& network, float reach = kReach);

  std::uint32_t count() const { return std::uint32_t(addresses_.size()); }
  Address address(std::uint32_t tube) const { return addresses_[tube]; }
  std::uint32_t tube(VesselId vessel, std::uint32_t span) const { return firstTube_[vessel.value] + span; }
  const Exclusions& neighbours() const { return neighbours_; }

  /// The tubes of the network in the given shape.
  /// @param points  as Network::points()
  /// @param tubes   count() of them, caller-owned
  void shape(std::span<const vec4> points, std::span<Bezier> tubes) const;

 private:
  struct Run {
    std::uint32_t firstPoint, spans;
  };
  std::vector<Run> runs_;  // a vessel each
  std::vector<std::uint32_t> firstTube_;
  std::vector<Address> addresses_;
  Exclusions neighbours_{0};
};

}  // namespace vasa
