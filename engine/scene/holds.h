#pragma once
#include <filesystem>
#include <vector>

#include "body/sliding.h"
#include "core/result.h"

namespace vasa {

/// Reads the places where vessels are held: a readable table (io/csv.h) with the columns vessel, at (share of
/// the vessel's length, 0 to 1) and held_by (for people). What is said of a vessel whose name begins
/// with "left " is true of the right one, too, where there is one that has no rows of its own.
/// Fails with badInput: a vessel that the network does not have, a share out of range.
Result<std::vector<VesselHold>> readHolds(const std::filesystem::path& path, const Network& network);

}  // namespace vasa
