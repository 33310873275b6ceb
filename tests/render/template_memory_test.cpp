#include <doctest/doctest.h>

#include "gpu/gpu_rig.h"
#include "network/measure.h"
#include "render/drawn_memory.h"
#include "render/picture.h"
#include "render/renderer.h"
#include "support/frames.h"
#include "support/networks.h"

// A template is used again and again: what tubes, caps and forks take of the device does not depend on how
// many there are.

using namespace vasa;

namespace {

constexpr std::size_t kBound = 2u << 20;

struct DrawnFrame {
  std::size_t bytes = 0;
  std::uint64_t picture = 0, triangles = 0;
};

// Two frames of a network that is all in view, from far and from near: the device's memory that their draws
// read.
DrawnFrame drawn(const test::GpuRig& rig, const Network& network, const RenderOptions& options) {
  const std::vector<quat> frames = test::framesOf(network);
  const RenderInput far{.points = network.points(),
                        .knotFrames = frames,
                        .jointMatrices = {},
                        .camera = cameraFrom(View::front, measure(network, network.points()).bounds, 1),
                        .look = {}};
  RenderInput near = far;
  near.camera.position = glm::mix(far.camera.position, far.camera.target, 0.8f);
  test::watchDraws();
  Renderer renderer(rig.device(), network, {}, options);
  DrawnFrame frame;
  renderer.draw(near);
  renderer.draw(far);
  frame.triangles = renderer.drawnTriangleCount();
  frame.picture = test::hashOfPicture(renderer.readBack());
  const test::DrawnMemory memory = test::drawnMemory();
  frame.bytes = memory.bytes;
  CHECK(memory.buffers > 0);
  CHECK(renderer.templateBytes() >= memory.bytes);
  return frame;
}

RenderOptions small(SweepShape shape, float pixelError) {
  RenderOptions options;  // the templates are the default's
  options.width = options.height = 200;
  options.shape = shape;
  options.pixelError = pixelError;
  return options;
}

}  // namespace

TEST_CASE(
    "tubes, caps and forks take less than 2 MiB of the device, however many there are and whatever is seen of them") {
  VASA_REQUIRE_GPU(rig);
  std::size_t largest = 0;
  for (const std::uint32_t vessels : {60u, 600u, 66000u}) {  // the last of 420,000 sweeps
    const Network network = test::windingNetwork(vessels, 1);
    const SweepTable table = makeSweepTable(network);
    for (const bool automatic : {false, true}) {
      RenderOptions options = small({8, 10}, automatic ? kAutoPixelError : 0);
      options.table = &table;
      CAPTURE(vessels);
      CAPTURE(automatic);
      const DrawnFrame culled = drawn(rig, network, options);
      CHECK(culled.bytes <= kBound);
      if (vessels > 600) continue;  // millions of triangles
      options.cull = false;
      const DrawnFrame whole = drawn(rig, network, options);
      CHECK(whole.bytes <= kBound);
      CHECK(whole.picture == culled.picture);
      CHECK(whole.triangles > culled.triangles);
      largest = std::max(largest, whole.bytes);
    }
  }
  CHECK(largest > kBound / 2);  // both templates were in use
}

TEST_CASE(
    "what a round has no room for comes in later ones, in the same order: the picture is that of one large template") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::branchingNetwork(60, 3);
  for (const SweepShape shape : {SweepShape{3, 2}, SweepShape{8, 10}}) {
    RenderOptions options = small(shape, 0);
    options.templateBytes = 1u << 26;
    const DrawnFrame once = drawn(rig, network, options);
    for (const std::uint32_t bytes : {1u, 300'000u}) {
      options.templateBytes = bytes;
      CHECK(drawn(rig, network, options).picture == once.picture);
    }
  }
}
