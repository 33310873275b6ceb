#pragma once
#include <string>
#include <vector>

#include "convert/attach.h"
#include "convert/element.h"
#include "convert/surface_error.h"

namespace vasa {

/// ok: at least kOkCoverage of the mesh's area is covered and 95 % of it lies within kOkError, or within half
/// the vessel's mean radius, of a wall. partial: at least kPartialCoverage is covered. failed: the rest.
/// doubtful: what would be ok or partial and is no human vessel: wider than kWidestVessel (centre lines,
/// too), or thinner than any that a mesh shows (another unit, a solid, a heart's chamber), or a flat sheet; a
/// centre line of more than kLongestInRadii.
enum class ElementStatus { ok, partial, failed, doubtful };
/// [m] mean radius: a large aneurysm of the aorta; what a surface's sections are raised to
constexpr float kWidestVessel = 0.03f, kThinnestVessel = ElementOptions{}.minimumRadius;
/// The great saphenous vein is some 400 of its radii long; metres beside millimetres make that 400,000.
constexpr double kLongestInRadii = 10'000;
/// Of a mesh's surface, either side counting the same: the length of the mean normal. Around a tube it is 2 /
/// π, in a plane 1, and around a flattened vein four times as wide as high this.
constexpr double kFlat = 0.92;
constexpr double kOkCoverage = 0.9, kPartialCoverage = 0.25;
constexpr float kOkError = 0.002f;  ///< [m]
std::string_view statusName(ElementStatus status);

struct ElementReport {
  std::string name;  ///< as in the input
  VesselKind kind = VesselKind::other;
  std::string ontologyId;
  ElementStatus status = ElementStatus::failed;
  std::string reason;  ///< what is missing or was degraded, or what the element repeats; may be empty for ok
  std::string method;  ///< of skeletonise
  bool duplicate = false;  ///< told by other elements, which its coverage is measured against
  std::uint32_t vessels = 0, sweeps = 0, triangles = 0;
  double area = 0, coverage = 0;
  ErrorStatistics error, backError;
};

struct ConvertSummary {
  std::uint32_t elements = 0, ok = 0, partial = 0, failed = 0, doubtful = 0, duplicates = 0;
  std::uint32_t vessels = 0, sweeps = 0, junctions = 0, components = 0;
  double coverage = 0;               ///< share of the area of all elements, failed ones included
  ErrorStatistics error, backError;  ///< over all elements that were measured
  double length = 0, arteryLength = 0, largestArterialTree = 0;  ///< [m]
  std::size_t meshBytes = 0;                                     ///< of all elements read
  float bodyHeight = 0;                                          ///< [m]
  AttachReport joins;
};

struct ConvertReport {
  std::vector<ElementReport> elements;
  ConvertSummary summary;
};

/// What is known of an element besides its measured errors.
struct ElementOutcome {
  std::string method, reason;
  std::vector<std::uint32_t> standIn;  ///< elements that tell what this one does not
  float moved = 0;  ///< [m] the farthest that its vessels were moved before it was measured
};

ConvertReport makeReport(const Assembly& assembly, std::span<const SourceElement> elements,
                         std::span<const ElementOutcome> outcomes, std::span<const ElementError> errors,
                         const AttachReport& joins);

}  // namespace vasa
