#include "realism/study.h"

#include "realism/lines.h"

using namespace vasa;

namespace {

// A leg by its joints alone, on either side, and the vessels of landmarkNetwork() before its knee, mirrored
// to the right.
Scene twoLegs() {
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
  const Network left = test::landmarkNetwork();
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

Protocol oneRow(PoseMetric metric, float mean, std::optional<float> deviation) {
  Protocol protocol;
  protocol.poses["bent"] = {{"leftLowerLeg", glm::radians(90.0f)}, {"rightLowerLeg", glm::radians(90.0f)}};
  ProtocolRow row;
  row.id = "A", row.from = "left high", row.to = "left last", row.firstPose = "rest", row.lastPose = "bent";
  row.metric = metric, row.mean = mean, row.deviation = deviation;
  protocol.rows = {row};
  return protocol;
}

}  // namespace

TEST_CASE("a vessel behind the knee's axis is shortened by a bend, as much as its lever and the angle say") {
  const Scene scene = twoLegs();
  // 3 cm behind the axis, a quarter turn: 47 mm shorter, and by what a spline cuts off so short a bend.
  Protocol protocol = oneRow(PoseMetric::lengthChangeMm, -47, 5.0f);
  protocol.rows[0].from = "left trunk";
  protocol.rows.push_back(protocol.rows.front());
  protocol.rows.back().blind = true, protocol.rows.back().mean = 47;
  protocol.rows.push_back(protocol.rows.front());
  protocol.rows.back().from = "left nothing";
  protocol.sweeps = {{"knee", "bent", "left trunk", "left last", PoseMetric::lengthChangeMm, 90}};
  const RealismStudy study = studyRealism(scene, protocol, {.avoid = true});
  const ProtocolResult& good = study.results[0];
  CHECK(good.ours == doctest::Approx(-47).epsilon(0.15));
  CHECK(good.rightSign == true);
  CHECK(good.within(2));
  CHECK(good.onTheWay.front() > good.ours);
  CHECK(study.tuned.usable == 1);
  CHECK(study.tuned.withinTwo == 1);
  CHECK(study.blind.usable == 1);
  CHECK(study.blind.rightSign == 0);
  CHECK(study.blind.withinTwo == 0);
  CHECK(study.results[2].refusal == "no vessel is called 'left nothing'");
  CHECK(study.curves[0].values.front() == 0);
  CHECK(study.curves[0].values.back() == doctest::Approx(good.ours).epsilon(0.05));
  CHECK(study.curves[0].degrees.back() == 90);
}

TEST_CASE("sliding spreads a bend's strain along the vessel and keeps the whole") {
  const Scene scene = twoLegs();
  const auto change = [&](const char* from, const char* to, bool slide) {
    Protocol protocol = oneRow(PoseMetric::lengthChangeMm, 0, {});
    protocol.rows[0].from = from, protocol.rows[0].to = to;
    return studyRealism(scene, protocol, {.slide = slide, .avoid = true}).results[0].ours;
  };
  // But for what splines of other density cut off a bend of a few millimetres.
  CHECK(change("left trunk", "left last", true) ==
        doctest::Approx(change("left trunk", "left last", false)).epsilon(0.35));
  CHECK(std::abs(change("left trunk", "left high", false)) < 1);  // far above the bend
  CHECK(change("left trunk", "left high", true) < -3);
}
