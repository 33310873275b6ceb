#pragma once
#include "realism/study.h"
#include "report.h"

namespace vasa::cli {

/// The page as one HTML file that needs no other: the figures in a table, and curves over joint angles.
std::string realismPage(const Protocol& protocol, const RealismStudy& study, const Report& report);

}  // namespace vasa::cli
