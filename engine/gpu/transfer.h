#pragma once
#include <cstddef>
#include <span>

#include "gpu/buffer.h"

namespace vasa::gpu {

class Device;

/// Copies through a staging buffer and waits: for loading, not for frames.
void uploadBytes(Device& device, const Buffer& to, std::span<const std::byte> bytes, VkDeviceSize offset = 0);

/// A device buffer that holds `values`.
template <class T>
Buffer makeBuffer(Device& device, const char* name, std::span<const T> values) {
  Buffer buffer(device, {name, values.size_bytes()});
  uploadBytes(device, buffer, std::as_bytes(values));
  return buffer;
}

}  // namespace vasa::gpu
