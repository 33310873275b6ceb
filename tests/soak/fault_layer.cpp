// A Vulkan layer for tests alone: the n-th call of one function fails, once or from then on.
//   VASA_FAULT=FUNCTION:N:RESULT:once|always   N from 1, RESULT as in Vulkan's header, by number
//   VASA_FAULT_LOG=FILE     "FUNCTION CALLS RESULT..." of each function called, RESULTs those that may come
//   from it; "struck" VASA_FAULT_SECONDS=S    SIGALRM ends the process after so long (60): a hang is an end,
//   too
// One instance and one device at a time. It stays loaded, so that counts go on from one instance to the next.
#include <unistd.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

// Of window systems, without their headers.
using PFN_vkCreateXcbSurfaceKHR = VkResult(VKAPI_PTR*)(VkInstance, const void*, const VkAllocationCallbacks*,
                                                       VkSurfaceKHR*);
using PFN_vkCreateXlibSurfaceKHR = PFN_vkCreateXcbSurfaceKHR;

// Every fallible function that vasa, Dear ImGui and GLFW call, with what the specification lets it return: M
// out of host memory, m of device memory, I initialisation failed, L device lost, S surface lost, o out of
// date, s suboptimal, T timeout, N not ready, P map failed, p pool memory, f fragmented pool, l layer, e
// extension and F feature not present, D incompatible driver, t too many objects, A capture address, w window
// in use, X full-screen mode lost, n format not supported.
#define VASA_FALLIBLE(call)                                                                                  \
  call(vkCreateInstance, "MmIleD") call(vkCreateDevice, "MmIeFtL") call(                                     \
      vkEnumeratePhysicalDevices, "MmI") call(vkCreateXcbSurfaceKHR, "Mm")                                   \
      call(vkCreateXlibSurfaceKHR, "Mm") call(vkGetPhysicalDeviceSurfaceSupportKHR, "MmS") call(             \
          vkGetPhysicalDeviceSurfaceCapabilitiesKHR, "MmS") call(vkGetPhysicalDeviceSurfaceFormatsKHR,       \
                                                                 "MmS") call(vkCreateSwapchainKHR, "MmLSwI") \
          call(vkGetSwapchainImagesKHR, "Mm") call(vkAcquireNextImageKHR, "MmLoSsTNX") call(                 \
              vkQueuePresentKHR, "MmLoSsX") call(vkQueueSubmit2, "MmL") call(vkQueueWaitIdle, "MmL")         \
              call(vkDeviceWaitIdle, "MmL") call(vkWaitSemaphores, "MmLT")                                   \
                  call(vkGetSemaphoreCounterValue, "MmL") call(vkGetQueryPoolResults, "MmLN") call(          \
                      vkCreateSemaphore, "Mm") call(vkCreateQueryPool, "Mm") call(vkCreateCommandPool, "Mm") \
                      call(vkResetCommandPool, "Mm") call(vkAllocateCommandBuffers, "Mm") call(              \
                          vkBeginCommandBuffer, "Mm") call(vkEndCommandBuffer, "Mm")                         \
                          call(vkAllocateMemory, "MmtA") call(vkMapMemory, "MmP") call(                      \
                              vkFlushMappedMemoryRanges, "Mm") call(vkInvalidateMappedMemoryRanges, "Mm")    \
                              call(vkBindBufferMemory, "MmA") call(vkBindImageMemory, "Mm")                  \
                                  call(vkCreateBuffer, "MmA") call(vkCreateImage, "Mm")                      \
                                      call(vkCreateImageView, "Mm") call(vkCreateSampler, "Mm")              \
                                          call(vkCreateShaderModule, "Mm") call(vkCreatePipelineCache, "Mm") \
                                              call(vkCreatePipelineLayout, "Mm")                             \
                                                  call(vkCreateDescriptorSetLayout, "Mm")                    \
                                                      call(vkCreateDescriptorPool, "Mmf")                    \
                                                          call(vkAllocateDescriptorSets, "Mmfp")             \
                                                              call(vkCreateGraphicsPipelines, "Mm")          \
                                                                  call(vkCreateComputePipelines, "Mm")       \
                                                                      call(vkCreateRenderPass, "Mm")         \
                                                                          call(vkCreateFramebuffer, "Mm")

VkResult resultOf(char letter) {
  switch (letter) {
    case 'M':
      return VK_ERROR_OUT_OF_HOST_MEMORY;
    case 'm':
      return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    case 'I':
      return VK_ERROR_INITIALIZATION_FAILED;
    case 'L':
      return VK_ERROR_DEVICE_LOST;
    case 'S':
      return VK_ERROR_SURFACE_LOST_KHR;
    case 'o':
      return VK_ERROR_OUT_OF_DATE_KHR;
    case 's':
      return VK_SUBOPTIMAL_KHR;
    case 'T':
      return VK_TIMEOUT;
    case 'N':
      return VK_NOT_READY;
    case 'P':
      return VK_ERROR_MEMORY_MAP_FAILED;
    case 'p':
      return VK_ERROR_OUT_OF_POOL_MEMORY;
    case 'f':
      return VK_ERROR_FRAGMENTED_POOL;
    case 'l':
      return VK_ERROR_LAYER_NOT_PRESENT;
    case 'e':
      return VK_ERROR_EXTENSION_NOT_PRESENT;
    case 'F':
      return VK_ERROR_FEATURE_NOT_PRESENT;
    case 'D':
      return VK_ERROR_INCOMPATIBLE_DRIVER;
    case 't':
      return VK_ERROR_TOO_MANY_OBJECTS;
    case 'A':
      return VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS;
    case 'w':
      return VK_ERROR_NATIVE_WINDOW_IN_USE_KHR;
    case 'X':
      return VK_ERROR_FULL_SCREEN_EXCLUSIVE_MODE_LOST_EXT;
    default:
      return VK_ERROR_UNKNOWN;
  }
}

enum Id : std::size_t {
#define VASA_ID(name, results) id_##name,
  VASA_FALLIBLE(VASA_ID)
#undef VASA_ID
      idCount
};

struct Function {
  std::string_view name, results;
};
constexpr std::array<Function, idCount> kFunctions{{
#define VASA_ROW(name, results) {#name, results},
    VASA_FALLIBLE(VASA_ROW)
#undef VASA_ROW
}};

std::array<PFN_vkVoidFunction, idCount> next{};
PFN_vkGetInstanceProcAddr nextInstance = nullptr;
PFN_vkGetDeviceProcAddr nextDevice = nullptr;

class Plan {
 public:
  Plan() {
    const char* seconds = std::getenv("VASA_FAULT_SECONDS");
    alarm(seconds ? unsigned(std::atoi(seconds)) : 60);
    const char* fault = std::getenv("VASA_FAULT");
    std::array<char, 64> name{}, mode{};
    if (!fault || std::sscanf(fault, "%63[^:]:%u:%d:%63s", name.data(), &at_, &result_, mode.data()) != 4)
      return;
    name_ = name.data();
    always_ = std::string_view(mode.data()) == "always";
  }
  ~Plan() {
    std::string text;
    for (std::size_t id = 0; id < idCount; ++id) {
      if (calls_[id] == 0) continue;
      text += std::string(kFunctions[id].name) + ' ' + std::to_string(calls_[id]);
      for (char letter : kFunctions[id].results) text += ' ' + std::to_string(resultOf(letter));
      text += '\n';
    }
    log(text);
  }

  /// VK_SUCCESS: this call goes through.
  VkResult resultNow(Id id) {
    const unsigned call = ++calls_[id];
    if (kFunctions[id].name != name_ || call < at_ || (call > at_ && !always_)) return VK_SUCCESS;
    if (call == at_) log("struck\n");
    return VkResult(result_);
  }

 private:
  static void log(const std::string& text) {
    if (const char* path = std::getenv("VASA_FAULT_LOG")) std::ofstream(path, std::ios::app) << text;
  }
  std::string name_;
  unsigned at_ = 0;
  int result_ = 0;
  bool always_ = false;
  std::array<std::atomic<unsigned>, idCount> calls_{};
} plan;

// What the specification does in spite of the result: an image is acquired, and a present waits for its
// semaphores.
bool goesThrough(Id id, VkResult result) {
  if (id == id_vkAcquireNextImageKHR) return result == VK_SUBOPTIMAL_KHR;
  return id == id_vkQueuePresentKHR && (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR ||
                                        result == VK_ERROR_SURFACE_LOST_KHR);
}

template <Id id, class Pointer>
struct Faulty;
template <Id id, class... Arguments>
struct Faulty<id, VkResult(VKAPI_PTR*)(Arguments...)> {
  static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
    const VkResult result = plan.resultNow(id);
    if (result != VK_SUCCESS && !goesThrough(id, result)) return result;
    const VkResult real = reinterpret_cast<VkResult(VKAPI_PTR*)(Arguments...)>(next[id])(arguments...);
    return result != VK_SUCCESS && real >= 0 ? result : real;
  }
};

template <class Info>
Info* linkOf(const void* chain, VkStructureType type) {
  for (auto* info = static_cast<const Info*>(chain); info; info = static_cast<const Info*>(info->pNext))
    if (info->sType == type && info->function == VK_LAYER_LINK_INFO) return const_cast<Info*>(info);
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance) {
  if (const VkResult result = plan.resultNow(id_vkCreateInstance); result != VK_SUCCESS) return result;
  auto* link = linkOf<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  nextInstance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  return reinterpret_cast<PFN_vkCreateInstance>(nextInstance(nullptr, "vkCreateInstance"))(info, allocator,
                                                                                           instance);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
  if (const VkResult result = plan.resultNow(id_vkCreateDevice); result != VK_SUCCESS) return result;
  auto* link = linkOf<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  nextDevice = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  return reinterpret_cast<PFN_vkCreateDevice>(next[id_vkCreateDevice])(physical, info, allocator, device);
}

PFN_vkVoidFunction ours(const char* name, PFN_vkVoidFunction real) {
  const std::string_view wanted(name);
  if (wanted == "vkCreateInstance") return reinterpret_cast<PFN_vkVoidFunction>(createInstance);
  if (!real) return nullptr;
#define VASA_WRAP(function, results)                                                           \
  if (wanted == #function) {                                                                   \
    next[id_##function] = real;                                                                \
    if (wanted == "vkCreateDevice") return reinterpret_cast<PFN_vkVoidFunction>(createDevice); \
    return reinterpret_cast<PFN_vkVoidFunction>(Faulty<id_##function, PFN_##function>::call);  \
  }
  VASA_FALLIBLE(VASA_WRAP)
#undef VASA_WRAP
  return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
  if (std::string_view(name) == "vkGetDeviceProcAddr")
    return reinterpret_cast<PFN_vkVoidFunction>(getDeviceProcAddr);
  return ours(name, nextDevice(device, name));
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name) {
  const std::string_view wanted(name);
  if (wanted == "vkGetInstanceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(getInstanceProcAddr);
  if (wanted == "vkGetDeviceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(getDeviceProcAddr);
  return ours(name, instance && nextInstance ? nextInstance(instance, name) : nullptr);
}

}  // namespace

extern "C" VK_LAYER_EXPORT VkResult
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiated) {
  negotiated->loaderLayerInterfaceVersion = 2;
  negotiated->pfnGetInstanceProcAddr = getInstanceProcAddr;
  negotiated->pfnGetDeviceProcAddr = getDeviceProcAddr;
  negotiated->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
