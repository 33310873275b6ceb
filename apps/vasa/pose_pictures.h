#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/result.h"
#include "gpu/device.h"
#include "scene/scene.h"

namespace vasa::cli {

/// A table of severities (1: at the limit) over a joint's angle: a strip a row.
struct HeatMap {
  struct Cell {
    float from = 0, to = 0;  ///< [degrees]
    float severity = 0;
  };
  struct Row {
    std::string name;
    std::vector<Cell> cells;
  };
  std::string title, axis;
  std::vector<Row> rows;  ///< from the top
};
Result<Image> drawHeatMap(const HeatMap& map);

/// The body at rest, each vessel in the colour of its strain: blue shortened, grey unchanged, red stretched.
/// @param strains  one a vessel
/// @param full     [share] the strain of the darkest colours
Result<Image> drawStrains(const Scene& scene, std::span<const float> strains, float full,
                          gpu::Device& device);

}  // namespace vasa::cli
