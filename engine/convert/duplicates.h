#pragma once
#include <optional>
#include <span>

#include "convert/source.h"

namespace vasa {

struct DuplicateOptions {
  /// How near another surface must be: this share of the element's own mean radius ...
  float toleranceRadii = 0.6f;
  /// ... but within these [m].
  float toleranceMin = 0.0002f, toleranceMax = 0.0015f;
  /// The share of the surface that must lie on others for the element to say nothing new.
  float covered = 0.85f;
  std::uint32_t samples = 400;
};

/// Which elements repeat others: an element whose surface lies (nearly) wholly on one other kept element of
/// its family. Of two that cover each other the one with the smaller area goes, of equals the later one.
/// @return for each element the index of the one that covers it, a kept one; nothing for those to keep.
/// Every element is compared with those whose boxes it overlaps; parallel.
std::vector<std::optional<std::uint32_t>> findDuplicates(std::span<const SourceElement> elements,
                                                         const DuplicateOptions& options = {});

/// A tube's mean radius [m] judged from its mesh alone: twice the enclosed volume over the area; open ends
/// and tears make it rough. At least a thousandth of the box's diagonal.
float roughRadius(const TriangleMesh& mesh);

}  // namespace vasa
