#pragma once
#include "report.h"

namespace vasa::cli {

/// What `vasa check` found, for people: a row a frame, the worst of each figure, and a verdict in a sentence
/// at the end. Lengths in millimetres.
/// @param report  {"frames": [...], "summary": {...}}, at least one frame
std::string checkText(const Report& report);

/// "No vessel runs through another in any of 34 frames: certified." and what else a reader must know.
std::string checkVerdict(const Report& report);

}  // namespace vasa::cli
