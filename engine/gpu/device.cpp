#include "gpu/device.h"

#include <algorithm>
#include <string_view>

#include "gpu/driver_threads.h"
#include "gpu/error.h"

namespace vasa::gpu {
namespace {

bool offers(VkPhysicalDevice device, std::string_view extension) {
  std::uint32_t count = 0;
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
        "vkEnumerateDeviceExtensionProperties");
  std::vector<VkExtensionProperties> offered(count);
  check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, offered.data()),
        "vkEnumerateDeviceExtensionProperties");
  return std::ranges::any_of(
      offered, [&](const VkExtensionProperties& each) { return each.extensionName == extension; });
}

}  // namespace

Device::Device(const DeviceOptions& options)
    : instance_({options.validation, options.instanceExtensions}),
      gpuAssisted_(options.validation.gpuAssisted) {
  choose(options.choice);
  create(options);
  if (options.validation.any()) loadLabels();
  createPipelineCache();
  VkQueue queue = VK_NULL_HANDLE;
  vkGetDeviceQueue(handle(), adapter_.queueFamily, 0, &queue);
  queue_ = std::make_unique<Queue>(*this, queue);
}

Device::Device(const ForeignDevice& foreign)
    : instance_(Instance::foreign(foreign.instance)), gpuAssisted_(false) {
  adopt(foreign);
  createPipelineCache();
  queue_ = std::make_unique<Queue>(*this, foreign.queue);
}

void Device::createPipelineCache() {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  pipelines_ = PipelineStore(handle(), properties);
  setName(pipelines_.handle(), "pipeline cache");
}

Device::~Device() {  // the queue waits
  pipelines_.keep();
}

Device::Owner::~Owner() {
  if (ours) vkDestroyDevice(device, nullptr);
}

void Device::choose(const std::string& choice) {
  const std::vector<VkPhysicalDevice> devices = physicalDevices(instance_.handle());
  std::vector<Adapter> adapters;
  for (VkPhysicalDevice device : devices)
    adapters.push_back(describe(device, std::uint32_t(adapters.size())));
  const std::size_t chosen = chooseAdapter(adapters, choice);
  physical_ = devices[chosen];
  adapter_ = adapters[chosen];
  readProperties();
}

void Device::adopt(const ForeignDevice& foreign) {
  physical_ = foreign.physical;
  adapter_ = describe(physical_, 0);
  features_ = foreign.enabled;
  std::vector<std::string> lacks = adapter_.lacks;
  for (const std::string& feature : missingFeatures(features_)) lacks.push_back(feature + " switched on");
  if (!lacks.empty()) {
    std::string list;
    for (const std::string& what : lacks) list += (list.empty() ? "" : ", ") + what;
    throw Error({Fault::noDevice, "the Vulkan device handed over (" + adapter_.name + ") lacks " + list +
                                      "; create it with what vasa::gpu::featuresToEnable() says"});
  }
  adapter_.queueFamily = foreign.queueFamily;
  owner_.device = foreign.device;
  owner_.ours = false;
  readProperties();
}

void Device::readProperties() {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  limits_ = properties.limits;
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  timestampBits_ = queueFamilies(physical_)[adapter_.queueFamily].timestampValidBits;
}

void Device::create(const DeviceOptions& options) {
  Features offered;
  vkGetPhysicalDeviceFeatures2(physical_, offered.chain());
  features_ = featuresToEnable(offered);

  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queueInfo{};
  queueInfo.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queueInfo.queueFamilyIndex = adapter_.queueFamily;
  queueInfo.queueCount = 1;
  queueInfo.pQueuePriorities = &priority;
  std::vector<const char*> extensions = options.deviceExtensions;
  const bool follows =
      options.validation.synchronization && offers(physical_, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
  if (follows) extensions.push_back(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = features_.chain();
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queueInfo;
  info.enabledExtensionCount = std::uint32_t(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const DriverThreads threads;
  check(vkCreateDevice(physical_, &info, nullptr, &owner_.device), "vkCreateDevice");
  threads.spread();
  if (follows) followAddresses();
}

void Device::loadLabels() {
  const auto find = [&](const char* name) { return vkGetInstanceProcAddr(instance_.handle(), name); };
  labels_.setName = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(find("vkSetDebugUtilsObjectNameEXT"));
  labels_.begin = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(find("vkCmdBeginDebugUtilsLabelEXT"));
  labels_.end = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(find("vkCmdEndDebugUtilsLabelEXT"));
}

void Device::followAddresses() {
  addresses_ = std::make_unique<AddressMap>();
  pushDescriptors_ = reinterpret_cast<PFN_vkCmdPushDescriptorSetKHR>(
      vkGetDeviceProcAddr(handle(), "vkCmdPushDescriptorSetKHR"));
}

void Device::pushDescriptor(VkCommandBuffer commands, VkPipelineLayout layout,
                            const VkWriteDescriptorSet& descriptor) const {
  pushDescriptors_(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &descriptor);
}

void Device::setObjectName(VkObjectType type, std::uint64_t handle, std::string_view name) const {
  const std::string terminated(name);
  VkDebugUtilsObjectNameInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = terminated.c_str();
  labels_.setName(this->handle(), &info);
}

void Device::beginLabel(VkCommandBuffer commands, const char* name) const {
  if (!labels_.begin) return;
  VkDebugUtilsLabelEXT label{};
  label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
  label.pLabelName = name;
  labels_.begin(commands, &label);
}

void Device::endLabel(VkCommandBuffer commands) const {
  if (labels_.end) labels_.end(commands);
}

}  // namespace vasa::gpu
