#include "realism/study.h"

#include <algorithm>
#include <cmath>

#include "body/mirror.h"
#include "body/retarget.h"
#include "core/cancellation.h"
#include "io/csv.h"
#include "realism/bone_gap.h"
#include "realism/path_measures.h"
#include "realism/vessel_path.h"

namespace vasa {
namespace {

constexpr int kSteps = 4;            // of the way to a pose
constexpr int kSweepSteps = 7;       // of a sweep
constexpr float kForkReach = 0.01f;  // [m] over which a branch's direction is taken
constexpr float kPerRange = 4;       // standard deviations that a range counts as
constexpr float kNoChange = 0.02f;   // of a figure's mean: less is no change in its direction

std::vector<JointAngles> otherSide(std::vector<JointAngles> pose) {
  for (JointAngles& angles : pose) {
    const bool middle = !hasSide(angles.part);
    angles.part = mirrored(angles.part);
    if (middle) angles.abduction = -angles.abduction, angles.twist = -angles.twist;
  }
  return pose;
}

/// The scene in one pose.
struct Posed {
  Pose pose;
  std::vector<vec4> points;
  std::vector<quat> rotations;
  mutable std::optional<PosedBones> bones;  // posed for the first row that asks
};

class Study {
 public:
  Study(const Scene& scene, const Protocol& protocol, FrameOptions options)
      : scene_(scene), protocol_(protocol), paths_(scene.network), maker_(scene, options) {}

  ProtocolResult resultOf(const ProtocolRow& row) {
    ProtocolResult result;
    result.onTheWay.assign(kSteps, 0);
    const bool both = hasSide(row.from) || hasSide(row.to);
    for (const bool mirror : {false, true}) {
      if (mirror && !both) break;
      for (int step = 1; step <= kSteps; ++step) {
        const auto value = valueOf(row, float(step) / kSteps, mirror);
        if (!value) {
          result.refusal = value.error().message;
          return result;
        }
        result.onTheWay[std::size_t(step - 1)] += *value / (both ? 2.0f : 1.0f);
      }
    }
    result.ours = result.onTheWay.back();
    judge(row, result);
    return result;
  }

  SweepCurve curveOf(const ProtocolSweep& sweep) {
    ProtocolRow row;
    row.from = sweep.from, row.to = sweep.to, row.metric = sweep.metric;
    row.firstPose = "rest", row.lastPose = sweep.pose;
    SweepCurve curve;
    for (int step = 0; step <= kSweepSteps; ++step) {
      const float share = float(step) / kSweepSteps;
      const auto value = valueOf(row, share, false);
      if (!value) return {value.error().message, {}, {}};
      curve.degrees.push_back(share * sweep.degrees);
      curve.values.push_back(*value);
    }
    return curve;
  }

 private:
  Result<const Posed*> posed(const std::string& name, float share, bool mirror) {
    const auto key = std::make_tuple(name, share, mirror);
    if (const auto found = posed_.find(key); found != posed_.end()) return &found->second;
    std::vector<JointAngles> angles;
    if (name != "rest") angles = protocol_.poses.find(name)->second;
    auto pose = poseByAngles(scene_.body.skeleton, mirror ? otherSide(angles) : angles, share);
    if (!pose) return pose.error();
    checkpoint();
    maker_.make(*pose);
    Posed made{std::move(*pose),
               {maker_.points().begin(), maker_.points().end()},
               {maker_.rotations().begin(), maker_.rotations().end()},
               {}};
    return &posed_.emplace(key, std::move(made)).first->second;
  }

  // @param share  of the way from the first pose to the last: a first pose that is not rest is left by the
  // same share
  Result<float> valueOf(const ProtocolRow& row, float share, bool mirror) {
    const auto first = posed(row.firstPose, 1, mirror), last = posed(row.lastPose, share, mirror);
    if (!first) return first.error();
    if (!last) return last.error();
    const std::string from = mirror ? mirrored(row.from) : row.from, to = mirror ? mirrored(row.to) : row.to;
    if (row.metric == PoseMetric::forkAngleChange) return forkAngleChange(from, to, **first, **last);
    const auto path = paths_.find(from, to, row.firstShare, row.lastShare);
    if (!path) return path.error();
    if (row.metric == PoseMetric::boneDistanceChange) {
      const auto knee = jointCalled(mirror ? "rightLowerLeg" : "leftLowerLeg");
      if (!knee) return knee.error();
      const auto gap = [&](const Posed& in) {
        if (!in.bones) in.bones.emplace(scene_.body, in.pose);
        return boneGap(*in.bones, *knee, row.level, scene_.network, *path, in.points);
      };
      return 1e3f * (gap(**last) - gap(**first));
    }
    const PathMeasures a = measurePath(scene_.network, *path, (*first)->points, (*first)->rotations);
    const PathMeasures b = measurePath(scene_.network, *path, (*last)->points, (*last)->rotations);
    return difference(row.metric, a, b);
  }

  static float difference(PoseMetric metric, const PathMeasures& a, const PathMeasures& b) {
    const float twist = glm::degrees(std::abs(b.twist - a.twist));
    switch (metric) {
      case PoseMetric::lengthChange:
        return 100 * (b.length / a.length - 1);
      case PoseMetric::lengthChangeMm:
        return 1e3f * (b.length - a.length);
      case PoseMetric::greatestShortening:
        return -100 * b.leastStrain;
      case PoseMetric::twist:
        return twist;
      case PoseMetric::twistPerCm:
        return twist / (100 * a.length);
      case PoseMetric::greatestTwistPerCm:
        return 0.01f * glm::degrees(b.greatestTwist);
      case PoseMetric::curvatureChange:
        return 0.01f * (b.meanCurvature - a.meanCurvature);
      case PoseMetric::curvatureChangePercent:
        return 100 * (b.meanCurvature / a.meanCurvature - 1);
      case PoseMetric::leastBendRadius:
        return 1e3f * b.leastBendRadius;
      case PoseMetric::chordByArc:
        return 100 * b.chordByArc;
      case PoseMetric::radiusChange:
        return 100 * (b.meanRadius / a.meanRadius - 1);
      case PoseMetric::boneDistanceChange:
      case PoseMetric::forkAngleChange:
        break;
    }
    return 0;
  }

  Result<JointId> jointCalled(std::string_view part) const {
    const HumanoidNames known = partsOf(scene_.body.skeleton);
    const auto found = std::ranges::find(known.of, part);
    if (found == known.of.end())
      return badInput("no joint of this skeleton is known to be " + csv::quoted(part));
    return JointId{std::uint32_t(found - known.of.begin())};
  }

  // Both branches begin where they part.
  Result<float> forkAngleChange(const std::string& one, const std::string& other, const Posed& first,
                                const Posed& last) {
    const auto a = paths_.find(one, one + (one.find('@') == one.npos ? "@end" : "")),
               b = paths_.find(other, other + (other.find('@') == other.npos ? "@end" : ""));
    if (!a) return a.error();
    if (!b) return b.error();
    const auto direction = [&](const VesselPath& path, const Posed& posed) {
      const auto far = std::ranges::find_if(
          path.stations, [](const VesselPath::Station& s) { return s.rest >= kForkReach; });
      const auto at = [&](const VesselPath::Station& s) {
        return vec3(evaluate(Network::pointsOf(scene_.network.vessel(s.vessel), posed.points), s.parameter));
      };
      return glm::normalize(at(far == path.stations.end() ? path.stations.back() : *far) -
                            at(path.stations.front()));
    };
    const auto angle = [&](const Posed& posed) {
      return std::acos(std::clamp(glm::dot(direction(*a, posed), direction(*b, posed)), -1.0f, 1.0f));
    };
    const float before = angle(first);
    if (!(before > 0.02f)) return badInput(one + " and " + other + " leave in the same direction");
    return 100 * (angle(last) / before - 1);
  }

  static void judge(const ProtocolRow& row, ProtocolResult& result) {
    const bool changes = row.metric != PoseMetric::leastBendRadius && row.metric != PoseMetric::chordByArc;
    const bool single = row.low && row.high && *row.low < 0 && *row.high > 0;  // a range about no change
    if (changes && !single && row.mean != 0)
      result.rightSign = result.ours * (row.mean > 0 ? 1 : -1) > kNoChange * std::abs(row.mean);
    if (row.deviation)
      result.deviations = (result.ours - row.mean) / *row.deviation;
    else if (row.low && row.high)
      result.deviations = kPerRange * (result.ours - 0.5f * (*row.low + *row.high)) / (*row.high - *row.low);
  }

  const Scene& scene_;
  const Protocol& protocol_;
  PathFinder paths_;
  FrameMaker maker_;
  std::map<std::tuple<std::string, float, bool>, Posed> posed_;
};

}  // namespace

RealismStudy studyRealism(const Scene& scene, const Protocol& protocol, FrameOptions options) {
  RealismStudy all;
  Study study(scene, protocol, options);
  for (const ProtocolRow& row : protocol.rows) {
    const ProtocolResult& result = all.results.emplace_back(study.resultOf(row));
    RealismScore& score = row.blind ? all.blind : all.tuned;
    if (!result.refusal.empty()) continue;
    ++score.usable;
    if (result.rightSign) ++score.signed_, score.rightSign += *result.rightSign;
    if (result.deviations)
      ++score.banded, score.withinOne += result.within(1), score.withinTwo += result.within(2);
  }
  for (const ProtocolSweep& sweep : protocol.sweeps) all.curves.push_back(study.curveOf(sweep));
  return all;
}

}  // namespace vasa
