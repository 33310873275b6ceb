#pragma once
#include <cstdint>

namespace vasa::test {

/// The push constants of scale.comp.
struct ScalePush {
  std::uint64_t floats;
  std::uint32_t count;
  std::uint32_t unused = 0;
};

}  // namespace vasa::test
