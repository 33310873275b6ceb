#pragma once
#include <vulkan/vulkan.h>

#include <exception>
#include <string>
#include <type_traits>

#include "core/result.h"

namespace vasa::gpu {

/// The one exception of the Vulkan layer: a failed call, a device that lacks something, or a size over a
/// device's limit. Caught where an app calls the engine (see attempt()).
class Error : public std::exception {
 public:
  explicit Error(vasa::Error error) : error_(std::move(error)) {}
  const char* what() const noexcept override { return error_.message.c_str(); }
  Fault fault() const { return error_.fault; }
  const vasa::Error& error() const { return error_; }

 private:
  vasa::Error error_;
};

/// "VK_ERROR_DEVICE_LOST"; "VkResult -77" for a value without a name here.
std::string resultName(VkResult result);

/// Passes successes on (VK_INCOMPLETE, VK_TIMEOUT, ... too); throws Error for failures, naming the call, its
/// result and a remedy. VK_ERROR_DEVICE_LOST becomes Fault::deviceLost, everything else Fault::failed.
VkResult check(VkResult result, const char* call);

/// The Result of a function that may throw Error: the border between the Vulkan layer and an app.
template <class Function>
auto attempt(Function&& function) -> Result<std::invoke_result_t<Function>> {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Function>>) {
      function();
      return {};
    } else {
      return function();
    }
  } catch (const Error& error) {
    return error.error();
  }
}

}  // namespace vasa::gpu
