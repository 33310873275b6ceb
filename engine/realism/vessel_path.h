#pragma once
#include <string_view>
#include <vector>

#include "network/route.h"

namespace vasa {

/// A stretch of vessels between two landmarks, marked off at rest: the same places of the wall are looked at
/// in every pose.
struct VesselPath {
  struct Station {
    VesselId vessel;
    float parameter;  ///< u
    float rest;       ///< [m] along the path at rest
  };
  std::vector<Station> stations;  ///< a millimetre apart, from landmark to landmark

  /// Where they are in a pose. @param points  as Network::points()
  std::vector<vec4> places(const Network& network, std::span<const vec4> points) const;
};

/// Finds stretches by the names of what bounds them.
class PathFinder {
 public:
  /// @param network  must outlive this
  explicit PathFinder(const Network& network);

  /// From landmark to landmark along the vessels, or a part of that stretch.
  /// @param from, to  "NAME": where this vessel begins (leaves its host); "NAME@end"; "NAME@0.3": at that
  /// share of its parameter.
  ///                  Names that mean the same are parted by '|', the first one that there is counts.
  /// Fails with badInput where a vessel is not there, or no vessels lead from one to the other.
  Result<VesselPath> find(std::string_view from, std::string_view to, float firstShare = 0,
                          float lastShare = 1) const;

 private:
  Result<VesselPlace> landmark(std::string_view text) const;
  const Network* network_;
  RouteFinder routes_;
};

}  // namespace vasa
