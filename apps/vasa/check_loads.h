#pragma once
#include "realism/vessel_load.h"
#include "report.h"

namespace vasa::cli {

/// Which vessels a clip bends to a kink, makes too long or too short, or lengthens too fast: the worst of
/// each over the frames that were looked at.
class ClipLoads {
 public:
  /// @param network  at rest; must outlive this
  explicit ClipLoads(const Network& network)
      : network_(&network), meter_(network), worst_(network.vessels().size()) {}

  /// One frame after the other. @param points  as Network::points() @param avoider  of the same frame
  void look(std::uint32_t frame, std::span<const vec4> points, const Avoider& avoider);

  /// `kinked` (bend: radius by bending radius), `strained` (length_change) and `fast` (length_step, of one
  /// frame to the next): of each vessel beyond a limit the worst, in the order of vessels.
  Report report() const;

 private:
  struct Worst {
    float value = 0, place = 0;
    std::uint32_t frame = 0;
  };
  struct WorstOfVessel {
    Worst kink, strain, step;
  };
  const Network* network_;
  LoadMeter meter_;
  std::vector<WorstOfVessel> worst_;
  std::vector<float> lengths_;  // by those at rest, in the frame before
};

}  // namespace vasa::cli
