#pragma once
#include <vulkan/vulkan.h>

#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace vasa::gpu {

/// Which buffer an address lies in. Kept while accesses by address are checked, see address_shadow.h.
class AddressMap {
 public:
  struct Place {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize bytes = 0;  ///< of the whole buffer
  };

  /// The entry lives as long as what is returned, which must not outlive the map.
  [[nodiscard]] std::shared_ptr<void> add(VkDeviceAddress address, VkDeviceSize bytes, VkBuffer buffer) {
    entries_[address] = {buffer, 0, bytes};
    return {this, [address, bytes](AddressMap* map) {
              map->entries_.erase(address);
              map->wrote_.erase(map->wrote_.lower_bound(address), map->wrote_.lower_bound(address + bytes));
            }};
  }

  /// Notes the latest access of a shadow at an address and tells whether the one before it wrote.
  bool wroteBefore(VkDeviceAddress address, bool writesNow) {
    bool& wrote = wrote_[address];
    return std::exchange(wrote, writesNow);
  }

  std::optional<Place> find(VkDeviceAddress address) const {
    auto after = entries_.upper_bound(address);
    if (after == entries_.begin()) return std::nullopt;
    const auto& [start, entry] = *--after;
    if (address - start >= entry.bytes) return std::nullopt;
    return Place{entry.buffer, address - start, entry.bytes};
  }

 private:
  std::map<VkDeviceAddress, Place> entries_;
  std::map<VkDeviceAddress, bool> wrote_;
};

}  // namespace vasa::gpu
