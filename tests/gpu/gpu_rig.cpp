#include "gpu_rig.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>

#include "gpu/error.h"
#include "support/shared_data.h"

namespace vasa::test {
namespace {

// Made on first use, destroyed with the process's static objects; what the layer says then, of objects left
// behind, can only be told by the exit status.
class ProcessDevice {
 public:
  ProcessDevice() {
    setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1);
    gpu::DeviceOptions options;
    options.validation = {.core = true, .synchronization = true};
    if (const char* choice = std::getenv("VASA_TEST_DEVICE")) options.choice = choice;
    try {
      device_.emplace(options);
    } catch (const gpu::Error& error) {
      error_ = error.error();
    }
  }
  ~ProcessDevice() {
    if (!device_) return;
    const auto log = device_->validationLog();
    const std::size_t before = log->messages().size();
    device_.reset();
    const auto messages = log->messages();
    for (std::size_t i = before; i < messages.size(); ++i)
      std::fprintf(stderr, "while the device went: %s\n", messages[i].c_str());
    std::fflush(nullptr);
    if (messages.size() > before) std::_Exit(1);
  }

  gpu::Device* device() { return device_ ? &*device_ : nullptr; }
  const vasa::Error& error() const { return error_; }

 private:
  TemporaryFolder cache_;
  std::optional<gpu::Device> device_;
  vasa::Error error_;
};

ProcessDevice& processDevice() {
  static ProcessDevice device;
  return device;
}

bool mayLackVulkan() {
  const char* set = std::getenv("VASA_ALLOW_NO_VULKAN");
  return set && std::strcmp(set, "1") == 0;
}

}  // namespace

bool vulkanAvailable() {
  ProcessDevice& process = processDevice();
  if (process.device()) return true;
  if (process.error().fault == Fault::noDevice && mayLackVulkan()) return false;
  FAIL(process.error().message);
  return false;
}

void downloadBytes(gpu::Device& device, const gpu::Buffer& from, std::span<std::byte> bytes) {
  if (bytes.empty()) return;
  const gpu::Buffer staging(device, {"staging", bytes.size(), gpu::MemoryRole::readBack});
  gpu::Commands commands = device.queue().begin("download");
  const VkBufferCopy region{0, 0, bytes.size()};
  vkCmdCopyBuffer(commands, from.handle(), staging.handle(), 1, &region);
  device.queue().wait(device.queue().submit(std::move(commands)));
  staging.read(bytes);
}

GpuRig::GpuRig() : device_(*processDevice().device()), messagesBefore_(device_.validationMessages().size()) {}

GpuRig::~GpuRig() {
  auto messages = device_.validationMessages();
  messages.erase(messages.begin(), messages.begin() + std::ptrdiff_t(messagesBefore_));
  CHECK_MESSAGE(messages.empty(), joined(messages));
}

std::string joined(const std::vector<std::string>& messages) {
  std::string text;
  for (const std::string& message : messages) text += message + "\n";
  return text;
}

}  // namespace vasa::test
