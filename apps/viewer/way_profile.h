#pragma once
#include <optional>
#include <string>
#include <vector>

#include "network/measure_profile.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// Radius and area along what is looked at.
struct WayProfile {
  std::string title;
  std::vector<ProfileStation> stations;
  std::size_t vessels = 1;

  float length() const { return stations.back().along; }                                             ///< [m]
  float straight() const { return glm::distance(stations.front().centre, stations.back().centre); }  ///< [m]
};

/// Of the way between the two places that are measured; while nothing is measured of the chosen vessel. None
/// where there is neither, or no vessel joins the two.
/// @param points  in the present pose
std::optional<WayProfile> profileOf(const ViewState& state, const Network& network,
                                    std::span<const vec4> points);

}  // namespace vasa::viewer
