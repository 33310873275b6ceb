#pragma once
#include <cstdint>
#include <vector>

#include "gpu/shader.h"

namespace vasa::gpu {

/// A buffer_reference among a shader's push constants.
struct PushedAddress {
  std::uint32_t offset = 0;  ///< [bytes] in the push constants
  bool written = false;      ///< false: the block is declared readonly
  auto operator<=>(const PushedAddress&) const = default;
};

/// The addresses that a shader takes from its push constants, by their place. Blocks inside the push constant
/// block are looked into, arrays of addresses are not.
std::vector<PushedAddress> pushedAddresses(const ShaderCode& code);

}  // namespace vasa::gpu
