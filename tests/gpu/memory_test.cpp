#include "gpu/memory.h"

#include <doctest/doctest.h>

using namespace vasa;

namespace {

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
constexpr VkMemoryPropertyFlags kCoherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

VkPhysicalDeviceMemoryProperties machine(std::initializer_list<VkMemoryPropertyFlags> types) {
  VkPhysicalDeviceMemoryProperties memory{};
  for (VkMemoryPropertyFlags flags : types)
    memory.memoryTypes[memory.memoryTypeCount++].propertyFlags = flags;
  return memory;
}

// The tables that drivers show, shortened to the types that differ.
const auto kSoftware = machine({kLocal | kVisible | kCoherent | kCached});
const auto kDiscrete =
    machine({0, kLocal, kVisible | kCoherent, kVisible | kCoherent | kCached, kLocal | kVisible | kCoherent});
const auto kDiscreteAmd = machine(
    {kLocal, kVisible | kCoherent, kLocal | kVisible | kCoherent, kVisible | kCoherent | kCached,
     kLocal | VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD | VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD});
const auto kMobile =
    machine({kLocal | kVisible | kCached, kLocal | kVisible | kCoherent,
             kLocal | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, kLocal | VK_MEMORY_PROPERTY_PROTECTED_BIT});

std::uint32_t best(const VkPhysicalDeviceMemoryProperties& memory, gpu::MemoryRole role,
                   std::uint32_t bits = ~0u) {
  const auto ranked = gpu::rankMemoryTypes(memory, bits, role);
  REQUIRE(!ranked.empty());
  return ranked.front();
}

}  // namespace

TEST_CASE("one memory type serves every role") {
  for (const auto role : {gpu::MemoryRole::device, gpu::MemoryRole::upload, gpu::MemoryRole::readBack})
    CHECK(best(kSoftware, role) == 0);
}

TEST_CASE("on a discrete device each role has its own memory") {
  CHECK(best(kDiscrete, gpu::MemoryRole::device) == 1);
  CHECK(best(kDiscrete, gpu::MemoryRole::upload) == 2);
  CHECK(best(kDiscrete, gpu::MemoryRole::readBack) == 3);
  CHECK(best(kDiscreteAmd, gpu::MemoryRole::device) == 0);
  CHECK(best(kDiscreteAmd, gpu::MemoryRole::upload) == 1);
  CHECK(best(kDiscreteAmd, gpu::MemoryRole::readBack) == 3);
}

TEST_CASE("what a resource may use decides first") {
  CHECK(best(kDiscrete, gpu::MemoryRole::device, 1u << 4 | 1u << 2) == 4);  // local beats hidden
  CHECK(best(kDiscrete, gpu::MemoryRole::device, 1u << 0 | 1u << 2) == 0);
  CHECK(best(kDiscrete, gpu::MemoryRole::upload, 1u << 4) == 4);
  CHECK(gpu::rankMemoryTypes(kDiscrete, 1u << 1, gpu::MemoryRole::upload).empty());
  CHECK(gpu::rankMemoryTypes(kDiscrete, 0, gpu::MemoryRole::device).empty());
}

TEST_CASE("a full heap has a next choice, and every choice the host needs is visible") {
  CHECK(gpu::rankMemoryTypes(kDiscrete, ~0u, gpu::MemoryRole::device) ==
        std::vector<std::uint32_t>{1, 4, 0, 2, 3});
  for (const std::uint32_t type : gpu::rankMemoryTypes(kDiscrete, ~0u, gpu::MemoryRole::readBack))
    CHECK((kDiscrete.memoryTypes[type].propertyFlags & kVisible) != 0);
}

TEST_CASE("memory without coherence is taken where it is better, special memory never") {
  CHECK(best(kMobile, gpu::MemoryRole::readBack) == 0);  // cached, invalidated before reading
  CHECK(best(kMobile, gpu::MemoryRole::upload) == 1);
  CHECK(gpu::rankMemoryTypes(kMobile, ~0u, gpu::MemoryRole::device) == std::vector<std::uint32_t>{0, 1});
}
