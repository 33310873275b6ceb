#include <doctest/doctest.h>

#include "gpu/error.h"
#include "gpu/gpu_rig.h"
#include "gpu/instance.h"

using namespace vasa;

namespace {

// A program of its own: an instance under validation and a device with one queue.
struct Host {
  gpu::Instance instance{gpu::InstanceOptions{{.core = true}, {}}};
  gpu::ForeignDevice foreign;

  explicit Host(bool without = false) {
    foreign.instance = instance.handle();
    foreign.physical = gpu::physicalDevices(instance.handle()).front();
    foreign.queueFamily = gpu::describe(foreign.physical, 0).queueFamily;
    gpu::Features offered;
    vkGetPhysicalDeviceFeatures2(foreign.physical, offered.chain());
    foreign.enabled = gpu::featuresToEnable(offered);
    if (without) foreign.enabled.v12.timelineSemaphore = foreign.enabled.v13.maintenance4 = VK_FALSE;
    const float priority = 1;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = foreign.queueFamily;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = foreign.enabled.chain();
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    gpu::check(vkCreateDevice(foreign.physical, &info, nullptr, &foreign.device), "vkCreateDevice");
    vkGetDeviceQueue(foreign.device, foreign.queueFamily, 0, &foreign.queue);
  }
  ~Host() { vkDestroyDevice(foreign.device, nullptr); }
};

}  // namespace

TEST_CASE("another program's device is used and left as it was") {
  if (!test::vulkanAvailable()) return;
  std::shared_ptr<const gpu::ValidationLog> log;
  {
    Host host;
    log = host.instance.validationLog();
    for (int twice = 0; twice < 2; ++twice) {
      gpu::Device device(host.foreign);
      CHECK(device.handle() == host.foreign.device);
      CHECK(device.queue().handle() == host.foreign.queue);
      CHECK(device.limits().maxPushConstantsSize >= 128);
      const std::vector<std::uint32_t> sent{1, 2, 3};
      const gpu::Buffer buffer = gpu::makeBuffer(device, "sent", std::span<const std::uint32_t>(sent));
      CHECK(test::download<std::uint32_t>(device, buffer) == sent);
    }
    CHECK(vkQueueWaitIdle(host.foreign.queue) == VK_SUCCESS);  // still alive
  }
  CHECK(test::joined(log->messages()) == "");
}

TEST_CASE("a device without what vasa needs is refused, with the list") {
  if (!test::vulkanAvailable()) return;
  Host host(true);
  const auto made = gpu::attempt([&] { gpu::Device device(host.foreign); });
  REQUIRE(!made.ok());
  CHECK(made.error().fault == Fault::noDevice);
  CHECK(made.error().message.find(
            "lacks timelineSemaphore switched on, maintenance4 switched on; create it with") !=
        std::string::npos);
}
