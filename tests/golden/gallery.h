#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/image.h"
#include "gpu/device.h"

namespace vasa::golden {

constexpr std::uint32_t kWidth = 160, kHeight = 120;

/// A picture with a name, and how to draw it.
struct Picture {
  std::string name;  ///< "family/what"
  std::function<Image(gpu::Device&)> draw;
};

/// Tubes, caps, forks and capillaries of synthetic networks.
std::vector<Picture> syntheticPictures();
/// The built-in human: each part alone, presets, poses, capillaries by region.
std::vector<Picture> humanPictures();
/// A changed picture for each family, under the name of the one that it must not be taken for.
std::vector<Picture> syntheticMutations();
std::vector<Picture> humanMutations();

}  // namespace vasa::golden
