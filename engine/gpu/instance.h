#pragma once
#include <vulkan/vulkan.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace vasa::gpu {

/// What is checked while the program runs. Every option costs time; none belongs into a release run.
struct Validation {
  bool core = false;             ///< VK_LAYER_KHRONOS_validation
  bool synchronization = false;  ///< missing barriers, across submits too; implies core
  bool gpuAssisted = false;      ///< out-of-bounds accesses inside shaders; implies core

  bool any() const { return core || synchronization || gpuAssisted; }
};

struct InstanceOptions {
  Validation validation;
  std::vector<const char*> extensions;  ///< of a window system
};

/// What the validation layer says of an instance and its devices, oldest first. It outlives them, because
/// objects that were left behind are reported when the device goes. Any thread.
class ValidationLog {
 public:
  void add(std::string message);
  std::vector<std::string> messages() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

/// The VkInstance, and what the validation layer says about it and its devices.
class Instance {
 public:
  /// Throws Error: Fault::noDevice if there is no driver, Fault::failed if the validation layer is missing.
  /// With validation.synchronization the process's VK_LAYER_ENABLES is set while the call lasts.
  explicit Instance(const InstanceOptions& options);
  /// Another program's, which stays its.
  static Instance foreign(VkInstance handle) { return Instance(handle, false); }
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return instance_; }

  /// Warnings and errors; empty without validation.
  std::shared_ptr<const ValidationLog> validationLog() const { return log_; }

 private:
  Instance(VkInstance handle, bool ours) : instance_(handle), ours_(ours) {}
  void createMessenger();

  std::shared_ptr<ValidationLog> log_ = std::make_shared<ValidationLog>();
  VkInstance instance_ = VK_NULL_HANDLE;
  bool ours_ = true;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace vasa::gpu
