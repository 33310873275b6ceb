#pragma once
#include "body/binding.h"
#include "realism/lines.h"
#include "scene/scene.h"

namespace vasa::test {

// A leg by its joints alone, on either side, and the vessels of landmarkNetwork() before its knee, mirrored
// to the right.
inline Scene twoLegs() {
  Body body;
  body.name = "legs";
  struct Row {
    const char* name;
    int parent;
    vec3 place;
  };
  for (const Row& row : {Row{"Hips", -1, {0, 1.1f, 0}},
                         {"LeftUpLeg", 0, {0.1f, 1.05f, 0}},
                         {"LeftLeg", 1, {0.1f, 0.85f, 0.03f}},
                         {"LeftFoot", 2, {0.1f, 0.5f, 0.03f}},
                         {"RightUpLeg", 0, {-0.1f, 1.05f, 0}},
                         {"RightLeg", 4, {-0.1f, 0.85f, 0.03f}},
                         {"RightFoot", 5, {-0.1f, 0.5f, 0.03f}},
                         {"Spine", 0, {0, 1.3f, 0}},
                         {"Head", 7, {0, 1.6f, 0}}}) {
    Skeleton::Joint joint;
    joint.name = row.name;
    joint.restWorld = glm::translate(mat4(1), row.place);
    joint.rest.translation = row.place;
    if (row.parent >= 0) {
      joint.parent = {std::uint32_t(row.parent)};
      joint.rest.translation -= vec3(body.skeleton.joints[std::size_t(row.parent)].restWorld[3]);
    }
    joint.inverseBind = glm::inverse(joint.restWorld);
    body.skeleton.joints.push_back(joint);
  }
  const Network left = landmarkNetwork();
  NetworkBuilder builder;
  for (const bool mirror : {false, true})
    for (const Vessel& vessel : left.vessels()) {
      std::vector<vec4> points(left.pointsOf(vessel).begin(), left.pointsOf(vessel).end());
      if (mirror)
        for (vec4& p : points) p.x = -p.x;
      builder.addVessel({(mirror ? "right" : "left") + vessel.name.substr(4), "", VesselKind::artery},
                        points);
    }
  for (const std::uint32_t side : {0u, 5u}) {
    builder.joinEnds({{{side}, true}, {{side + 1}, false}});
    builder.joinToSide({{side + 2}, false}, {{side}, 5});
    builder.joinToSide({{side + 3}, false}, {{side}, 15});
    builder.joinToSide({{side + 4}, false}, {{side + 1}, 10});
  }
  auto network = builder.build(1.75f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  auto binding = bind(body, *network, "legs.vasa");
  REQUIRE_MESSAGE(binding.ok(), binding.error().message);
  return {std::move(body), std::move(*network), std::move(*binding)};
}

}  // namespace vasa::test
