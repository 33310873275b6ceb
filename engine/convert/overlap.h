#pragma once
#include "convert/strand.h"

namespace vasa {

struct OverlapOptions {
  float axisRadii = 0.9f;     ///< an axis nearer than this share of the larger radius runs inside the other
  float radiusRatio = 2.0f;   ///< ... if their radii differ by no more than this factor
  float straightness = 0.8f;  ///< ... and they run along one another: least |cos| of their directions
  float dropShare = 0.8f;     ///< a strand with this share of its length inside longer ones goes
};

struct Absorbed {
  std::uint32_t element;  ///< that lost a strand
  std::uint32_t into;     ///< the element whose strand it ran inside
};

/// Anatomical data tells some stretches twice: the descending aorta, and its thoracic and abdominal parts.
/// Where a strand of another element of the same family runs along the same axis, the shorter one is dropped
/// when nearly all of it is told already, and otherwise cut back where its free ends run inside the other.
std::vector<Absorbed> removeOverlaps(StrandGraph& graph, const OverlapOptions& options = {});

}  // namespace vasa
