#include <doctest/doctest.h>

#include "gpu/gpu_rig.h"
#include "network/measure.h"
#include "render/renderer.h"
#include "scene/frame.h"
#include "support/live_memory.h"

using namespace vasa;

namespace {

Scene human() {
  const std::filesystem::path data = VASA_HUMAN_DATA;
  SceneFile file;
  file.body = data / "human.glb";
  file.networks = {data / "human.vasa"};
  auto scene = loadScene(file);
  REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
  return std::move(*scene);
}

}  // namespace

// By then every list has been as long as the motion makes it. A motion's beginning, from rest to its first
// pose, counts not: the clip begins anew only because it is short.
TEST_CASE(
    "a hundred frames of a walk, solved, uploaded and drawn, allocate nothing once the walk has gone round") {
  VASA_REQUIRE_GPU(rig);
  if (!test::countsMemory()) return;
  const Scene scene = human();
  const auto clip = findClip(scene.body, "walk");
  REQUIRE(clip);
  FrameMaker maker(scene,
                   {.avoid = true, .track = std::make_shared<MotionTrack>(MotionTrack::Keeps::latest)});
  RenderOptions options;
  // What allocates depends neither on how many pixels nor on how many triangles there are.
  options.width = 160, options.height = 120;
  options.samples = 1;
  options.pixelError = kAutoPixelError;
  options.skeleton = &scene.body.skeleton;
  gpu::Device device;  // without the validation layer, which allocates
  const std::size_t own = test::ownAllocationCount();
  Renderer renderer(device, scene.network, scene.body.meshes, options);
  CHECK(test::ownAllocationCount() > own);  // it counts
  const Camera camera =
      cameraFrom(View::front, measure(scene.network, scene.network.points()).bounds, 4.0f / 3);
  std::size_t frames = 0, solving = 0, drawing = 0;
  const auto goRound = [&] {
    for (std::uint32_t frame = 0; frame < (*clip)->frameCount(); ++frame) {
      const std::size_t before = test::allocationCount();
      maker.make(*clip, (*clip)->timeOfFrame(frame));
      const std::size_t solved = test::allocationCount(), ownSolved = test::ownAllocationCount();
      renderer.draw({.points = maker.points(),
                     .knotFrames = maker.knotFrames(),
                     .jointMatrices = maker.jointMatrices(),
                     .camera = camera,
                     .look = {}});
      if (frame == 0) continue;
      ++frames;
      solving += solved - before;
      drawing += test::ownAllocationCount() - ownSolved;
    }
  };
  for (int i = 0; i < 3; ++i) goRound();
  CHECK(solving > 0);  // it counts
  // Which thread takes which part of a frame is chance, and with it when a thread's own room is as large as
  // it gets.
  for (int attempt = 0; attempt < 3 && solving + drawing > 0; ++attempt) {
    frames = solving = drawing = 0;
    while (frames < 100) goRound();
  }
  MESSAGE(frames << " frames");
  CHECK(solving == 0);
  CHECK(drawing == 0);
}
