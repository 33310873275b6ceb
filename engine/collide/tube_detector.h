#pragma once
#include <memory>
#include <span>

#include "collide/exclusions.h"
#include "collide/narrow_phase.h"
#include "curve/bezier.h"

namespace vasa {

struct DetectorOptions {
  /// [m] A pair is reported where f < -tolerance and not where f > tolerance; in between it may be either.
  double tolerance = 5e-8;
  /// Plain arithmetic, one lane: for tests.
  bool scalar = false;
};

/// The exact detector, the program's default: all pairs of tubes that intersect, and no others.
/// Method: an implicit 8-ary box tree of fixed topology, refit each frame; group-against-group traversal in
/// vector registers; chord capsules; then line-swept spheres around ever shorter pieces (Filip, Magedson,
/// Markot 1986), one level of all open pairs at a time, accepted early where the true curves at the nearest
/// parameters meet; what single precision leaves open goes to a certified branch and bound in double. What
/// two tubes were found to do holds for as long as neither moves: only what has moved is tested again.
///
///   TubeDetector detector(restTubes, exclusions);
///   each frame:  detector.update(tubes);  for (TubePair pair : detector.detect()) ...
///
/// The result does not depend on the number of threads or the instruction set (outside the tolerance). No
/// allocation once the working memory has grown to what the scene needs. One object serves one caller at a
/// time.
class TubeDetector {
 public:
  /// @param rest        tubes at rest: they decide the tree's topology, which lasts for the object's life
  /// @param exclusions  copied
  TubeDetector(std::span<const Bezier> rest, const Exclusions& exclusions, DetectorOptions options = {});
  ~TubeDetector();
  TubeDetector(TubeDetector&&) noexcept;

  /// Refits the tree to the present shape.
  /// @param tubes   as many as at rest, in the same order, all numbers finite; must stay in place until
  ///                detect() and contacts() are done
  /// @param margin  [m] >= 0; detect() then reports pairs with f < margin instead of f < 0
  void update(std::span<const Bezier> tubes, float margin = 0);

  /// Intersecting pairs that are not excluded, sorted; valid until the next call.
  std::span<const TubePair> detect();

  /// The nearest place of each pair that the last detect() returned, in its order: where the two come
  /// deepest. Found by Newton steps from the nearest of 4x4 chords, and where these end elsewhere than
  /// where the pair was found, by closestOfTubes(); the value is f there exactly. Valid until the next call.
  std::span<const Contact> contacts();

  /// A tube each: 1 where the last detect() saw another shape than the one before it, or was the first.
  std::span<const char> moved() const;

  /// What the last detect() did.
  using Statistics = NarrowPhase::Statistics;
  Statistics statistics() const;
  /// Memory of boxes, order and exclusions.
  std::size_t treeBytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vasa
