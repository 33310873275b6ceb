#pragma once
#include "report.h"

namespace vasa::cli {

/// What `vasa check` found, for people: a row a frame, the worst of each figure, and a verdict in a sentence
/// at the end. Lengths in millimetres.
/// @param report  {"frames": [...], "summary": {...}}, at least one frame
std::string checkText(const Report& report);

}  // namespace vasa::cli
