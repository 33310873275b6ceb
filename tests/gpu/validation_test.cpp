// Each test plants a fault and expects the validation layer to see it, on a device of its own: what the other
// tests expect to be absent is really looked for.
#include <doctest/doctest.h>

#include "gpu/barrier.h"
#include "gpu/error.h"
#include "gpu/gpu_rig.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/target.h"
#include "scale_push.h"
#include "spirv/scale_comp.h"
#include "spirv/triangle_frag.h"
#include "spirv/triangle_vert.h"

using namespace vasa;

namespace {

constexpr std::uint32_t kCount = 100, kGroup = 32;

struct Bench {
  gpu::Device device;
  gpu::Buffer floats, arguments;
  gpu::ComputePipeline pipeline;

  explicit Bench(gpu::Validation validation, std::uint32_t overrun = 0)
      : device({.choice = {}, .validation = validation, .instanceExtensions = {}, .deviceExtensions = {}}) {
    const std::vector<float> ones(kCount, 1.0f);
    const std::vector<std::uint32_t> groups{gpu::groupsFor(kCount, kGroup), 1, 1};
    floats = gpu::makeBuffer(device, "floats", std::span(ones));
    arguments = gpu::makeBuffer(device, "arguments", std::span(groups));
    gpu::ComputeSpec spec{spirv::scale_comp, sizeof(test::ScalePush), {}, {}};
    spec.constants.set(0, kGroup).set(2, overrun);
    pipeline = gpu::ComputePipeline(device, spec);
  }

  void scale(VkCommandBuffer commands) const {
    pipeline.dispatch(commands, test::ScalePush{floats.address(), kCount}, gpu::groupsFor(kCount, kGroup));
  }

  template <class Record>
  std::string messagesOf(Record&& record) {
    gpu::Commands commands = device.queue().begin("planted");
    record(static_cast<VkCommandBuffer>(commands));
    device.queue().wait(device.queue().submit(std::move(commands)));
    return test::joined(device.validationMessages());
  }
};

// A buffer with memory behind its end: a planted write there must not harm the process.
struct RoomyBuffer {
  gpu::Unique<VkDeviceMemory> memory;
  gpu::Unique<VkBuffer> buffer;
  VkDeviceAddress address = 0;

  RoomyBuffer(gpu::Device& device, VkDeviceSize bytes) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    VkBuffer made = VK_NULL_HANDLE;
    gpu::check(vkCreateBuffer(device.handle(), &info, nullptr, &made), "vkCreateBuffer");
    buffer = {device.handle(), made};
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.handle(), made, &needs);
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    const auto types = gpu::rankMemoryTypes(device.memory(), needs.memoryTypeBits, gpu::MemoryRole::device);
    const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags, needs.size + 4096,
                                        types.at(0)};
    VkDeviceMemory allocated = VK_NULL_HANDLE;
    gpu::check(vkAllocateMemory(device.handle(), &allocate, nullptr, &allocated), "vkAllocateMemory");
    memory = {device.handle(), allocated};
    gpu::check(vkBindBufferMemory(device.handle(), made, allocated, 0), "vkBindBufferMemory");
    const VkBufferDeviceAddressInfo where{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, made};
    address = vkGetBufferDeviceAddress(device.handle(), &where);
  }
};

constexpr gpu::Validation kSynchronization{.synchronization = true};

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

// Synchronization validation sees passes that use addresses through VK_KHR_push_descriptor
// (gpu/address_shadow.h).
bool followsAddresses(gpu::Device& device) {
  if (device.addresses()) return true;
  MESSAGE("not tried: this driver lacks VK_KHR_push_descriptor");
  return false;
}

}  // namespace

TEST_CASE("a barrier left out between two compute passes is reported, by address too") {
  VASA_REQUIRE_GPU(rig);
  if (!followsAddresses(rig.device())) return;
  Bench bench(kSynchronization);
  const std::string correct = bench.messagesOf([&](VkCommandBuffer commands) {
    bench.scale(commands);
    gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute);
    bench.scale(commands);
  });
  CHECK_MESSAGE(correct.empty(), correct);
  const std::string planted = bench.messagesOf([&](VkCommandBuffer commands) {
    bench.scale(commands);
    bench.scale(commands);
  });
  CHECK_MESSAGE(contains(planted, "SYNC-HAZARD-READ-AFTER-WRITE"), planted);
  CHECK_MESSAGE(contains(planted, "[floats]"), planted);
}

TEST_CASE("a barrier left out between a compute pass and a copy or an indirect dispatch is reported") {
  VASA_REQUIRE_GPU(rig);
  if (!followsAddresses(rig.device())) return;
  Bench copies(kSynchronization);
  const std::string copied = copies.messagesOf([&](VkCommandBuffer commands) {
    copies.scale(commands);
    const VkBufferCopy region{0, 0, 12};
    vkCmdCopyBuffer(commands, copies.floats.handle(), copies.arguments.handle(), 1, &region);
  });
  CHECK_MESSAGE(contains(copied, "SYNC-HAZARD-READ-AFTER-WRITE"), copied);

  Bench indirect(kSynchronization);
  const std::string dispatched = indirect.messagesOf([&](VkCommandBuffer commands) {
    // The pass scales the arguments of the next one as if they were floats.
    indirect.pipeline.dispatch(commands, test::ScalePush{indirect.arguments.address(), 0}, 1);
    indirect.pipeline.dispatchIndirect(commands, test::ScalePush{indirect.floats.address(), kCount},
                                       indirect.arguments);
  });
  CHECK_MESSAGE(contains(dispatched, "vkCmdDispatchIndirect: Hazard READ_AFTER_WRITE"), dispatched);
}

TEST_CASE("a barrier left out between a compute pass and a draw is reported") {
  VASA_REQUIRE_GPU(rig);
  if (!followsAddresses(rig.device())) return;
  Bench bench(kSynchronization);
  struct Push {
    std::uint64_t corners;
    alignas(16) float colour[4];
  };
  const gpu::Target target(bench.device,
                           {.name = "target", .size = {8, 8}, .samples = VK_SAMPLE_COUNT_1_BIT});
  const gpu::GraphicsPipeline pipeline(bench.device, {.name = "triangle",
                                                      .vertex = spirv::triangle_vert,
                                                      .fragment = spirv::triangle_frag,
                                                      .pushBytes = sizeof(Push)});
  const std::vector<std::uint32_t> zeros(3, 0);
  const gpu::Buffer indices = gpu::makeBuffer(bench.device, "indices", std::span(zeros));
  const auto draw = [&](bool barrier) {
    return bench.messagesOf([&](VkCommandBuffer commands) {
      bench.pipeline.dispatch(commands, test::ScalePush{indices.address(), 3}, 1);
      if (barrier) gpu::stageBarrier(commands, gpu::kCompute, VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT);
      target.begin(commands, {0, 0, 0, 1});
      pipeline.bind(commands, Push{bench.floats.address(), {1, 1, 1, 1}});
      vkCmdBindIndexBuffer(commands, indices.handle(), 0, VK_INDEX_TYPE_UINT32);
      vkCmdDrawIndexed(commands, 3, 1, 0, 0, 0);
      target.end(commands);
    });
  };
  const std::string correct = draw(true);
  CHECK_MESSAGE(correct.empty(), correct);
  const std::string planted = draw(false);
  CHECK_MESSAGE(contains(planted, "vkCmdDrawIndexed: Hazard READ_AFTER_WRITE for index"), planted);
}

TEST_CASE("a write behind the end of a buffer is reported with its invocation") {
  VASA_REQUIRE_GPU(rig);
  if (!rig.device().features().core.features.shaderInt64) {
    MESSAGE(
        "not tried: GPU-assisted validation looks at addresses with shaderInt64, which this driver lacks");
    return;
  }
  Bench bench({.gpuAssisted = true}, 1);
  const RoomyBuffer roomy(bench.device, kCount * sizeof(float));
  const auto scaleRoomy = [&](std::uint32_t count) {
    return bench.messagesOf([&](VkCommandBuffer commands) {
      bench.pipeline.dispatch(commands, test::ScalePush{roomy.address, count},
                              gpu::groupsFor(kCount, kGroup));
    });
  };
  const std::string correct = scaleRoomy(kCount - 1);
  CHECK_MESSAGE(correct.empty(), correct);
  const std::string planted = scaleRoomy(kCount);
  CHECK_MESSAGE(contains(planted, "access out of bounds"), planted);
  CHECK_MESSAGE(contains(planted, "Global invocation ID (x, y, z) = (100, 0, 0 )"), planted);
}

TEST_CASE("an object left behind is reported when the device goes") {
  VASA_REQUIRE_GPU(rig);
  std::shared_ptr<const gpu::ValidationLog> log;
  {
    gpu::Device device(
        {.choice = {}, .validation = {.core = true}, .instanceExtensions = {}, .deviceExtensions = {}});
    log = device.validationLog();
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence = VK_NULL_HANDLE;
    REQUIRE(vkCreateFence(device.handle(), &info, nullptr, &fence) == VK_SUCCESS);
  }
  CHECK(contains(test::joined(log->messages()), "has not been destroyed"));
}
