#include "side_look.h"

#include <utility>

namespace vasa::cli {

SideLook::SideLook(const Network& network)
    : interference_(network),
      sides_(network, interference_),
      search_(interference_.restTubes(), interference_.layout().neighbours()) {}

void SideLook::step(const FrameMaker& maker) {
  if (!std::exchange(isUnderWay_, true)) passed_.clear(), passedBefore_ = 0;
  if (shape_.empty()) isFromRest_ = maker.report().steps == 0;
  last_.swap(shape_);
  lastPosed_.swap(posed_);
  shape_.resize(interference_.layout().count());
  posed_.resize(shape_.size());
  interference_.layout().shape(maker.points(), shape_);
  interference_.layout().shape(maker.posedPoints(), posed_);
  if (last_.empty()) return;
  passedBefore_ += search_.find(lastPosed_, posed_).size();
  const std::span<const Passage> found = search_.find(last_, shape_);
  passed_.insert(passed_.end(), found.begin(), found.end());
}

void SideLook::next(const FrameMaker& maker) {
  const bool isFirst = shape_.empty();  // it was known, and no step led to it
  step(maker);
  if (isFirst) isFromRest_ = false;
  isUnderWay_ = false;
  sides_.findChanged(shape_, maker.rotations(), changed_);
}

}  // namespace vasa::cli
