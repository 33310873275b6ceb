#pragma once
#include <span>
#include <vector>

#include "network/network.h"

namespace vasa {

/// Some vessels of a network as a graph of places along their centre lines.
class Course {
 public:
  struct Step {
    std::uint32_t from, to;  ///< into places()
  };

  /// @param vessels  pieces of one vessel; where they meet one another they share a place,
  ///                 and free ends within a radius of one another are joined
  /// @param spacing  [m] between places, at most
  Course(const Network& network, std::span<const VesselId> vessels, double spacing);

  std::span<const vec3> places() const { return places_; }
  std::span<const Step> steps() const { return steps_; }
  double length() const;  ///< [m] of all pieces

  /// The longest of the shortest ways between two places that are joined: of a tree of branches its stem, of
  /// pieces that are not joined the longest one. Method: the farthest place from the farthest place, which is
  /// exact where the graph is a tree. O(places log places)
  std::vector<vec3> longestWay() const;

 private:
  std::uint32_t add(vec3 place);
  std::vector<vec3> places_;
  std::vector<Step> steps_;  // along vessels, then those that join them
  std::size_t alongSteps_ = 0;
};

/// [m] of a polyline.
double wayLength(std::span<const vec3> way);

}  // namespace vasa
