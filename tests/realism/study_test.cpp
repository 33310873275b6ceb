#include "realism/study.h"

#include "realism/two_legs.h"

using namespace vasa;

namespace {

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
  const Scene scene = test::twoLegs();
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
  const Scene scene = test::twoLegs();
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
