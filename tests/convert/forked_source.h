#pragma once
#include "convert/convert.h"
#include "convert/keep_patches.h"
#include "convert/sources.h"

namespace vasa::test {

struct Forked {
  std::vector<SourceElement> elements;
  Network network;  ///< with its patches
  PatchReport report;
};

inline Forked forked() {
  std::vector<SourceElement> elements{source("aorta", forkedSurface())};
  auto conversion = convertElements(elements);
  if (!conversion) return {};
  KeptPatches kept = keepPatches(conversion->network, elements, conversion->elementOf);
  auto network = withPatches(std::move(conversion->network), std::move(kept.patches));
  if (!network) return {};
  return {std::move(elements), std::move(*network), std::move(kept.report)};
}

}  // namespace vasa::test
