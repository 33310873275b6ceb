#include "make_human/layout.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "body/bowing.h"
#include "make_human/taper.h"
#include "make_human/through.h"

// A row's curve passes through its waypoints and the points of the vessels it leaves and joins.
namespace vasa::human {
namespace {

constexpr float kSampleStep = 0.0035f;
// Tolerances of splines [m]. Thin vessels lie where there is little room: in fingers, toes and face.
constexpr float kFitOfRadius = 1.2f, kCoarsestFit = 1.2e-3f, kFitOfThin = 0.5e-3f, kThin = 0.7e-3f;
constexpr float kFinestFit = 0.2e-3f, kRefinement = 0.65f;

float toleranceOf(const VesselRow& row) {
  const float radius = 0.5f * (row.startRadius + row.endRadius);
  return radius < kThin ? kFitOfThin : std::min(kFitOfRadius * radius, kCoarsestFit);
}

constexpr float kBowSpan = kBowWave / 4;  // [m] the longest of vessels that bow out of a bend

constexpr float kSinkReach = 0.025f;  // of the course, to either side, that goes down along with a place

}  // namespace

/// Makes the courses on demand, hosts first.
class LayoutMaker {
 public:
  using Stretch = VesselLayout::Stretch;

  LayoutMaker(VesselRows& table, const Surroundings& around)
      : table_(table), rows_(table.rows()), stretches_(layout_.stretches_), courses_(layout_.courses_) {
    layout_.rows_ = rows_;
    layout_.around_ = &around;
    stretches_.resize(rows_.size());
    for (const VesselRow& row : rows_) layout_.tolerances_.push_back(toleranceOf(row));
    findSharedEnds();
  }

  Result<VesselLayout> run() {
    for (int i = 0; i < int(rows_.size()) && state_.ok(); ++i) make(i);
    if (!state_.ok()) return state_.error();
    anchor();
    return std::move(layout_);
  }

 private:
  /// Ends that hang on a vessel or that a vessel hangs on.
  void findSharedEnds() {
    isShared_.assign(rows_.size(), false);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].target.kind != Attachment::Kind::none) isShared_[i] = true;
      for (const Attachment* at : {&rows_[i].source, &rows_[i].target})
        if (at->kind == Attachment::Kind::end || at->kind == Attachment::Kind::continues)
          isShared_[std::size_t(at->vessel)] = true;
    }
  }

  Course::Anchor anchorOf(const Attachment& attachment) const {
    const Stretch& host = stretches_[std::size_t(attachment.vessel)];
    const float first = float(host.first), last = float(host.last);
    switch (attachment.kind) {
      case Attachment::Kind::start:
        return {host.course, first};
      case Attachment::Kind::side:
        return {host.course, glm::mix(first, last, attachment.fraction)};
      default:
        return {host.course, last};
    }
  }

  vec3 pointOf(const Attachment& attachment) {
    make(attachment.vessel);
    if (!state_.ok()) return vec3(0);
    const Course::Anchor anchor = anchorOf(attachment);
    return placeOn(courses_[std::size_t(anchor.course)], anchor.at);
  }

  void fault(int row, const char* what) {
    if (state_.ok()) state_ = table_.fault(rows_[std::size_t(row)], what);
  }

  /// Makes the whole course of rows that continue one another around row i.
  void make(int i) {
    if (!state_.ok() || stretches_[std::size_t(i)].course >= 0) return;
    while (rows_[std::size_t(i)].source.kind == Attachment::Kind::continues)
      i = rows_[std::size_t(i)].source.vessel;
    if (stretches_[std::size_t(i)].begun) return fault(i, "this vessel hangs on itself");
    stretches_[std::size_t(i)].begun = true;
    std::vector<vec3> waypoints;
    std::vector<std::size_t> ends;
    if (rows_[std::size_t(i)].source.kind != Attachment::Kind::none)
      waypoints.push_back(pointOf(rows_[std::size_t(i)].source));
    for (int k = i; k >= 0; k = rows_[std::size_t(k)].next) {
      const VesselRow& row = rows_[std::size_t(k)];
      stretches_[std::size_t(k)].begun = true;
      waypoints.insert(waypoints.end(), row.waypoints.begin(), row.waypoints.end());
      if (row.target.kind != Attachment::Kind::none) waypoints.push_back(pointOf(row.target));
      if (waypoints.size() < 2 || (!ends.empty() && waypoints.size() - 1 == ends.back()))
        return fault(k, "a vessel needs two points");
      ends.push_back(waypoints.size() - 1);
    }
    if (state_.ok()) sample(i, ThroughPoints(waypoints), ends);
  }

  void sample(int first, const ThroughPoints& curve, const std::vector<std::size_t>& ends) {
    Course course;
    float start = 0;
    int row = first;
    for (std::size_t end : ends) {
      const VesselRow& r = rows_[std::size_t(row)];
      Stretch& stretch = stretches_[std::size_t(row)];
      const float length = curve.lengthAt(end) - start;
      const int steps = std::max(4, int(std::ceil(length / kSampleStep)));
      std::vector<float> radii;
      for (int k = 0; k <= steps; ++k)
        radii.push_back(glm::mix(r.startRadius, r.endRadius, float(k) / float(steps)));
      if (!isShared_[std::size_t(row)]) thinOut(radii, length, length);
      stretch.course = int(courses_.size());
      stretch.first = std::uint32_t(course.points.empty() ? 0 : course.points.size() - 1);
      for (int k = course.points.empty() ? 0 : 1; k <= steps; ++k) {
        course.points.push_back(curve.position(start + float(k) / float(steps) * length));
        course.radii.push_back(radii[std::size_t(k)]);
        course.belowSkin.push_back(r.belowSkin);
      }
      stretch.last = std::uint32_t(course.points.size() - 1);
      start += length;
      row = r.next;
    }
    courses_.push_back(std::move(course));
  }

  void anchor() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      Course& course = courses_[std::size_t(stretches_[i].course)];
      if (rows_[i].source.kind != Attachment::Kind::none &&
          rows_[i].source.kind != Attachment::Kind::continues)
        course.start = anchorOf(rows_[i].source);
      if (rows_[i].target.kind != Attachment::Kind::none) course.end = anchorOf(rows_[i].target);
    }
  }

  VesselRows& table_;
  const std::vector<VesselRow>& rows_;
  VesselLayout layout_;
  std::vector<Stretch>& stretches_;
  std::vector<Course>& courses_;
  std::vector<bool> isShared_;  // a row's end
  Result<void> state_;
};

Result<VesselLayout> VesselLayout::make(VesselRows& table, const Surroundings& around) {
  return LayoutMaker(table, around).run();
}

void VesselLayout::sink(std::size_t vessel, float share, float by) {
  const Stretch& stretch = stretches_[vessel];
  Course& course = courses_[std::size_t(stretch.course)];
  const std::size_t middle = stretch.first + std::size_t(share * float(stretch.last - stretch.first));
  const int reach = int(kSinkReach / kSampleStep);
  for (int k = -reach; k <= reach; ++k) {
    const int i = int(middle) + k;
    if (i < 0 || i >= int(course.points.size())) continue;
    const float t = float(std::abs(k)) / float(reach), deep = by * (1 - t * t);
    const float now = around_->depth(course.points[std::size_t(i)]) - course.radii[std::size_t(i)];
    float& wanted = course.belowSkin[std::size_t(i)];
    wanted = std::max(wanted, now + deep);
  }
}

bool VesselLayout::refine(std::size_t vessel) {
  float& tolerance = tolerances_[vessel];
  if (tolerance <= kFinestFit) return false;
  tolerance = std::max(kRefinement * tolerance, kFinestFit);
  return true;
}

std::vector<LaidVessel> VesselLayout::fitted() const {
  std::vector<LaidVessel> result;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const VesselRow& row = rows_[i];
    const Stretch& stretch = stretches_[i];
    const Course& course = courses_[std::size_t(stretch.course)];
    const std::vector<vec3>& all = course.points;
    const auto tangent = [&](std::size_t k) {
      return glm::normalize(all[std::min(k + 1, all.size() - 1)] - all[k > 0 ? k - 1 : 0]);
    };
    const std::size_t count = stretch.last - stretch.first + 1;
    std::vector<float> radii(course.radii.begin() + stretch.first, course.radii.begin() + stretch.last + 1);
    radii.front() = row.startRadius;  // where it continues another, the course has that one's
    result.push_back({row.label,
                      fitCourse(std::span(all).subspan(stretch.first, count), radii, tangent(stretch.first),
                                tangent(stretch.last), tolerances_[i]),
                      row.source, row.target});
  }
  return result;
}

std::vector<vec4> fitCourse(std::span<const vec3> points, std::span<const float> radii, vec3 startTangent,
                            vec3 endTangent, float tolerance) {
  const ThroughPoints curve(points);
  const std::size_t count = points.size();
  const float length = curve.lengthAt(count - 1);
  const bool bows = *std::ranges::max_element(radii) >= kBowRadius;
  const int least = bows ? std::max(2, int(std::ceil(length / kBowSpan))) : 2;
  const int most = std::max(least, int(length / (12 * tolerance)));
  std::vector<vec4> result;
  for (int spans = least; spans <= most; ++spans) {
    std::vector<vec3> knots;
    for (int k = 0; k <= spans; ++k) knots.push_back(curve.position(length * float(k) / float(spans)));
    const std::vector<vec3> fitted = interpolateAtKnots(knots, startTangent, endTangent);
    result.clear();
    for (std::size_t k = 0; k < fitted.size(); ++k) {
      // Where this point belongs to along the curve (Greville): the mean of its three inner knots.
      const auto knot = [&](float at) { return std::clamp(at / float(spans), 0.0f, 1.0f); };
      const float u = (knot(float(k) - 2) + knot(float(k) - 1) + knot(float(k))) / 3;
      const float at = u * float(count - 1);
      const std::size_t i = std::min(std::size_t(at), count - 2);
      result.emplace_back(fitted[k], glm::mix(radii[i], radii[i + 1], at - float(i)));
    }
    bool good = true;
    for (std::size_t i = 1; i + 1 < count && good; ++i) {
      const vec3 off = vec3(evaluate(result, curve.lengthAt(i) / length * float(spans))) - points[i];
      const vec3 along = glm::normalize(points[i + 1] - points[i - 1]);
      good = glm::length(off - glm::dot(off, along) * along) <=
                 tolerance + std::min(radii[i] / 8, tolerance / 2) &&
             glm::length(off) <= 4 * tolerance;
    }
    if (good) break;
  }
  return result;
}

Result<Network> joinVessels(const std::vector<LaidVessel>& vessels, float bodyHeight) {
  NetworkBuilder builder;
  for (const LaidVessel& vessel : vessels) builder.addVessel(vessel.label, vessel.points);
  // Ends that share a place, by the end they all refer to.
  std::map<std::pair<int, bool>, std::vector<VesselEnd>> shared;
  const auto attach = [&](VesselEnd end, const Attachment& at) {
    if (at.kind == Attachment::Kind::none) return;
    const VesselId host{std::uint32_t(at.vessel)};
    if (at.kind == Attachment::Kind::side)
      builder.joinToSide(end, {host, at.fraction * float(builder.pointsOf(host).size() - 3)});
    else
      shared[{at.vessel, at.kind != Attachment::Kind::start}].push_back(end);
  };
  for (std::size_t i = 0; i < vessels.size(); ++i) {
    attach({VesselId{std::uint32_t(i)}, false}, vessels[i].source);
    attach({VesselId{std::uint32_t(i)}, true}, vessels[i].target);
  }
  for (auto& [place, ends] : shared) {
    ends.insert(ends.begin(), {VesselId{std::uint32_t(place.first)}, place.second});
    builder.joinEnds(ends);
  }
  return builder.build(bodyHeight);
}

}  // namespace vasa::human
