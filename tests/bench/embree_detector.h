#pragma once
#include <embree3/rtcore.h>

#include <algorithm>

#include "collide/exclusions.h"
#include "collide/narrow_phase.h"

namespace vasa::bench {

/// Embree's own collision query (rtcCollide) over one box a tube, refit quality, with our exact test behind
/// it.
class EmbreeDetector {
 public:
  EmbreeDetector(std::span<const Bezier> rest, const Exclusions& exclusions)
      : exclusions_(exclusions),
        tree_(rest),
        device_(rtcNewDevice("threads=1")),
        scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
    rtcSetGeometryUserPrimitiveCount(geometry_, unsigned(rest.size()));
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, bounds, nullptr);
    rtcAttachGeometry(scene_, geometry_);
    fit(rest);
  }
  ~EmbreeDetector() {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeDetector(const EmbreeDetector&) = delete;
  EmbreeDetector& operator=(const EmbreeDetector&) = delete;

  std::span<const TubePair> detect(std::span<const Bezier> tubes) {
    fit(tubes);
    candidates_.clear();
    pairs_.clear();
    rtcCollide(scene_, scene_, collide, this);
    narrow_.settle(fastKernels(), tree_.view(), candidates_, 5e-8, pairs_);
    std::sort(pairs_.begin(), pairs_.end());
    return pairs_;
  }

 private:
  void fit(std::span<const Bezier> tubes) {
    tree_.setShape(tubes, 0);
    fastKernels().fitLeaves(tree_.view(), 0, tree_.groups(0));
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }
  // A step more than the tree's own box, for rounding.
  float edge(unsigned slot, int axis, bool high) const {
    const BoxGroup& group = tree_.boxes[slot / kGroup];
    const int steps = high ? group.high[axis][slot % kGroup] + 1 : group.low[axis][slot % kGroup] - 2;
    return tree_.grid.middle[axis] + float(steps) / tree_.grid.stepsPerMetre[axis];
  }
  bool overlap(unsigned a, unsigned b) const {
    const BoxGroup &first = tree_.boxes[a / kGroup], &second = tree_.boxes[b / kGroup];
    for (int axis = 0; axis < 3; ++axis)
      if (first.low[axis][a % kGroup] >= second.high[axis][b % kGroup] ||
          second.low[axis][b % kGroup] >= first.high[axis][a % kGroup])
        return false;
    return true;
  }
  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<EmbreeDetector*>(arguments->geometryUserPtr);
    const unsigned slot = arguments->primID;
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = self.edge(slot, 0, false), out.lower_y = self.edge(slot, 1, false),
    out.lower_z = self.edge(slot, 2, false);
    out.upper_x = self.edge(slot, 0, true), out.upper_y = self.edge(slot, 1, true),
    out.upper_z = self.edge(slot, 2, true);
  }
  // Embree reports pairs of leaves' primitives in both orders and with boxes that need not meet.
  static void collide(void* user, RTCCollision* collisions, unsigned count) {
    auto& self = *static_cast<EmbreeDetector*>(user);
    for (unsigned k = 0; k < count; ++k) {
      const unsigned a = collisions[k].primID0, b = collisions[k].primID1;
      if (a >= b || !self.overlap(a, b)) continue;
      const TubePair tubes{self.tree_.tubeAt(a), self.tree_.tubeAt(b)};
      if (!self.exclusions_.contains(tubes.i, tubes.j)) self.candidates_.push_back(tubes);
    }
  }

  const Exclusions& exclusions_;
  BoxTree tree_;
  NarrowPhase narrow_;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_ = nullptr;
  std::vector<TubePair> candidates_, pairs_;
};

}  // namespace vasa::bench
