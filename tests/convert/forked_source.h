#pragma once
#include <cmath>
#include <vector>

#include "convert/convert.h"
#include "convert/keep_patches.h"
#include "convert/sources.h"

namespace vasa::test {

struct Forked {
  std::vector<SourceElement> elements;
  Network network;  ///< with its patches
  PatchReport report;
};

inline Forked makeForked() {
  std::vector<SourceElement> elements{source("aorta", forkedSurface())};
  auto conversion = convertElements(elements);
  if (!conversion) return {};
  KeptPatches kept = keepPatches(conversion->network, elements, conversion->elementOf);
  auto network = withPatches(std::move(conversion->network), std::move(kept.patches));
  if (!network) return {};
  return {std::move(elements), std::move(*network), std::move(kept.report)};
}

/// Made once for all cases of this program.
inline const Forked& forked() {
  static const Forked made = makeForked();
  return made;
}

/// A network bent about the z axis from y = 0.1 on upwards and downwards, so many radians a metre of height.
inline std::vector<vec4> deepBend(const Network& network, float bend) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (vec4& p : points) {
    const float angle = bend * (p.y - 0.1f);
    if (bend != 0)
      p = vec4((p.x + 1 / bend) * std::cos(angle) - 1 / bend, 0.1f + (p.x + 1 / bend) * std::sin(angle), p.z,
               p.w);
  }
  pinEnds(network, points);
  return points;
}

}  // namespace vasa::test
