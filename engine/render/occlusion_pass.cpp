#include "render/occlusion_pass.h"

#include <cmath>

#include "gpu/barrier.h"
#include "spirv/occlude_frag.h"
#include "spirv/occlusion_frag.h"
#include "spirv/screen_vert.h"
#include "spirv/smooth_frag.h"

namespace vasa {
namespace {

gpu::Image makeLight(gpu::Device& device, const char* name, const gpu::Target& target) {
  return {
      device,
      {name, target.spec().size, VK_FORMAT_R32_SFLOAT,
       VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}};
}

// One triangle over the whole picture, at the background's depth: only what lies before that is shaded.
gpu::GraphicsSpec overDepth(const gpu::ShaderCode& fragment, const gpu::ImageSet& images,
                            const gpu::TargetSpec& target) {
  return {.name = "occlusion",
          .vertex = spirv::screen_vert,
          .fragment = fragment,
          .pushBytes = sizeof(shared::OcclusionPush),
          .sets = {&images.layout(), 1},
          .colour = target.colour,
          .depth = target.depth,
          .samples = target.samples,
          .cull = VK_CULL_MODE_NONE,
          .depthTest = VK_COMPARE_OP_LESS,
          .depthWrite = false};
}

gpu::GraphicsSpec intoLight(const gpu::ShaderCode& fragment, const gpu::ImageSet& images,
                            gpu::TargetSpec target, const gpu::Image& light) {
  target.colour = light.format();
  target.samples = VK_SAMPLE_COUNT_1_BIT;
  return overDepth(fragment, images, target);
}

gpu::GraphicsSpec ontoPicture(const gpu::ImageSet& images, const gpu::TargetSpec& target) {
  gpu::GraphicsSpec spec = overDepth(spirv::occlude_frag, images, target);
  spec.blend = gpu::Blend::multiply;
  return spec;
}

void draw(VkCommandBuffer commands, const gpu::GraphicsPipeline& pipeline, const gpu::ImageSet& images,
          const shared::OcclusionPush& push) {
  pipeline.bind(commands, push);
  images.bind(commands, pipeline.layout());
  vkCmdDraw(commands, 3, 1, 0, 0);
}

// Draws a float a pixel, 1 where the picture is empty.
void drawInto(VkCommandBuffer commands, const gpu::Image& light, const gpu::Target& target,
              const gpu::GraphicsPipeline& pipeline, const gpu::ImageSet& images,
              const shared::OcclusionPush& push) {
  constexpr VkImageLayout written = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  constexpr VkPipelineStageFlags2 writers = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  gpu::changeLayout(commands, {.image = light.handle(), .after = written, .to = writers});
  VkRenderingAttachmentInfo colour =
      gpu::attachment(light, written, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE);
  colour.clearValue.color.float32[0] = 1;
  const VkRenderingAttachmentInfo depth = gpu::attachment(
      target.readableDepth(), gpu::kReadDepthLayout, VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_STORE_OP_NONE);
  gpu::beginRendering(commands, light.size(), &colour, &depth);
  target.setViewport(commands);
  draw(commands, pipeline, images, push);
  vkCmdEndRendering(commands);
  gpu::changeLayout(commands, {.image = light.handle(),
                               .before = written,
                               .after = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                               .from = writers,
                               .to = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT});
}

}  // namespace

shared::OcclusionPush occlusionConstants(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                         float reach, float strength) {
  shared::OcclusionPush push{};
  push.width = width;
  push.height = height;
  push.reach = reach;
  push.strength = strength;
  const float aspect = float(width) / float(height);
  const bool flat = camera.orthographicHeight > 0;
  const float top = flat ? camera.orthographicHeight / 2 : std::tan(camera.verticalAngle / 2);
  push.corner = {-top * aspect, top};
  push.step = {2 * top / float(height), -2 * top / float(height)};
  push.perspective = flat ? 0.0f : 1.0f;
  const float range = camera.farDistance - camera.nearDistance;
  push.fromDepth = flat ? vec4(camera.farDistance, -range, 1, 0) : vec4(camera.nearDistance, 0, 0, 1);
  return push;
}

OcclusionPass::Images::Images(gpu::Device& device, const gpu::Target& target)
    : raw(makeLight(device, "occlusion, raw", target)),
      light(makeLight(device, "occlusion", target)),
      find(device, "depth", {&target.readableDepth()}),
      smooth(device, "depth and raw occlusion", {&target.readableDepth(), &raw}),
      apply(device, "occlusion", {&light}) {}

OcclusionPass::OcclusionPass(gpu::Device& device, const gpu::Target& target)
    : images_(device, target),
      find_(device, intoLight(spirv::occlusion_frag, images_.find, target.spec(), images_.raw)),
      smooth_(device, intoLight(spirv::smooth_frag, images_.smooth, target.spec(), images_.light)),
      apply_(device, ontoPicture(images_.apply, target.spec())) {}

// Set layouts made alike are compatible with those that the pipelines were made with.
void OcclusionPass::resize(gpu::Device& device, const gpu::Target& target) {
  images_ = Images(device, target);
}

void OcclusionPass::record(VkCommandBuffer commands, const gpu::Target& target, const Camera& camera,
                           float reach, float strength) const {
  const VkExtent2D size = target.spec().size;
  const shared::OcclusionPush push = occlusionConstants(camera, size.width, size.height, reach, strength);
  target.makeDepthReadable(commands);
  drawInto(commands, images_.raw, target, find_, images_.find, push);
  drawInto(commands, images_.light, target, smooth_, images_.smooth, push);
  target.makeDepthWritable(commands);
  target.begin(commands, {}, 0, gpu::Stretch::middle);
  draw(commands, apply_, images_.apply, push);
  target.pause(commands);
}

}  // namespace vasa
