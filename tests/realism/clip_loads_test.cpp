#include "realism/clip_loads.h"

#include <doctest/doctest.h>

#include "network/builder.h"
#include "scene/frame.h"
#include "scene/scene.h"
#include "support/kept_once.h"

using namespace vasa;

namespace {

Network straight() {
  NetworkBuilder builder;
  std::vector<vec4> points;
  for (const float u : {0.0f, 1 / 3.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5 - 1 / 3.0f, 5.0f})
    points.emplace_back(0.01f * u, 0, 0, 0.002f);
  builder.addVessel({"straight", "", VesselKind::artery}, points);
  auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  return std::move(network).value();
}

std::vector<vec4> longer(const Network& network, float by) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (vec4& p : points) p.x *= by;
  return points;
}

}  // namespace

TEST_CASE(
    "a vessel is told by its worst frame, a length both by that at rest and by that of the frame before") {
  const Network network = straight();
  const Avoider avoider(network, nullptr);
  ClipLoads loads(network);
  std::uint32_t frame = 7;
  for (const float length : {1.0f, 1.04f, 1.2f, 1.41f, 1.45f, 1.44f})
    loads.look(frame++, longer(network, length), avoider);
  REQUIRE(loads.strained().size() == 1);
  CHECK(loads.strained()[0].value == doctest::Approx(0.45f).epsilon(1e-3));
  CHECK(loads.strained()[0].frame == 11);
  REQUIRE(loads.fast().size() == 1);
  CHECK(loads.fast()[0].value == doctest::Approx(1.41f / 1.2f - 1).epsilon(1e-3));
  CHECK(loads.fast()[0].frame == 10);
  CHECK(loads.kinked().empty());

  ClipLoads bent(network);
  std::vector<vec4> points = longer(network, 1);
  points[4] = points[2] + vec4(0, 0.001f, 0, 0);  // folded back
  bent.look(0, points, avoider);
  REQUIRE(bent.kinked().size() == 1);
  CHECK(bent.kinked()[0].value > 1);
}

TEST_CASE(
    "no motion of the built-in human kinks a vessel, strains one over 5 mm by 40 % or changes its length by 5 % in a frame") {
  const test::KeptOnce kept;
  const std::filesystem::path data = VASA_HUMAN_DATA;
  const auto scene = loadScene(
      {.body = data / "human.glb", .networks = {data / "human.vasa"}, .holds = data / "human.holds.csv"});
  REQUIRE_MESSAGE(scene.ok(), scene.error().message);
  for (const Clip& clip : scene->body.clips) {
    FrameMaker maker(*scene, {.avoid = true});
    ClipLoads loads(scene->network);
    for (std::uint32_t frame = 0; frame < clip.frameCount(); ++frame) {
      maker.make(&clip, clip.timeOfFrame(frame));
      loads.look(frame, maker.points(), *maker.avoider());
    }
    const auto none = [&](const std::string& word, const std::vector<VesselBeyond>& vessels) {
      for (const VesselBeyond& beyond : vessels)
        FAIL_CHECK(clip.name << " frame " << beyond.frame << ": " << scene->network.vessel(beyond.vessel).name
                             << " " << word << " " << beyond.value);
    };
    none("bends to", loads.kinked());
    none("is strained by", loads.strained());
    none("steps by", loads.fast());
  }
}
