#include "gpu/pipeline_store.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "core/hash.h"
#include "core/kept.h"
#include "gpu/error.h"

namespace vasa::gpu {
namespace {

constexpr const char* kKind = "pipelines";

VkPipelineCache create(VkDevice device, std::span<const std::byte> bytes, VkResult& result) {
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = bytes.size();
  info.pInitialData = bytes.data();
  VkPipelineCache cache = VK_NULL_HANDLE;
  result = vkCreatePipelineCache(device, &info, nullptr, &cache);
  return cache;
}

}  // namespace

std::uint64_t pipelineKey(const VkPhysicalDeviceProperties& properties) {
  const std::uint32_t numbers[] = {properties.vendorID, properties.deviceID, properties.driverVersion};
  return hashOf(std::span<const std::uint8_t>(properties.pipelineCacheUUID),
                hashOf(std::span<const std::uint32_t>(numbers)));
}

bool isCacheOf(std::span<const std::byte> bytes, const VkPhysicalDeviceProperties& properties) {
  VkPipelineCacheHeaderVersionOne header;
  if (bytes.size() < sizeof header) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  return header.headerSize >= sizeof header && header.headerSize < bytes.size() &&
         header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
         std::ranges::equal(header.pipelineCacheUUID, properties.pipelineCacheUUID);
}

PipelineStore::PipelineStore(VkDevice device, const VkPhysicalDeviceProperties& properties)
    : properties_(properties), device_(device) {
  auto kept = findKept(kKind, pipelineKey(properties));
  if (kept && !isCacheOf(*kept, properties)) kept.reset();
  VkResult result = VK_SUCCESS;
  VkPipelineCache cache = VK_NULL_HANDLE;
  if (kept) {
    cache = create(device, *kept, result);
    if (result == VK_SUCCESS) found_ = hashBytes(*kept);
  }
  if (!kept || result != VK_SUCCESS) cache = create(device, {}, result);
  check(result, "vkCreatePipelineCache");
  cache_ = {device, cache};
}

void PipelineStore::keep() const {
  if (!cache_.get()) return;
  std::size_t size = 0;
  if (vkGetPipelineCacheData(device_, handle(), &size, nullptr) != VK_SUCCESS) return;
  std::vector<std::byte> bytes(size);
  if (vkGetPipelineCacheData(device_, handle(), &size, bytes.data()) != VK_SUCCESS) return;
  bytes.resize(size);
  if (isCacheOf(bytes, properties_) && hashBytes(bytes) != found_)
    vasa::keep(kKind, pipelineKey(properties_), bytes);
}

}  // namespace vasa::gpu
