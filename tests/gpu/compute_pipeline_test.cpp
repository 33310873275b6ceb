#include "gpu/compute_pipeline.h"

#include <doctest/doctest.h>

#include <numeric>

#include "gpu/barrier.h"
#include "gpu/error.h"
#include "gpu/gpu_rig.h"
#include "scale_push.h"
#include "spirv/count_loops_comp.h"
#include "spirv/scale_comp.h"

using namespace vasa;

namespace {

gpu::ComputePipeline scaler(gpu::Device& device, std::uint32_t groupSize, float factor) {
  gpu::ComputeSpec spec{spirv::scale_comp, sizeof(test::ScalePush), {}, {}};
  spec.constants.set(0, groupSize).set(1, factor);
  return {device, spec};
}

std::vector<float> ramp(std::size_t count) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 1.0f);
  return values;
}

}  // namespace

TEST_CASE("groupsFor covers every item once") {
  CHECK(gpu::groupsFor(0, 64) == 0);
  CHECK(gpu::groupsFor(1, 64) == 1);
  CHECK(gpu::groupsFor(64, 64) == 1);
  CHECK(gpu::groupsFor(65, 64) == 2);
  CHECK(gpu::groupsFor(0xffffffffu, 1) == 0xffffffffu);
}

TEST_CASE("a shader reads and writes a buffer by its address, with specialised constants") {
  VASA_REQUIRE_GPU(rig);
  for (const std::uint32_t count : {1u, 63u, 64u, 1000u}) {
    const auto values = ramp(count);
    const gpu::Buffer buffer = rig.upload(values);
    const gpu::ComputePipeline pipeline = scaler(rig.device(), 64, 3.0f);
    rig.run([&](VkCommandBuffer commands) {
      pipeline.dispatch(commands, test::ScalePush{buffer.address(), count}, gpu::groupsFor(count, 64));
    });
    const auto scaled = rig.download<float>(buffer);
    REQUIRE(scaled.size() == count);
    for (std::uint32_t i = 0; i < count; ++i) CHECK(scaled[i] == 3.0f * values[i]);
  }
}

TEST_CASE("passes in one command buffer see each other's results across a barrier") {
  VASA_REQUIRE_GPU(rig);
  const gpu::Buffer buffer = rig.upload(ramp(100));
  const gpu::ComputePipeline pipeline = scaler(rig.device(), 32, 2.0f);
  const test::ScalePush push{buffer.address(), 100};
  rig.run([&](VkCommandBuffer commands) {
    pipeline.dispatch(commands, push, 4);
    gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                      VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
    pipeline.dispatch(commands, push, 4);
  });
  CHECK(rig.download<float>(buffer)[99] == 400.0f);
}

TEST_CASE("an indirect dispatch takes its size from a buffer") {
  VASA_REQUIRE_GPU(rig);
  const gpu::Buffer buffer = rig.upload(ramp(100));
  const gpu::Buffer arguments = rig.upload(std::vector<std::uint32_t>{9, 9, 9, 4, 1, 1});
  const gpu::ComputePipeline pipeline = scaler(rig.device(), 32, 2.0f);
  rig.run([&](VkCommandBuffer commands) {
    pipeline.dispatchIndirect(commands, test::ScalePush{buffer.address(), 100}, arguments, 12);
  });
  CHECK(rig.download<float>(buffer)[99] == 200.0f);
}

TEST_CASE("nothing is dispatched for nothing, and too many groups are refused") {
  VASA_REQUIRE_GPU(rig);
  const gpu::Buffer buffer = rig.upload(ramp(4));
  const gpu::ComputePipeline pipeline = scaler(rig.device(), 32, 2.0f);
  const test::ScalePush push{buffer.address(), 4};
  rig.run([&](VkCommandBuffer commands) {
    pipeline.dispatch(commands, push, 0);
    CHECK_THROWS_WITH_AS(pipeline.dispatch(commands, push, 1, 0xffffffffu),
                         doctest::Contains("scale.comp: 4294967295 workgroups, more than the "), gpu::Error);
  });
  CHECK(rig.download<float>(buffer) == ramp(4));
}

TEST_CASE("push constants over the device's limit are refused") {
  VASA_REQUIRE_GPU(rig);
  const std::uint32_t most = rig.device().limits().maxPushConstantsSize;
  REQUIRE(most >= gpu::kMaxPushBytes);
  CHECK_THROWS_WITH_AS(gpu::makePipelineLayout(rig.device(), "big", VK_SHADER_STAGE_COMPUTE_BIT, most + 4),
                       doctest::Contains("bytes of push constants, more than the"), gpu::Error);
}

TEST_CASE("all iterations that a shader may make are made") {
  // Loops of one invocation end silently after 65,535 iterations on lavapipe; the engine's shaders stay
  // under 30,000, which must be safe on every device.
  VASA_REQUIRE_GPU(rig);
  struct Push {
    std::uint64_t counted;
    std::uint32_t wanted;
    std::uint32_t unused;
  };
  const gpu::ComputePipeline pipeline(rig.device(), {spirv::count_loops_comp, sizeof(Push), {}, {}});
  const auto made = [&](std::uint32_t wanted) {
    const gpu::Buffer counted = rig.upload(std::vector<std::uint32_t>{0});
    rig.run([&](VkCommandBuffer commands) {
      pipeline.dispatch(commands, Push{counted.address(), wanted, 0}, 1);
    });
    return rig.download<std::uint32_t>(counted)[0];
  };
  CHECK(made(30'000) == 30'000);
  if (rig.device().isCpu()) MESSAGE("of 100,000 iterations this device makes " << made(100'000));
}
