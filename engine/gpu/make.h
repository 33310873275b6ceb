#pragma once
#include "gpu/device.h"
#include "gpu/error.h"

namespace vasa::gpu {

/// What one of Vulkan's functions makes, owned and with a name for messages. Throws Error.
/// @param create  vkCreateBuffer() and its kin  @param call  its name, for the message
///
///   layout_ = make(device, vkCreatePipelineLayout, "vkCreatePipelineLayout", info, name);
template <class Handle, class Info>
Unique<Handle> make(const Device& device,
                    VkResult(VKAPI_PTR* create)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                    const char* call, const Info& info, std::string_view name) {
  Handle handle = VK_NULL_HANDLE;
  check(create(device.handle(), &info, nullptr, &handle), call);
  Unique<Handle> made(device.handle(), handle);
  device.setName(handle, name);
  return made;
}

}  // namespace vasa::gpu
