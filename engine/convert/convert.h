#pragma once
#include <functional>

#include "convert/attach.h"
#include "convert/duplicates.h"
#include "convert/element.h"
#include "convert/overlap.h"
#include "convert/report.h"
#include "convert/slivers.h"

namespace vasa {

struct ConvertOptions {
  ElementOptions element;
  DuplicateOptions duplicates;
  SliverOptions slivers;
  OverlapOptions overlaps;
  AttachOptions attach;
  StrandFitOptions fit;
  SurfaceErrorOptions error;
  float bodyHeight = 0;  ///< [m]; 0: the largest extent of the input
  std::function<Result<Network>(const Network&)>
      mend;  ///< what is done to the network before it is measured; may be empty
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< elements, from any thread
};

struct Conversion {
  Network network;
  ConvertReport report;
  std::vector<std::uint32_t> elementOf;  ///< vessel -> element
  /// The elements with every wall that has an inside and an outside by its lumen alone (convert/hollow.h);
  /// and without those that are outsides of others' walls; empty where there is none.
  std::vector<SourceElement> lumina = {};
  std::vector<std::string> outerWalls = {};  ///< names of the latter
};

/// Polygonal vessels to one network: drop what repeats, skeletonise each element in parallel, join forks and
/// separate elements, fit splines, measure. The result does not depend on the number of threads. Shows a
/// progress line on a terminal.
/// Fails with badInput where no element gives a vessel; can be cancelled (core/cancellation.h), also within
/// an element.
Result<Conversion> convertElements(std::span<const SourceElement> elements,
                                   const ConvertOptions& options = {});

}  // namespace vasa
