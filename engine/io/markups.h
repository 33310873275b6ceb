#pragma once
#include <filesystem>
#include <string_view>

#include "core/result.h"
#include "network/centrelines.h"

namespace vasa {

/// ".mrk.json".
bool isMarkupsFile(const std::filesystem::path& path);

/// Centre lines that 3D Slicer saved as curves (markups, schema 1): control points with a measurement of
/// radii, as its module Extract Centerline makes them. In metres, +Y up: such a file says its unit (mm where
/// it does not) and its axes (LPS or RAS). Control points without a place are passed over; a radius of zero
/// is mended as those of .vtp are. Lines are named after the file, of several with a number. Fails with
/// badInput where there is no curve, where one has no radii, and beyond 3 MB.
Result<Centrelines> readMarkups(const std::filesystem::path& path, VesselKind kind);

/// The same from text. @param name  for messages and lines
Result<Centrelines> parseMarkups(std::string_view text, const std::string& name, VesselKind kind);

}  // namespace vasa
