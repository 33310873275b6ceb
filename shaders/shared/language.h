// Read by C++ and GLSL: what the two say differently, for the files beside this one.
#ifndef VASA_SHARED_LANGUAGE_H
#define VASA_SHARED_LANGUAGE_H
#ifdef __cplusplus
#include <cstddef>
#include <cstdint>

#include "math/types.h"
namespace vasa::shared {
using uint = std::uint32_t;
}
#define VASA_CONSTANT constexpr
#define VASA_FUNCTION constexpr
#define VASA_ADDRESS(Block) std::uint64_t
#else
#extension GL_EXT_buffer_reference : require
#define VASA_CONSTANT const
#define VASA_FUNCTION
#define VASA_ADDRESS(Block) Block
// Before a block that addresses lead to.
#define VASA_MEMORY(align) layout(buffer_reference, std430, buffer_reference_align = align)
#endif
#endif
