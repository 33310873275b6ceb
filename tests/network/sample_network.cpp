#include "network/sample_network.h"

namespace vasa::test {

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
