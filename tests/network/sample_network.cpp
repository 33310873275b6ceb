#include "network/sample_network.h"

#include <algorithm>

namespace vasa::test {

std::vector<vec4> straightVessel(vec3 from, vec3 to, float radius, std::uint32_t spans) {
  std::vector<vec4> points;
  // Greville abscissae make the curve run along the line at constant speed.
  for (std::uint32_t i = 0; i < spans + 3; ++i) {
    const auto knot = [&](int k) { return float(std::clamp(k, 0, int(spans))); };
    const float u = (knot(int(i) - 2) + knot(int(i) - 1) + knot(int(i))) / 3;
    points.push_back(vec4(glm::mix(from, to, u / float(spans)), radius));
  }
  return points;
}

NetworkBuilder sampleBuilder() {
  NetworkBuilder builder;
  const VesselId trunk = builder.addVessel({"trunk", "FMA1", VesselKind::artery},
                                           straightVessel({0, 0, 0}, {0, 1, 0}, 0.01f, 5));
  const VesselId side = builder.addVessel({"side branch", "", VesselKind::artery},
                                          straightVessel({0, 0.5f, 0}, {0.3f, 0.6f, 0}, 0.004f, 2));
  const VesselId left = builder.addVessel({"left arm", "FMA2", VesselKind::artery},
                                          straightVessel({0, 1, 0}, {0.2f, 1.3f, 0}, 0.007f, 3));
  const VesselId right = builder.addVessel({"right arm", "", VesselKind::artery},
                                           straightVessel({0, 1, 0}, {-0.2f, 1.3f, 0}, 0.007f, 3));
  builder.addVessel({"vein", "", VesselKind::vein}, straightVessel({0.1f, 0, 0}, {0.1f, 1, 0}, 0.01f, 4));
  builder.joinToSide({side, false}, {trunk, 2.5f});
  builder.joinEnds({{trunk, true}, {left, false}, {right, false}});
  return builder;
}

}  // namespace vasa::test
