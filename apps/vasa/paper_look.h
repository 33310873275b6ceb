#pragma once
#include "collide/network_tubes.h"
#include "collide/paper_detector.h"
#include "collide/tube_detector.h"
#include "report.h"

namespace vasa::cli {

constexpr float kPaperTolerance = 1e-3f;  ///< of the body height (the paper, section 5)

/// A network's shapes as the source paper's detection sees them, beside the exact one: which pairs of tubes
/// run through one another (neighbours along the network left out), and how long finding them takes.
/// Tolerance: the paper's 1e-3 of the body height. The paper's takes one thread, the exact one as many as
/// there are.
class PaperLook {
 public:
  /// @param network  must outlive this
  explicit PaperLook(const Network& network);

  /// The exact pairs, the paper's, those of the paper's that do not intersect and those that it misses.
  struct Pairs {
    std::size_t exact = 0, paper = 0, wrong = 0, missed = 0;
    double exactMs = 0, paperMs = 0;  ///< [ms] fitting the tree to the shape, and detection
  };
  Pairs at(std::span<const vec4> points);

 private:
  NetworkTubes layout_;
  std::vector<Bezier> rest_, tubes_;
  PaperDetector paper_;
};

/// Adds a frame's counts: keys that begin with exact_ and paper_, of the posed network and of the one moved
/// apart.
void addPaperLook(const PaperLook::Pairs& before, const PaperLook::Pairs& after, Report& row);

}  // namespace vasa::cli
