#include "growth/ribbon.h"

namespace vasa {

std::vector<std::uint32_t> ribbonIndices(std::uint32_t edges, std::uint32_t copies) {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t(3) * ribbonTriangles(edges) * copies);
  for (std::uint32_t copy = 0; copy < copies; ++copy)
    for (std::uint32_t k = 0; k < ribbonTriangles(edges); ++k) {
      const std::uint32_t v = copy * ribbonVertices(edges) + k, odd = k % 2;
      indices.insert(indices.end(), {v + odd, v + 1 - odd, v + 2});  // all wind alike
    }
  return indices;
}

}  // namespace vasa
