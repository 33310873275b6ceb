#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "core/result.h"
#include "io/import_frame.h"
#include "network/centrelines.h"

namespace vasa {

/// One line of an SWC file (Cannon, Turner, Pyapali, Wheal 1998): a sample of a tree of tubes.
struct SwcSample {
  std::int64_t id = 0;
  std::int64_t type = 0;
  vec3 position{0};              ///< [m]
  float radius = 0;              ///< [m]
  std::uint32_t parent = kRoot;  ///< number of the sample before this one in the tree, not its id
  static constexpr std::uint32_t kRoot = 0xffffffffu;
};

/// The samples of an SWC file in the file's order, a forest. Between semicolons commas are decimal points.
/// Comments are passed over, as are columns after the seventh and lines of words before the first sample,
/// unless they name the columns in another order. A sample whose parent is itself is a root. A radius of zero
/// (or nan), which tracing programs write where they could not measure, becomes that of the nearest sample
/// towards the root that has one, or else of the first child, with a warning. Fails with badInput, naming
/// file and line: a line without seven numbers, a number that is not finite, an id that is used twice, a
/// parent that does not exist, a negative radius, parents in a circle, no samples.
Result<std::vector<SwcSample>> readSwc(const std::filesystem::path& path, const ImportFrame& frame = {});

/// The same from text. @param name  for messages
Result<std::vector<SwcSample>> parseSwc(std::string_view text, const std::string& name,
                                        const ImportFrame& frame = {});

/// The unit of the columns [m] where the names of columns say it ("x [cm]", "x_um"), else 0.
/// @param head  the file's beginning
double swcUnit(std::string_view head);

/// The text of a file, read back as the same samples.
std::string encodeSwc(std::span<const SwcSample> samples, const ImportFrame& frame = {});

/// The kind of vessel that a sample's type tells: 10 artery, 11 vein, 12 portal vein, 13 lymphatic. SWC has
/// none for vessels, and leaves types from 6 on to its users; those below tell of nerve cells.
std::optional<VesselKind> kindOfSwcType(std::int64_t type);
std::int64_t swcTypeOf(VesselKind kind);  ///< 0 (undefined) for other

/// The tree as vessels: at a fork the child that continues best (straightness, then likeness of radius) goes
/// on in the same line, the others leave its side there, with their own radius. Lines are named "`name` 1",
/// "`name` 2" ... in the order of the samples that start them. Samples at the place of the one before are
/// left out, roots without children too. A line is of the kind that its first sample of its own tells, else
/// of `otherwise`.
Centrelines centrelinesOfSwc(std::span<const SwcSample> samples, const std::string& name,
                             VesselKind otherwise);

/// Samples of a network's lines as a forest. Where lines form a loop, an SWC file cannot join its last end:
/// that stays a tip. Each sample has its line's kind for a type.
std::vector<SwcSample> swcOfCentrelines(const Centrelines& centrelines);

}  // namespace vasa
