#pragma once
#include <vulkan/vulkan.h>

#include <cassert>
#include <memory>
#include <span>

#include "gpu/memory.h"
#include "gpu/queue.h"
#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

struct BufferSpec {
  const char* name = "buffer";
  VkDeviceSize bytes = 0;  ///< 0 is allowed: an empty buffer still has an address
  MemoryRole role = MemoryRole::device;
  VkBufferUsageFlags moreUsage = 0;  ///< beside storage, address, copy, index and indirect, which all have
};

/// A range of memory that shaders reach by address. Roles: see memory.h. Waits for the queue before it goes.
class Buffer {
 public:
  Buffer() = default;
  /// Throws Error if the size is over the device's storage range (128 MiB on lavapipe) or memory is spent.
  Buffer(Device& device, const BufferSpec& spec);

  VkBuffer handle() const { return buffer_.get(); }
  VkDeviceSize bytes() const { return bytes_; }
  VkDeviceSize allocated() const { return memory_.bytes(); }  ///< at least bytes(): in the device's own steps
  explicit operator bool() const { return bool(buffer_); }
  /// For push constants; a multiple of 16.
  VkDeviceAddress address() const { return address_; }

  /// Copies into a buffer of MemoryRole::upload and flushes. The device must not be reading the range.
  template <class T>
  void write(std::span<const T> values, VkDeviceSize offset = 0) {
    writeBytes(values.data(), values.size_bytes(), offset);
  }
  /// Copies out of a buffer of MemoryRole::readBack, after the ticket of what wrote it is done.
  template <class T>
  void read(std::span<T> values, VkDeviceSize offset = 0) const {
    readBytes(values.data(), values.size_bytes(), offset);
  }

  /// The memory itself of the upload and read-back roles. Pair writing with flush(), reading with
  /// invalidate() before.
  template <class T>
  std::span<T> mapped() const {
    assert(memory_.mapped());
    return {reinterpret_cast<T*>(memory_.mapped()), std::size_t(bytes_ / sizeof(T))};
  }
  void flush() const { memory_.flush(0, bytes_); }
  void invalidate() const { memory_.invalidate(0, bytes_); }

 private:
  void writeBytes(const void* data, std::size_t bytes, VkDeviceSize offset);
  void readBytes(void* data, std::size_t bytes, VkDeviceSize offset) const;

  std::shared_ptr<void> known_;  // the entry of the device's address map
  Memory memory_;
  Unique<VkBuffer> buffer_;
  VkDeviceSize bytes_ = 0;
  VkDeviceAddress address_ = 0;
  Settled settled_;
};

}  // namespace vasa::gpu
