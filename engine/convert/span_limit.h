#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vasa {

/// Spans that strands may take of a mesh with so many triangles, together, where there are so many meshes. A
/// surface tells no more curves
/// than it has triangles: scanned bodies ask for a tenth as many. Thin splinters ask for a hundred a
/// triangle, and each is tried.
std::size_t spansToldBy(std::size_t triangles, std::size_t elements = 1);

/// The most that one strand may take so that all stay within `allowed`: those that ask for most give way
/// first, and all get at least one. @param wanted  by each strand  O(n log n).
std::uint32_t spanLimit(std::vector<std::uint32_t> wanted, std::size_t allowed);

}  // namespace vasa
