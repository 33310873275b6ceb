#pragma once
#include "collide/exclusions.h"
#include "collide/sphere_tree.h"

namespace vasa {

/// The paper's detection (Park, Shim, Park, Kang, Kim 2013, §5): the yardstick, not what the program uses.
/// A sphere tree finds pairs of sweeps; each pair is settled by two trees of line-swept spheres made on the
/// fly: overlapping and ε1 + ε2 below the tolerance, or no finer level left -> reported; else the bigger one
/// is descended. It therefore over-reports: every intersecting pair is found, and some that miss by up to the
/// tolerance and more. A small tolerance decides more precisely, for more work.
class PaperDetector {
 public:
  /// @param exclusions  must outlive the detector
  /// @param tolerance   [m] the paper's: 1e-3 of the body height
  PaperDetector(std::span<const Bezier> rest, const Exclusions& exclusions, float tolerance = 1e-3f);

  /// Refits the sphere tree to the present shape, which must stay in place until detect() is done.
  void update(std::span<const Bezier> tubes);

  /// Reported pairs, sorted; valid until the next call. One thread.
  std::span<const TubePair> detect();

  const SphereTree& tree() const { return tree_; }

 private:
  struct NodePair {
    std::uint32_t level, a, b;
  };
  void meet(std::uint32_t a, std::uint32_t b);

  const Exclusions& exclusions_;
  float tolerance_;
  SphereTree tree_;
  std::span<const Bezier> tubes_;
  std::vector<NodePair> stack_;
  std::vector<TubePair> pairs_;
};

/// The lower level alone: whether the paper's trees of line-swept spheres report the two tubes.
bool sweptSpheresMeet(const Bezier& a, const Bezier& b, float tolerance);

}  // namespace vasa
