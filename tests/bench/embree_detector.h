#pragma once
#include <embree3/rtcore.h>

#include <algorithm>

#include "collide/closest_tubes.h"

namespace vasa::bench {

/// Embree's own collision query (rtcCollide) over one box a tube, refit quality, with our exact test behind
/// it.
class EmbreeDetector {
 public:
  EmbreeDetector(std::span<const Bezier> rest, const Exclusions& exclusions)
      : exclusions_(exclusions),
        boxes_(rest.size()),
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
    std::sort(candidates_.begin(), candidates_.end());
    candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
    for (const TubePair pair : candidates_)
      if (!exclusions_.contains(pair.i, pair.j) && tubesIntersect(tubes[pair.i], tubes[pair.j], 5e-8))
        pairs_.push_back(pair);
    return pairs_;
  }

 private:
  void fit(std::span<const Bezier> tubes) {
    for (std::size_t i = 0; i < tubes.size(); ++i) boxes_[i] = tubes[i].bounds();
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }
  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const Aabb& box = static_cast<EmbreeDetector*>(arguments->geometryUserPtr)->boxes_[arguments->primID];
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = box.low.x, out.lower_y = box.low.y, out.lower_z = box.low.z;
    out.upper_x = box.high.x, out.upper_y = box.high.y, out.upper_z = box.high.z;
  }
  static void collide(void* self, RTCCollision* collisions, unsigned count) {
    auto& detector = *static_cast<EmbreeDetector*>(self);
    for (unsigned k = 0; k < count; ++k) {
      const unsigned a = collisions[k].primID0, b = collisions[k].primID1;
      if (a != b && detector.boxes_[a].overlaps(detector.boxes_[b]))
        detector.candidates_.push_back(orderedPair(a, b));
    }
  }

  const Exclusions& exclusions_;
  std::vector<Aabb> boxes_;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_ = nullptr;
  std::vector<TubePair> candidates_, pairs_;
};

}  // namespace vasa::bench
