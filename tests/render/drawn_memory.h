#pragma once
#include <cstddef>

namespace vasa::test {

/// From now until drawnMemory(): which buffers draws read. Vulkan's functions go through this program's own
/// (drawn_memory.cpp), so that a test counts what the device was asked for, by nobody's formula.
void watchDraws();

struct DrawnMemory {
  std::size_t bytes = 0;  ///< allocated for all buffers that draws read: vertices, indices, draws, colours
  std::size_t buffers = 0;
};
DrawnMemory drawnMemory();

}  // namespace vasa::test
