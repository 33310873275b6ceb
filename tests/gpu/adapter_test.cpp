#include "gpu/adapter.h"

#include <doctest/doctest.h>

#include "gpu/error.h"
#include "gpu/gpu_rig.h"

using namespace vasa;

namespace {

gpu::Adapter adapter(std::uint32_t index, const char* name, VkPhysicalDeviceType type,
                     std::vector<std::string> lacks = {}) {
  gpu::Adapter made;
  made.index = index;
  made.name = name;
  made.type = type;
  made.lacks = std::move(lacks);
  return made;
}

const std::vector<gpu::Adapter> kMachine{
    adapter(0, "llvmpipe (LLVM 15)", VK_PHYSICAL_DEVICE_TYPE_CPU),
    adapter(1, "Old Board 9", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, {"dynamicRendering", "Vulkan 1.3"}),
    adapter(2, "Board 10", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
    adapter(3, "Cloud Board", VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU),
};

}  // namespace

TEST_CASE("without a choice the best type that is usable wins") {
  CHECK(gpu::chooseAdapter(kMachine, "") == 2);
  auto machine = kMachine;
  machine[1].lacks.clear();
  CHECK(gpu::chooseAdapter(machine, "") == 1);
  const std::vector<gpu::Adapter> twins{adapter(0, "A", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
                                        adapter(1, "B", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU)};
  CHECK(gpu::chooseAdapter(twins, "") == 0);
}

TEST_CASE("a device is chosen by index or by a part of its name in any case") {
  CHECK(gpu::chooseAdapter(kMachine, "0") == 0);
  CHECK(gpu::chooseAdapter(kMachine, "3") == 3);
  CHECK(gpu::chooseAdapter(kMachine, "LLVM") == 0);
  CHECK(gpu::chooseAdapter(kMachine, "board") == 2);  // of three, the best usable one
  CHECK(gpu::chooseAdapter(kMachine, "cloud") == 3);
}

TEST_CASE("a choice that cannot be met says what there is") {
  CHECK_THROWS_WITH_AS(gpu::chooseAdapter(kMachine, "radeon"),
                       "no Vulkan device matches --device radeon; there is 0 = llvmpipe (LLVM 15), "
                       "1 = Old Board 9, 2 = Board 10, 3 = Cloud Board",
                       gpu::Error);
  CHECK_THROWS_AS(gpu::chooseAdapter(kMachine, "10"), gpu::Error);  // an index, not a part of "Board 10"
  CHECK_THROWS_WITH_AS(
      gpu::chooseAdapter(kMachine, "old"),
      "Vulkan device 1 (Old Board 9) lacks dynamicRendering, Vulkan 1.3; update its driver or "
      "choose another device (vasa devices lists them)",
      gpu::Error);
  try {
    (void)gpu::chooseAdapter(kMachine, "1");
    FAIL("a device that lacks something was taken");
  } catch (const gpu::Error& error) {
    CHECK(error.fault() == Fault::noDevice);
  }
}

TEST_CASE("types have the names that reports use") {
  CHECK(std::string(gpu::typeName(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU)) == "discrete");
  CHECK(std::string(gpu::typeName(VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU)) == "integrated");
  CHECK(std::string(gpu::typeName(VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU)) == "virtual");
  CHECK(std::string(gpu::typeName(VK_PHYSICAL_DEVICE_TYPE_CPU)) == "cpu");
  CHECK(std::string(gpu::typeName(VK_PHYSICAL_DEVICE_TYPE_OTHER)) == "other");
}

TEST_CASE("a device that is not there cannot be made") {
  VASA_REQUIRE_GPU(rig);
  const auto made = gpu::attempt([] {
    gpu::Device device(
        {.choice = "no such card", .validation = {}, .instanceExtensions = {}, .deviceExtensions = {}});
  });
  REQUIRE(!made.ok());
  CHECK(made.error().fault == Fault::noDevice);
}

TEST_CASE("the devices of this machine are described in full") {
  VASA_REQUIRE_GPU(rig);
  const auto adapters = gpu::listAdapters();
  REQUIRE(!adapters.empty());
  bool anyUsable = false;
  for (const gpu::Adapter& found : adapters) {
    CHECK(!found.name.empty());
    CHECK(found.api.starts_with("1."));
    CHECK(!found.driver.empty());
    anyUsable = anyUsable || found.usable();
  }
  CHECK(anyUsable);
}
