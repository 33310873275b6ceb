#pragma once
#include "repair/rest_repair.h"
#include "report.h"

namespace vasa::cli {

/// Adds what was done about vessels that overlapped at rest, and which still do, deepest first.
void addRestRepair(Report& report, const RestRepair& repair);
/// The same in two lines; empty where nothing overlapped.
std::string restRepairText(const RestRepair& repair);

}  // namespace vasa::cli
