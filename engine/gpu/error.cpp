#include "gpu/error.h"

namespace vasa::gpu {
namespace {

struct NamedResult {
  VkResult result;
  const char* name;
};
#define VASA_RESULT(result) \
  { result, #result }
constexpr NamedResult kNamed[] = {VASA_RESULT(VK_SUCCESS),
                                  VASA_RESULT(VK_NOT_READY),
                                  VASA_RESULT(VK_TIMEOUT),
                                  VASA_RESULT(VK_INCOMPLETE),
                                  VASA_RESULT(VK_SUBOPTIMAL_KHR),
                                  VASA_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY),
                                  VASA_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY),
                                  VASA_RESULT(VK_ERROR_INITIALIZATION_FAILED),
                                  VASA_RESULT(VK_ERROR_DEVICE_LOST),
                                  VASA_RESULT(VK_ERROR_MEMORY_MAP_FAILED),
                                  VASA_RESULT(VK_ERROR_LAYER_NOT_PRESENT),
                                  VASA_RESULT(VK_ERROR_EXTENSION_NOT_PRESENT),
                                  VASA_RESULT(VK_ERROR_FEATURE_NOT_PRESENT),
                                  VASA_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER),
                                  VASA_RESULT(VK_ERROR_TOO_MANY_OBJECTS),
                                  VASA_RESULT(VK_ERROR_FORMAT_NOT_SUPPORTED),
                                  VASA_RESULT(VK_ERROR_FRAGMENTED_POOL),
                                  VASA_RESULT(VK_ERROR_UNKNOWN),
                                  VASA_RESULT(VK_ERROR_OUT_OF_POOL_MEMORY),
                                  VASA_RESULT(VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS),
                                  VASA_RESULT(VK_ERROR_SURFACE_LOST_KHR),
                                  VASA_RESULT(VK_ERROR_OUT_OF_DATE_KHR),
                                  VASA_RESULT(VK_ERROR_INVALID_SHADER_NV)};
#undef VASA_RESULT

const char* remedy(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "; free some memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "; use a smaller picture or fewer quads, or another --device";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "; close other programs that use the device";
    case VK_ERROR_DEVICE_LOST:
      return ": the device stopped working; run again, or choose another --device";
    default:
      return "";
  }
}

}  // namespace

std::string resultName(VkResult result) {
  for (const NamedResult& known : kNamed)
    if (known.result == result) return known.name;
  return "VkResult " + std::to_string(int(result));
}

VkResult check(VkResult result, const char* call) {
  if (result >= 0) return result;
  const Fault fault = result == VK_ERROR_DEVICE_LOST ? Fault::deviceLost : Fault::failed;
  throw Error({fault, std::string(call) + ": " + resultName(result) + remedy(result)});
}

}  // namespace vasa::gpu
