#include "plate/braincase.h"

#include <algorithm>
#include <cmath>

#include "math/aabb.h"
#include "mesh/winding_number.h"

namespace vasa::plate {
namespace {

constexpr int kDirections = 64;  // a cone of 20 degrees each
// Of the directions. In the built-in skull 57 and more are hidden within, 54 where the vertebral arteries
// come in through the largest hole, 53 at most below the base and 51 to 56 at the orbit's back.
constexpr int kEnclosed = 54;
constexpr std::uint32_t kCells = 128;  // across the bones: 2 mm of a skull, half of its thinnest gaps
constexpr int kGrid = 12;  // places along each side of the bones' box that its middle is sought among

// The k-th of directions that are spread evenly (Fibonacci's lattice on the sphere).
vec3 direction(int k) {
  const float goldenAngle = kPi * (3 - std::sqrt(5.0f));
  const float y = 1 - (2 * float(k) + 1) / kDirections, r = std::sqrt(1 - y * y);
  return vec3(r * std::cos(goldenAngle * float(k)), y, r * std::sin(goldenAngle * float(k)));
}

std::uint32_t bone(std::uint32_t) { return 0; }

}  // namespace

Braincase::Braincase(std::span<const vec3> positions, std::span<const uvec3> triangles) {
  if (triangles.empty()) return;
  Aabb box;
  for (const uvec3& t : triangles)
    for (int k = 0; k < 3; ++k) box.add(positions[t[k]]);
  const vec3 centre = box.centre(), extent = box.extent();
  const float across = glm::length(extent);
  for (int k = 0; k < kDirections; ++k) {
    const vec3 towards = direction(k);
    fromOutside_.emplace_back(Camera{.position = centre + across * towards,
                                     .target = centre,
                                     .orthographicHeight = across,
                                     .farDistance = 2 * across},
                              kCells, kCells);
    fromOutside_.back().draw(positions, triangles, bone);
  }

  const WindingNumber winding(positions, triangles);
  vec3 sum(0);
  float count = 0;
  for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
    const vec3 share((vec3(i % kGrid, i / kGrid % kGrid, i / (kGrid * kGrid)) + 0.5f) / float(kGrid) - 0.5f);
    const vec3 place = centre + share * extent;
    if (directionsHidden(place) == kDirections && winding.at(place) < 0.5f) sum += place, ++count;
  }
  if (count == 0) return;
  const vec3 middle = sum / count;
  for (int k = 0; k < 6; ++k) {
    vec3 towards(0);
    towards[k / 2] = k % 2 ? 1.0f : -1.0f;
    fromMiddle_.emplace_back(Camera{.position = middle, .target = middle + towards, .verticalAngle = kPi / 2},
                             kCells, kCells);
    fromMiddle_.back().draw(positions, triangles, bone);
  }
}

int Braincase::directionsHidden(vec3 place) const {
  return int(std::ranges::count_if(fromOutside_, [&](const SeenMap& map) { return map.hides(place); }));
}

bool Braincase::holds(vec3 place) const {
  return !fromMiddle_.empty() && directionsHidden(place) >= kEnclosed &&
         std::ranges::none_of(fromMiddle_, [&](const SeenMap& map) { return map.hides(place); });
}

}  // namespace vasa::plate
