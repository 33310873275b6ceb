#pragma once
#include <span>
#include <vector>

#include "avoid/sides.h"
#include "collide/passages.h"
#include "scene/frame.h"

namespace vasa::cli {

/// How vessels lie to one another in a motion, by a look of its own: which have come to another side of one
/// another than at rest, and which passed through one another on the way to each frame from the one before.
class SideLook {
 public:
  explicit SideLook(const Network& network);

  /// On by a step of the way to a frame, of which next() then tells (FrameMaker::onStep).
  void step(const FrameMaker& maker);
  /// On to the frame that was made last.
  void next(const FrameMaker& maker);

  std::span<const RestSides::Turned> changed() const { return changed_; }
  std::span<const Passage> passed() const { return passed_; }
  /// How many passages there are where the body alone moves the vessels.
  std::size_t passedBefore() const { return passedBefore_; }

  /// Whether the way that was seen began at rest, and not at a frame that was known.
  bool isFromRest() const { return isFromRest_; }

 private:
  Interference interference_;
  RestSides sides_;
  PassageSearch search_;
  std::vector<Bezier> shape_, last_, posed_, lastPosed_;  // last ones are empty before the first step
  std::vector<RestSides::Turned> changed_;
  std::vector<Passage> passed_;
  std::size_t passedBefore_ = 0;
  bool isUnderWay_ = false;  // passages since the last frame go on being counted
  bool isFromRest_ = false;
};

}  // namespace vasa::cli
