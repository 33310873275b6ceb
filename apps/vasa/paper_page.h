#pragma once
#include "paper_study.h"

namespace vasa::cli {

/// The page as one HTML file that needs no other: style inside, pictures as data.
/// @param report   with table1, table2, table3, device, clip ...
/// @param figures  1 to 7 in order
Result<std::string> paperPage(const Report& report, std::span<const PaperFigure> figures);

}  // namespace vasa::cli
