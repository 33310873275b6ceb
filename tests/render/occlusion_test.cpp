#include <doctest/doctest.h>

#include "gpu/barrier.h"
#include "gpu/gpu_rig.h"
#include "network/measure.h"
#include "reference/occlusion.h"
#include "render/occlusion_pass.h"
#include "render/surface_pass.h"
#include "support/frames.h"
#include "support/networks.h"

using namespace vasa;

namespace {

constexpr std::uint32_t kWidth = 201, kHeight = 155;

// What a camera sees of a floor (y = 0) and, where `wall` says so, a wall (z = 0) that stands on it.
std::vector<float> roomDepth(const Camera& camera, bool wall) {
  const shared::OcclusionPush at = occlusionConstants(camera, kWidth, kHeight, 1, 1);
  const mat3 axes = cameraAxes(camera);
  std::vector<float> depth(kWidth * kHeight, 0.0f);
  for (std::uint32_t i = 0; i < depth.size(); ++i) {
    const vec2 ray = at.corner + (vec2(float(i % kWidth), float(i / kWidth)) + 0.5f) * at.step;
    const vec3 way = axes * vec3(ray, -1);
    float distance = way.y < 0 ? -camera.position.y / way.y : 1e9f;
    if (wall && way.z < 0) distance = std::min(distance, -camera.position.z / way.z);
    if (distance < 1e8f) depth[i] = camera.nearDistance / distance;
  }
  return depth;
}

Camera roomCamera() {
  Camera camera;
  camera.position = {0, 1, 2};
  camera.target = {0, 0, 0.0f};
  camera.verticalAngle = 0.6f;
  return camera;
}

// After earlier commands. @param layout  in which the image is, and stays
void copyFloats(VkCommandBuffer commands, const gpu::Image& image, VkImageLayout layout,
                const gpu::Buffer& to) {
  constexpr VkImageLayout source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  gpu::changeLayout(commands,
                    {.image = image.handle(), .aspect = image.aspect(), .before = layout, .after = source});
  VkBufferImageCopy region{};
  region.imageSubresource = {image.aspect(), 0, 0, 1};
  region.imageExtent = {image.size().width, image.size().height, 1};
  vkCmdCopyImageToBuffer(commands, image.handle(), source, to.handle(), 1, &region);
  gpu::changeLayout(commands,
                    {.image = image.handle(), .aspect = image.aspect(), .before = source, .after = layout});
}

float least(const std::vector<float>& values) { return *std::min_element(values.begin(), values.end()); }

}  // namespace

TEST_CASE("a floor keeps its light, and loses it towards a wall") {
  const Camera camera = roomCamera();
  const shared::OcclusionPush constants = occlusionConstants(camera, kWidth, kHeight, 0.2f, 1);
  CHECK(least(occlusionOf(roomDepth(camera, false), constants)) > 0.98f);
  const std::vector<float> depth = roomDepth(camera, true),
                           light = smoothed(depth, occlusionOf(depth, constants), constants);
  const auto at = [&](std::uint32_t y) { return light[y * kWidth + kWidth / 2]; };
  CHECK(at(kHeight / 2) < 0.8f);   // the corner between them
  CHECK(at(kHeight - 3) > 0.95f);  // the floor before it
}

TEST_CASE("no depth, no occlusion; strength 0, none either") {
  const Camera camera = roomCamera();
  const std::vector<float> nothing(kWidth * kHeight, 0.0f), room = roomDepth(camera, true);
  CHECK(least(occlusionOf(nothing, occlusionConstants(camera, kWidth, kHeight, 0.2f, 1))) == 1);
  CHECK(least(occlusionOf(room, occlusionConstants(camera, kWidth, kHeight, 0.2f, 0))) == 1);
}

TEST_CASE(
    "the passes find what the CPU reference does, for one and four samples, perspective and orthographic") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::windingNetwork(40, 9);
  const std::vector<quat> frames = test::framesOf(network);
  for (const float orthographic : {0.0f, 1.3f})
    for (const VkSampleCountFlagBits samples : {VK_SAMPLE_COUNT_1_BIT, VK_SAMPLE_COUNT_4_BIT}) {
      const gpu::Target target(
          rig.device(),
          {.name = "picture", .size = {kWidth, kHeight}, .samples = samples, .readDepth = true});
      const SurfacePass surface(rig.device(), target.spec());
      const OcclusionPass pass(rig.device(), target);
      const TubeSet tubes(rig.device(), network, {}, 1u << 20);
      const DetailPass detail(rig.device(), tubes);
      const ForkSet forks(rig.device(), tubes.table(), {}, 1u << 20);
      const TubePass tubePass(rig.device(), samples, tubes);
      const PlanPass planPass(rig.device());
      const FillRange all{0, std::uint32_t(tubes.table().sweeps.size()), 0, 0};
      const Filling filling(rig.device(), tubes, forks, roomForAll(tubes, forks, all));
      const Template filled(rig.device(), filling.room());
      const gpu::Buffer points =
          rig.upload(std::vector<vec4>(network.points().begin(), network.points().end()));
      const gpu::Buffer knots = rig.upload(frames);
      const std::vector<float> none(kWidth * kHeight);
      const gpu::Buffer depths = rig.upload(none), raws = rig.upload(none), lights = rig.upload(none);
      Camera camera =
          cameraFrom(View::front, measure(network, network.points()).bounds, float(kWidth) / kHeight);
      camera.orthographicHeight = orthographic;
      const shared::DetailView view =
          detailView(camera, {}, pictureGrid(rig.device(), target.spec().size, samples), tubes.detail());
      rig.run([&](VkCommandBuffer commands) {
        detail.record(commands, tubes, points.address(), view);
        filling.recordStart(commands, all);
        tubePass.record(commands, {tubes, detail, points.address(), knots.address(), filling, filled});
        gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                          VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
        planPass.record(commands, filling, filled);
        gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                          VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT);
        target.begin(commands, {1, 1, 1, 1}, 0, gpu::Stretch::first);
        surface.recordVessels(commands, drawConstants(camera, {}, target.spec().size), drawsOf(filled));
        target.pause(commands);
        gpu::stageBarrier(commands, gpu::kAttachmentStages, gpu::kAttachmentStages);
        pass.record(commands, target, camera, 0.05f, 1);
        gpu::stageBarrier(commands, gpu::kAttachmentStages, gpu::kAttachmentStages);
        target.makeDepthReadable(commands);
        copyFloats(commands, target.readableDepth(), gpu::kReadDepthLayout, depths);
        copyFloats(commands, pass.raw(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, raws);
        copyFloats(commands, pass.light(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, lights);
        target.makeDepthWritable(commands);
        target.begin(commands, {}, 0, gpu::Stretch::last);
        target.end(commands);
      });
      const shared::OcclusionPush constants = occlusionConstants(camera, kWidth, kHeight, 0.05f, 1);
      const std::vector<float> depth = rig.download<float>(depths), raw = rig.download<float>(raws);
      const std::vector<float> light = rig.download<float>(lights);
      const std::vector<float> wantedRaw = occlusionOf(depth, constants),
                               wanted = smoothed(depth, raw, constants);
      CHECK(*std::max_element(depth.begin(), depth.end()) > 0);
      CAPTURE(orthographic);
      CAPTURE(samples);
      CHECK(least(raw) < 0.95f);
      std::size_t off = 0;
      for (std::size_t i = 0; i < raw.size(); ++i) {
        off += std::abs(raw[i] - wantedRaw[i]) > 1e-3f;  // a tap may round to the next pixel
        CHECK(std::abs(light[i] - wanted[i]) < 1e-4f);
      }
      CHECK(off <= raw.size() / 200);
    }
}
