#pragma once
#include <optional>
#include <vector>

#include "network/network.h"

namespace vasa {

/// A vessel's place in its tree: whom it hangs on, and who hangs on it.
struct Relatives {
  std::vector<VesselId> parents;   ///< vessels whose side an end of it lies on, or that end where it starts
  std::vector<VesselId> children;  ///< vessels that hang on its side, or start where it ends
};
Relatives relativesOf(const Network& network, VesselId vessel);

/// The vessel and all that hang on it, directly or through others, in the order they are met.
std::vector<VesselId> treeBelow(const Network& network, VesselId vessel);

/// A place on a vessel.
struct VesselPlace {
  VesselId vessel;
  float parameter = 0;  ///< u in [0, spans]
  bool operator==(const VesselPlace&) const = default;
};

/// A way through the network, along centre lines.
struct Route {
  struct Leg {
    VesselId vessel;
    float from = 0, to = 0;  ///< parameters, in the order they are passed
  };
  std::vector<Leg> legs;
  float length = 0;  ///< [m]
};

/// Builds routes on one shape of a network.
class RouteFinder {
 public:
  /// @param network  must outlive this; @param points as Network::points(), read, not kept
  RouteFinder(const Network& network, std::span<const vec4> points);

  /// The shortest way between two places; none if no vessel joins them. From a side branch one goes on along
  /// the host from where it hangs. Method: Dijkstra (1959) over the places where vessels meet. O(nodes log
  /// nodes).
  std::optional<Route> find(VesselPlace from, VesselPlace to) const;

 private:
  // A place where one may change from vessel to vessel, on one of them.
  struct Stop {
    float parameter, along;  // [m] along the vessel
    std::uint32_t node;
  };
  struct Line {
    std::vector<Stop> stops;     // by parameter
    std::vector<float> lengths;  // [m] up to each span's start, and the whole
  };
  float along(VesselPlace place) const;

  const Network* network_;
  std::vector<vec4> points_;
  std::vector<Line> lines_;  // one a vessel
};

}  // namespace vasa
