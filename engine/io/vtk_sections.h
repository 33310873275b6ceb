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

/// What a legacy VTK file holds, section by section, or a grid of either kind.
struct Sections {
  std::vector<dvec3> points;
  std::map<std::string, Cells> cells;  ///< "LINES", "POLYGONS", "TRIANGLE_STRIPS"
  /// In the file's order, names as people write them. One of each name.
  std::vector<Array> pointData, cellData;
};

/// Throws BrokenRule. Cells of an unstructured grid come as polygonal data has them.
/// @param text  plain (io/text_file.h)
Sections sectionsOf(std::string_view text);

/// The same of an XML file of an unstructured grid (.vtu).
Sections gridSections(std::span<const std::byte> bytes);

/// Adds a grid's cells to the lists of polygonal data, with what the file tells of cells in the order of
/// these. Throws BrokenRule where one is neither line nor face. @param types  VTK's, one a cell
void divideCells(Sections& file, const Cells& cells, std::span<const double> types);

}  // namespace vasa::vtk
