#include "collide/spatial_order.h"

#include <algorithm>
#include <numeric>

#include "math/aabb.h"

namespace vasa {
namespace {

void sortRun(std::span<const vec3> points, std::span<std::uint32_t> run, std::size_t node) {
  if (run.size() <= 1) return;
  while (node >= run.size()) node /= 2;
  if (node == 0) return;
  Aabb box;
  for (const std::uint32_t i : run) box.add(points[i]);
  const int axis = box.longestAxis();
  const std::size_t nodes = (run.size() + node - 1) / node;
  const auto middle = run.begin() + std::ptrdiff_t((nodes + 1) / 2 * node);
  if (middle < run.end())
    std::nth_element(run.begin(), middle, run.end(), [&points, axis](std::uint32_t a, std::uint32_t b) {
      return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
    });
  sortRun(points, {run.begin(), middle}, node);
  sortRun(points, {middle, run.end()}, node);
}

}  // namespace

std::vector<std::uint32_t> spatialOrder(std::span<const vec3> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::size_t node = 1;
  while (node < points.size()) node *= 2;
  sortRun(points, order, node);
  return order;
}

}  // namespace vasa
