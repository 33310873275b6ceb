#pragma once
#include <vulkan/vulkan.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/adapter.h"
#include "gpu/address_map.h"
#include "gpu/features.h"
#include "gpu/instance.h"
#include "gpu/pipeline_store.h"
#include "gpu/queue.h"
#include "gpu/unique.h"

namespace vasa::gpu {

struct DeviceOptions {
  std::string choice;  ///< index or part of a name; empty: the best (see chooseAdapter)
  Validation validation;
  std::vector<const char*> instanceExtensions;  ///< of a window system, for presenting
  std::vector<const char*> deviceExtensions;
};

/// A Vulkan 1.3 device that another program made and goes on using. All of it must outlive what vasa makes on
/// it. The program switches on at least what featuresToEnable() returns for what its physical device offers.
struct ForeignDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  /// Draws and computes; not used by another thread while a call into vasa lasts.
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queueFamily = 0;
  Features enabled;  ///< on the device
};

/// A Vulkan 1.3 device with one queue that draws, computes and copies. Everything else of the layer is made
/// from it and must go before it. One thread uses a device and its objects.
///
/// Shaders reach buffers by address (push constants), never by descriptor. On lavapipe all loops of one
/// shader invocation share a budget of 65,535 iterations and stop silently past it: spread such work over
/// invocations.
class Device {
 public:
  /// Throws Error: Fault::noDevice if nothing usable is there, Fault::failed if validation is not installed.
  explicit Device(const DeviceOptions& options = {});
  /// Draws on another program's device: that and its instance are used, not owned. Work that the program
  /// submitted to the queue before comes before vasa's, and the other way round; between the two lies a full
  /// barrier as soon as vasa records. Throws Error (Fault::noDevice) with what the device lacks or has not
  /// enabled.
  explicit Device(const ForeignDevice& foreign);
  ~Device();  ///< waits until what vasa submitted is done
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkInstance instance() const { return instance_.handle(); }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return owner_.device; }
  /// Kept from run to run (gpu/pipeline_store.h), as it is when the device goes.
  VkPipelineCache pipelineCache() const { return pipelines_.handle(); }
  const Adapter& adapter() const { return adapter_; }
  /// Draws with the processors that this program runs on.
  bool isCpu() const { return adapter_.type == VK_PHYSICAL_DEVICE_TYPE_CPU; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
  /// What is enabled: the required features, and the welcome ones on offer (wideLines, shaderInt64, ...).
  const Features& features() const { return features_; }
  std::uint32_t timestampBits() const { return timestampBits_; }  ///< 0: no timestamps

  Queue& queue() { return *queue_; }
  bool gpuAssisted() const { return gpuAssisted_; }

  /// Where buffers lie, and a way to bind one without a descriptor pool. For AddressShadow: the map is
  /// nullptr, and nothing can be pushed, unless synchronization is validated and the driver has
  /// VK_KHR_push_descriptor.
  AddressMap* addresses() { return addresses_.get(); }
  void pushDescriptor(VkCommandBuffer commands, VkPipelineLayout layout,
                      const VkWriteDescriptorSet& descriptor) const;

  /// Shown in validation messages and by debuggers; does nothing without validation.
  template <class Handle>
  void setName(Handle handle, std::string_view name) const {
    if (labels_.setName) setObjectName(objectType(handle), std::uint64_t(handle), name);
  }
  /// A named stretch of a command buffer; does nothing without validation.
  void beginLabel(VkCommandBuffer commands, const char* name) const;
  void endLabel(VkCommandBuffer commands) const;

  /// Warnings and errors of the validation layer so far.
  std::vector<std::string> validationMessages() const { return validationLog()->messages(); }
  std::shared_ptr<const ValidationLog> validationLog() const { return instance_.validationLog(); }

 private:
  struct Owner {
    VkDevice device = VK_NULL_HANDLE;
    bool ours = true;
    ~Owner();
  };
  struct Labels {
    PFN_vkSetDebugUtilsObjectNameEXT setName = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end = nullptr;
  };
  void choose(const std::string& choice);
  void adopt(const ForeignDevice& foreign);
  void readProperties();
  void create(const DeviceOptions& options);
  void createPipelineCache();
  void loadLabels();
  void followAddresses();
  void setObjectName(VkObjectType type, std::uint64_t handle, std::string_view name) const;

  Instance instance_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  Adapter adapter_;
  VkPhysicalDeviceLimits limits_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  Features features_;
  std::uint32_t timestampBits_ = 0;
  bool gpuAssisted_;
  std::unique_ptr<AddressMap> addresses_;
  PFN_vkCmdPushDescriptorSetKHR pushDescriptors_ = nullptr;
  Labels labels_;
  Owner owner_;
  PipelineStore pipelines_;
  std::unique_ptr<Queue> queue_;
};

}  // namespace vasa::gpu
