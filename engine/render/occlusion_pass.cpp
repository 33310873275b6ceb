#include "render/occlusion_pass.h"

#include <algorithm>

#include "gpu/barrier.h"
#include "spirv/occlude_frag.h"
#include "spirv/occlusion_comp.h"
#include "spirv/screen_vert.h"
#include "spirv/smooth_comp.h"

namespace vasa {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr std::uint32_t kGroup = 64;
constexpr std::uint32_t kMostAcross = 32768;  // workgroups; devices take at least 65535 in a direction

gpu::GraphicsPipeline applyPipeline(gpu::Device& device, const gpu::TargetSpec& target) {
  return {device,
          {.name = "occlusion",
           .vertex = spirv::screen_vert,
           .fragment = spirv::occlude_frag,
           .pushBytes = sizeof(shared::OcclusionPush),
           .colour = target.colour,
           .depth = target.depth,
           .samples = target.samples,
           .cull = VK_CULL_MODE_NONE,
           .depthTest = VK_COMPARE_OP_ALWAYS,
           .depthWrite = false,
           .blend = gpu::Blend::multiply}};
}

gpu::Buffer pixels(gpu::Device& device, const char* name, const gpu::Target& target) {
  return {device, {name, target.pictureBytes()}};
}

}  // namespace

OcclusionPass::OcclusionPass(gpu::Device& device, const gpu::Target& target)
    : find_(device, {spirv::occlusion_comp, sizeof(shared::OcclusionPush)}),
      smooth_(device, {spirv::smooth_comp, sizeof(shared::OcclusionPush)}),
      apply_(applyPipeline(device, target.spec())),
      depth_(pixels(device, "picture depth", target)),
      raw_(pixels(device, "occlusion, raw", target)),
      light_(pixels(device, "occlusion", target)) {}

void OcclusionPass::record(VkCommandBuffer commands, const gpu::Target& target, const Camera& camera, float reach,
                           float strength) const {
  gpu::stageBarrier(commands, kCompute | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_2_TRANSFER_BIT | kCompute);
  target.copyDepth(commands, depth_);
  gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_TRANSFER_BIT, kCompute);
  shared::OcclusionPush push = occlusionConstants(camera, target.spec().size.width, target.spec().size.height, reach, strength);
  const std::uint32_t groups = gpu::groupsFor(push.width * push.height, kGroup);
  const std::uint32_t across = std::min(groups, kMostAcross), down = gpu::groupsFor(groups, across);
  push.depth = depth_.address();
  push.raw = depth_.address();  // not read
  push.light = raw_.address();
  find_.dispatch(commands, push, across, down);
  gpu::stageBarrier(commands, kCompute, kCompute);
  push.raw = raw_.address();
  push.light = light_.address();
  smooth_.dispatch(commands, push, across, down);
  gpu::stageBarrier(commands, kCompute, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
}

void OcclusionPass::recordApply(VkCommandBuffer commands, const gpu::Target& target) const {
  shared::OcclusionPush push{};
  push.raw = light_.address();
  push.width = target.spec().size.width;
  push.height = target.spec().size.height;
  apply_.bind(commands, push);
  vkCmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace vasa
