#pragma once
#include <optional>

#include "network/network.h"
#include "report.h"

namespace vasa::cli {

/// Each vessel with what is measured of it: sizes, stenosis, aneurysm, course. Keys end in their unit; null:
/// there is none.
Report vesselReport(const Network& network);
/// Each fork: trunk, arms with their angles, Murray's exponent.
Report forkReport(const Network& network);

/// The two as tables for people, in millimetres, degrees and per cent.
std::string vesselTable(const Report& vessels);
std::string forkTable(const Report& forks);

}  // namespace vasa::cli
