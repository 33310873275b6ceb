#pragma once
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "gpu/buffer.h"

namespace vasa::gpu {

class Device;

/// Copies through a staging buffer and waits: for loading and for tests, not for frames.
void uploadBytes(Device& device, const Buffer& to, std::span<const std::byte> bytes, VkDeviceSize offset = 0);
void downloadBytes(Device& device, const Buffer& from, std::span<std::byte> bytes, VkDeviceSize offset = 0);

/// A device buffer that holds `values`.
template <class T>
Buffer makeBuffer(Device& device, const char* name, std::span<const T> values) {
  Buffer buffer(device, {name, values.size_bytes()});
  uploadBytes(device, buffer, std::as_bytes(values));
  return buffer;
}

/// Everything that a buffer of any role holds.
template <class T>
std::vector<T> download(Device& device, const Buffer& from) {
  std::vector<T> values(std::size_t(from.bytes() / sizeof(T)));
  downloadBytes(device, from, std::as_writable_bytes(std::span(values)));
  return values;
}

}  // namespace vasa::gpu
