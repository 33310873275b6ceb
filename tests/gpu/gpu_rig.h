#pragma once
#include <doctest/doctest.h>

#include <span>
#include <vector>

#include "gpu/compute_pipeline.h"
#include "gpu/device.h"
#include "gpu/transfer.h"

namespace vasa::test {

/// False where there is no Vulkan device and the user allowed that with VASA_ALLOW_NO_VULKAN=1. Without that
/// leave a missing device fails the test case, and so does a missing validation layer.
bool vulkanAvailable();

/// Everything that a buffer of any role holds.
void downloadBytes(gpu::Device& device, const gpu::Buffer& from, std::span<std::byte> bytes);
template <class T>
std::vector<T> download(gpu::Device& device, const gpu::Buffer& from) {
  std::vector<T> values(std::size_t(from.bytes() / sizeof(T)));
  downloadBytes(device, from, std::as_writable_bytes(std::span(values)));
  return values;
}

/// The process's one device with core and synchronization validation, for a test case. Fails the case if the
/// validation layer said anything while the rig was there. Objects left behind when the process ends fail
/// the process. VASA_TEST_DEVICE chooses the device as --device does. Mesa's shader cache is a temporary
/// folder of the process.
class GpuRig {
 public:
  GpuRig();
  ~GpuRig();
  GpuRig(const GpuRig&) = delete;
  GpuRig& operator=(const GpuRig&) = delete;

  gpu::Device& device() const { return device_; }

  template <class T>
  gpu::Buffer upload(const std::vector<T>& values) const {
    return gpu::makeBuffer(device_, "test input", std::span<const T>(values));
  }
  template <class T>
  std::vector<T> download(const gpu::Buffer& buffer) const {
    return test::download<T>(device_, buffer);
  }

  /// Records with `record(VkCommandBuffer)`, submits and waits.
  template <class Record>
  void run(Record&& record) const {
    gpu::Commands commands = device_.queue().begin("test");
    record(static_cast<VkCommandBuffer>(commands));
    device_.queue().wait(device_.queue().submit(std::move(commands)));
  }

 private:
  gpu::Device& device_;
  std::size_t messagesBefore_;
};

/// The messages of `device`, one a line.
std::string joined(const std::vector<std::string>& messages);

}  // namespace vasa::test

/// A GpuRig named `rig`, or an early return where a missing Vulkan device is allowed.
#define VASA_REQUIRE_GPU(rig)                                     \
  if (!::vasa::test::vulkanAvailable()) {                         \
    MESSAGE("skipped: no Vulkan device, VASA_ALLOW_NO_VULKAN=1"); \
    return;                                                       \
  }                                                               \
  const ::vasa::test::GpuRig rig
