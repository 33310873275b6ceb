#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace vasa::gpu {

/// SPIR-V in the program's own memory. cmake/shaders.cmake makes one constant per shader file:
/// spirv::tessellate_comp of "spirv/tessellate_comp.h" from tessellate.comp.
struct ShaderCode {
  std::string_view name;  ///< the file's name, for messages and debug names
  std::span<const std::uint32_t> words;
  std::span<const std::uint32_t>
      int64Words{};  ///< the same for devices with shaderInt64 (shaders/lib/words.glsl); may be empty
};

}  // namespace vasa::gpu
