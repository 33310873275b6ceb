#include "gpu/pipeline_store.h"

#include <cstring>

#include "core/kept.h"
#include "gpu/gpu_rig.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::gpu;

namespace {

VkPhysicalDeviceProperties someDevice() {
  VkPhysicalDeviceProperties properties{};
  properties.vendorID = 0x10de;
  properties.deviceID = 0x2204;
  properties.driverVersion = 7;
  for (std::size_t k = 0; k < VK_UUID_SIZE; ++k) properties.pipelineCacheUUID[k] = std::uint8_t(k + 1);
  return properties;
}

// As Vulkan lays it out: the header, then what only the driver understands.
std::vector<std::byte> cacheOf(const VkPhysicalDeviceProperties& properties, std::size_t more) {
  VkPipelineCacheHeaderVersionOne header{
      sizeof header, VK_PIPELINE_CACHE_HEADER_VERSION_ONE, properties.vendorID, properties.deviceID, {}};
  std::memcpy(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE);
  std::vector<std::byte> bytes(sizeof header + more, std::byte(0x5a));
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

}  // namespace

TEST_CASE(
    "a pipeline cache is taken for this device and driver's by its header, and only if there is more in it") {
  const VkPhysicalDeviceProperties own = someDevice();
  const std::vector<std::byte> whole = cacheOf(own, 100);
  CHECK(isCacheOf(whole, own));
  CHECK_FALSE(isCacheOf(cacheOf(own, 0), own));
  CHECK_FALSE(isCacheOf({}, own));
  CHECK_FALSE(isCacheOf(std::span(whole).first(31), own));
  for (const std::size_t at :
       {0, 4, 8, 12, 16, 31}) {  // size, version, vendor, device, both ends of the driver's print
    CAPTURE(at);
    std::vector<std::byte> other = whole;
    other[at] ^= std::byte(0x80);
    CHECK_FALSE(isCacheOf(other, own));
  }
}

TEST_CASE("each device and driver has a key of its own") {
  const VkPhysicalDeviceProperties own = someDevice();
  for (const int which : {0, 1, 2, 3}) {
    CAPTURE(which);
    VkPhysicalDeviceProperties other = own;
    ++(which == 0 ? other.vendorID : which == 1 ? other.deviceID : other.driverVersion);
    if (which == 3) other = own, ++other.pipelineCacheUUID[15];
    CHECK(pipelineKey(other) != pipelineKey(own));
  }
  CHECK(pipelineKey(someDevice()) == pipelineKey(own));
}

TEST_CASE(
    "whatever is kept, pipelines are made, and a driver that gives nothing but a header has nothing kept") {
  VASA_REQUIRE_GPU(rig);
  const test::TemporaryFolder folder;
  setKeptFolders({.shipped = {}, .own = folder.path(), .engine = 1});
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(rig.device().physical(), &properties);
  const std::uint64_t key = pipelineKey(properties);
  for (const auto& planted :
       {std::vector<std::byte>{}, std::vector<std::byte>(1000, std::byte(1)), cacheOf(someDevice(), 100)}) {
    CAPTURE(planted.size());
    vasa::keep("pipelines", key, planted);
    const PipelineStore store(rig.device().handle(), properties);
    CHECK(store.handle() != VK_NULL_HANDLE);
    store.keep();
    const auto kept = findKept("pipelines", key);
    REQUIRE(kept);
    std::size_t size = 0;
    REQUIRE(vkGetPipelineCacheData(rig.device().handle(), store.handle(), &size, nullptr) == VK_SUCCESS);
    if (size <= sizeof(VkPipelineCacheHeaderVersionOne))
      CHECK(*kept == planted);
    else
      CHECK(isCacheOf(*kept, properties));
  }
  setKeptFolders({});
}
