#include "gpu/instance.h"

#include <cstdlib>
#include <cstring>
#include <optional>

#include "gpu/error.h"

namespace vasa::gpu {
namespace {

constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

bool hasValidationLayer() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  for (const VkLayerProperties& layer : layers)
    if (std::strcmp(layer.layerName, kLayer) == 0) return true;
  return false;
}

// Hazards between two submits are a switch of the layer that VkValidationFeaturesEXT does not have yet; the
// layer reads it from the environment in vkCreateInstance.
class QueueSubmitSwitch {
 public:
  explicit QueueSubmitSwitch(bool on) : on_(on) {
    if (!on_) return;
    if (const char* set = std::getenv(kVariable)) before_ = set;
    const std::string value =
        (before_ ? *before_ + "," : "") + "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";
    setenv(kVariable, value.c_str(), 1);
  }
  ~QueueSubmitSwitch() {
    if (!on_) return;
    if (before_)
      setenv(kVariable, before_->c_str(), 1);
    else
      unsetenv(kVariable);
  }
  QueueSubmitSwitch(const QueueSubmitSwitch&) = delete;
  QueueSubmitSwitch& operator=(const QueueSubmitSwitch&) = delete;

 private:
  static constexpr const char* kVariable = "VK_LAYER_ENABLES";
  bool on_;
  std::optional<std::string> before_;
};

template <class Function>
Function load(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                       VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  static_cast<ValidationLog*>(user)->add(data->pMessage ? data->pMessage : "(no text)");
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog& log) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not GENERAL: through it the loader tells of other drivers that do not fit this machine.
  info.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = &receive;
  info.pUserData = &log;
  return info;
}

}  // namespace

void ValidationLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

Instance::Instance(const InstanceOptions& options) {
  const Validation& validation = options.validation;
  if (validation.any() && !hasValidationLayer())
    throw Error(
        {Fault::failed, std::string(kLayer) +
                            " is not installed; install vulkan-validationlayers or switch validation off"});
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "vasa";
  application.apiVersion = VK_API_VERSION_1_3;

  std::vector<VkValidationFeatureEnableEXT> enables;
  if (validation.synchronization)
    enables.push_back(VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT);
  if (validation.gpuAssisted) {
    enables.push_back(VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT);
    enables.push_back(VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT);
  }
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.enabledValidationFeatureCount = std::uint32_t(enables.size());
  features.pEnabledValidationFeatures = enables.data();
  auto messenger = messengerInfo(*log_);  // chained too: it hears vkCreateInstance and vkDestroyInstance
  messenger.pNext = &features;

  std::vector<const char*> extensions = options.extensions;
  if (validation.any()) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  info.enabledExtensionCount = std::uint32_t(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  if (validation.any()) {
    info.pNext = &messenger;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kLayer;
  }
  const QueueSubmitSwitch acrossSubmits(validation.synchronization);
  const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER || result == VK_ERROR_INITIALIZATION_FAILED)
    throw Error({Fault::noDevice, "no Vulkan driver is installed (vkCreateInstance: " + resultName(result) +
                                      "); install mesa-vulkan-drivers or your GPU's driver"});
  check(result, "vkCreateInstance");
  if (validation.any()) createMessenger();
}

void Instance::createMessenger() {
  const auto create = load<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT");
  const auto info = messengerInfo(*log_);
  const VkResult result = create(instance_, &info, nullptr, &messenger_);
  if (result < 0) vkDestroyInstance(instance_, nullptr);
  check(result, "vkCreateDebugUtilsMessengerEXT");
}

Instance::~Instance() {
  if (messenger_)
    load<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(
        instance_, messenger_, nullptr);
  if (ours_) vkDestroyInstance(instance_, nullptr);
}

}  // namespace vasa::gpu
