#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/vtk_rule.h"
#include "math/types.h"

namespace vasa::vtk {

/// One after the other: files may have a cell for two bytes.
struct Cells {
  std::vector<std::uint32_t> points, ends;
  std::size_t size() const { return ends.size(); }
  std::span<const std::uint32_t> operator[](std::size_t i) const {
    const std::size_t from = i == 0 ? 0 : ends[i - 1];
    return std::span(points).subspan(from, ends[i] - from);
  }
};

struct Array {
  std::string name;
  std::vector<double> values;
};

/// What a legacy VTK file holds, section by section.
struct Sections {
  std::vector<dvec3> points;
  std::map<std::string, Cells> cells;  ///< "LINES", "POLYGONS", "TRIANGLE_STRIPS"
  /// In the file's order, names as people write them. One of each name.
  std::vector<Array> pointData, cellData;
};

/// Throws BrokenRule. @param text  plain (io/text_file.h)
Sections sectionsOf(std::string_view text);

}  // namespace vasa::vtk
