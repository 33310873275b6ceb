#include "gpu/target.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "gpu/error.h"
#include "gpu/gpu_rig.h"
#include "gpu/graphics_pipeline.h"
#include "spirv/triangle_frag.h"
#include "spirv/triangle_vert.h"

using namespace vasa;

namespace {

using Pixel = std::array<std::uint8_t, 4>;
constexpr Pixel kRed{255, 0, 0, 255}, kGreen{0, 255, 0, 255}, kBlack{0, 0, 0, 255};

struct Push {
  std::uint64_t corners;
  alignas(16) float colour[4];
};

// Odd sizes: rows must come out without gaps whatever a driver's alignment is.
constexpr VkExtent2D kSize{37, 21};

struct Scene {
  gpu::Target target;
  gpu::GraphicsPipeline pipeline;
  gpu::Buffer corners, picture;

  Scene(const test::GpuRig& rig, VkSampleCountFlagBits samples, gpu::GraphicsSpec spec = {})
      : target(rig.device(), {"scene", kSize, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_D32_SFLOAT, samples}),
        // Two triangles over the left half: the first nearer and above the diagonal only, then both halves.
        corners(rig.upload(std::vector<float>{-1, -1, .2f, -1, 1, .2f, 0, -1, .2f,  //
                                              -1, -1, .5f, -1, 1, .5f, 0, -1, .5f,  //
                                              0,  -1, .5f, -1, 1, .5f, 0, 1,  .5f})),
        picture(rig.device(), {"picture", target.pictureBytes(), gpu::MemoryRole::readBack}) {
    spec.name = "triangle";
    spec.vertex = spirv::triangle_vert;
    spec.fragment = spirv::triangle_frag;
    spec.pushBytes = sizeof(Push);
    spec.colour = VK_FORMAT_R8G8B8A8_UNORM;
    spec.samples = samples;
    pipeline = gpu::GraphicsPipeline(rig.device(), spec);
  }

  std::vector<Pixel> draw(const test::GpuRig& rig) {
    rig.run([&](VkCommandBuffer commands) {
      target.begin(commands, {0, 0, 0, 1});
      pipeline.bind(commands, Push{corners.address(), {1, 0, 0, 1}});
      vkCmdDraw(commands, 3, 1, 0, 0);
      pipeline.bind(commands, Push{corners.address(), {0, 1, 0, 1}});
      vkCmdDraw(commands, 6, 1, 3, 0);
      target.end(commands);
      target.copyPicture(commands, picture);
    });
    std::vector<Pixel> pixels(kSize.width * kSize.height);
    picture.read(std::span(pixels));
    return pixels;
  }
};

const Pixel& at(const std::vector<Pixel>& pixels, std::uint32_t x, std::uint32_t y) {
  return pixels[y * kSize.width + x];
}

}  // namespace

TEST_CASE("triangles fetched by address are drawn, hidden by depth and read back") {
  VASA_REQUIRE_GPU(rig);
  for (const auto samples : {VK_SAMPLE_COUNT_1_BIT, VK_SAMPLE_COUNT_4_BIT}) {
    Scene scene(rig, samples);
    for (int frame = 0; frame < 2; ++frame) {
      const auto pixels = scene.draw(rig);
      CHECK(at(pixels, 1, 1) == kRed);  // nearer, though drawn first
      CHECK(at(pixels, 16, 19) == kGreen);
      CHECK(at(pixels, 30, 1) == kBlack);
      CHECK(at(pixels, 36, 20) == kBlack);
    }
  }
}

TEST_CASE("several samples a pixel soften the edge, one does not") {
  VASA_REQUIRE_GPU(rig);
  const auto softened = [&](VkSampleCountFlagBits samples) {
    Scene scene(rig, samples);
    int count = 0;
    for (const Pixel& pixel : scene.draw(rig)) count += pixel != kRed && pixel != kGreen && pixel != kBlack;
    return count;
  };
  CHECK(softened(VK_SAMPLE_COUNT_1_BIT) == 0);
  CHECK(softened(VK_SAMPLE_COUNT_4_BIT) > 5);
}

TEST_CASE("culling, the depth test and blending do as the specification says") {
  VASA_REQUIRE_GPU(rig);
  gpu::GraphicsSpec spec;
  spec.front = VK_FRONT_FACE_CLOCKWISE;
  CHECK(at(Scene(rig, VK_SAMPLE_COUNT_1_BIT, spec).draw(rig), 1, 1) == kBlack);
  spec = {};
  spec.depthTest = VK_COMPARE_OP_ALWAYS;
  CHECK(at(Scene(rig, VK_SAMPLE_COUNT_1_BIT, spec).draw(rig), 1, 1) == kGreen);
  spec = {};
  spec.depthTest = VK_COMPARE_OP_ALWAYS;
  spec.depthWrite = false;
  spec.blend = gpu::Blend::premultiplied;
  CHECK(at(Scene(rig, VK_SAMPLE_COUNT_4_BIT, spec).draw(rig), 1, 1) == kGreen);
}

TEST_CASE("a target without pixels, or too large, is refused") {
  VASA_REQUIRE_GPU(rig);
  CHECK_THROWS_WITH_AS(gpu::Target(rig.device(), {"nothing", {0, 5}}),
                       doctest::Contains("nothing: 0x5 pixels; each side must be 1 to "), gpu::Error);
  CHECK_THROWS_AS(gpu::Target(rig.device(), {"huge", {0xffffffffu, 5}}), gpu::Error);
}
