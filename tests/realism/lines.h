#pragma once
#include <doctest/doctest.h>

#include "curve/fit.h"
#include "network/builder.h"

namespace vasa::test {

/// De Boor points of a straight vessel, its parameter in step with its arc.
inline std::vector<vec4> straightPoints(vec3 from, vec3 to, float radius, std::uint32_t spans) {
  std::vector<vec4> points;
  for (std::uint32_t j = 0; j < spans + 3; ++j)
    points.emplace_back(glm::mix(from, to, float(greville(j, spans)) / float(spans)), radius);
  return points;
}

/// "left trunk" down from (0.1, 1, 0) over 20 cm, "left next" on from there over 10 cm, and three branches
/// forwards: "left high" at 5 cm, "left low" at 15 cm, "left last" where the second ends.
inline Network landmarkNetwork() {
  NetworkBuilder builder;
  const auto add = [&](const char* name, vec3 from, vec3 to, std::uint32_t spans) {
    return builder.addVessel({name, "", VesselKind::artery}, straightPoints(from, to, 0.003f, spans));
  };
  const VesselId trunk = add("left trunk", {0.1f, 1, 0}, {0.1f, 0.8f, 0}, 20),
                 next = add("left next", {0.1f, 0.8f, 0}, {0.1f, 0.7f, 0}, 10);
  builder.joinEnds({{trunk, true}, {next, false}});
  builder.joinToSide({add("left high", {0.1f, 0.95f, 0}, {0.1f, 0.95f, 0.03f}, 3), false}, {trunk, 5});
  builder.joinToSide({add("left low", {0.1f, 0.85f, 0}, {0.1f, 0.85f, 0.03f}, 3), false}, {trunk, 15});
  builder.joinToSide({add("left last", {0.1f, 0.7f, 0}, {0.1f, 0.7f, 0.03f}, 3), false}, {next, 10});
  auto network = builder.build(1.75f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  return std::move(network).value();
}

}  // namespace vasa::test
