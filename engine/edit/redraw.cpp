#include "edit/redraw.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "curve/arc_length.h"

// Old knots up to `first` and from `last` on stay; between them lie `count` new spans. Of the points, old d_0
// .. d_{first+1} and from d_{last+1} on stay, which leaves the spans before first-1 and behind last+1 as they
// are and joins the rest to them with two continuous derivatives. Where the vessel is drawn anew up to its
// end, the end point alone is given.
namespace vasa {
namespace {

constexpr float kGrowth = 0.4f;  // of a step, by which the next may be longer
constexpr int kPlaces = 6;       // of a span, at which it is fitted
constexpr int kFitRounds = 5;    // of fitting and moving places
constexpr int kHalvings = 1;     // shorter spans than that bend with the rounding of a file's coordinates
constexpr float kCentreShare = 0.02f, kRadiusShare = 0.003f;
constexpr std::uint32_t kMostSpans = 20000;

// A smooth map from whole numbers to places: a natural cubic spline through the knots.
class KnotMap {
 public:
  explicit KnotMap(std::vector<double> knots) : at_(std::move(knots)), bend_(at_.size(), 0) {
    // Second derivatives m of it: m[i-1] + 4 m[i] + m[i+1] = 6 (second difference), swept once down and once
    // up.
    const std::size_t n = at_.size();
    std::vector<double> factor(n, 0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double pivot = 4 - factor[i - 1];
      factor[i] = 1 / pivot;
      bend_[i] = (6 * (at_[i + 1] - 2 * at_[i] + at_[i - 1]) - bend_[i - 1]) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 1;) bend_[i] -= factor[i] * bend_[i + 1];
  }
  double at(double u) const {
    const std::size_t i = std::min(std::size_t(std::max(u, 0.0)), at_.size() - 2);
    const double t = u - double(i), s = 1 - t;
    return s * at_[i] + t * at_[i + 1] + ((s * s * s - s) * bend_[i] + (t * t * t - t) * bend_[i + 1]) / 6;
  }

 private:
  std::vector<double> at_, bend_;
};

struct OldCourse {
  std::span<const vec4> points;
  ArcLength arc;
  std::uint32_t spans;
  std::vector<float> knots;  // [m] along
  const Redrawing& redrawing;

  vec4 at(float along) const {
    const vec4 was = evaluate(points, arc.parameterAt(along));
    return redrawing.shape && along >= redrawing.from && along <= redrawing.to ? redrawing.shape(along, was)
                                                                               : was;
  }
  // [m] the length of spans around a knot, and between knots
  float spanAt(std::uint32_t knot) const {
    const std::uint32_t before = knot > 0 ? knot - 1 : 0, after = std::min(knot + 1, spans);
    return (knots[after] - knots[before]) / float(after - before);
  }
  float spanAlong(float along) const {
    const float u = arc.parameterAt(along);
    const auto knot = std::min(std::uint32_t(u), spans - 1);
    return std::lerp(spanAt(knot), spanAt(knot + 1), u - float(knot));
  }
};

struct Layout {
  bool startOpen = false, endOpen = false;  // drawn anew up to the end of what is kept
  std::uint32_t first = 0, last = 0;        // old knots
  float low = 0, high = 0;                  // [m] between which the new spans lie
  std::uint32_t count = 0;                  // of them
  std::vector<double> inner;                // [m] the new knots, both ends included
};

Layout layOut(const OldCourse& old, float step) {
  const Redrawing& r = old.redrawing;
  const float keepTo = std::min(r.keepTo, old.arc.length());
  const auto wanted = [&](float along) {
    const float off = std::max({r.from - along, along - r.to, 0.0f});
    return std::min(old.spanAlong(along), step + kGrowth * off);
  };
  Layout layout;
  const auto settles = [&](std::uint32_t knot) {
    return step + kGrowth * std::max({r.from - old.knots[knot], old.knots[knot] - r.to, 0.0f}) >=
           old.spanAt(knot);
  };
  layout.startOpen = layout.endOpen = true;
  layout.low = r.keepFrom, layout.high = keepTo, layout.last = old.spans;
  for (std::uint32_t k = 1; r.keepFrom <= 0 && k + 1 < old.spans; ++k)
    if (old.knots[k + 1] <= std::min(r.from, keepTo) && settles(k))
      layout.startOpen = false, layout.first = k, layout.low = old.knots[k];
  for (std::uint32_t k = old.spans - 1; keepTo >= old.arc.length() && k > layout.first + 1; --k)
    if (old.knots[k - 1] >= std::max(r.to, r.keepFrom) && settles(k))
      layout.endOpen = false, layout.last = k, layout.high = old.knots[k];
  // Knots at equal increments of the integral of 1 / wanted.
  const int kParts =
      16 * int(old.spans) + 64 + int(16 * std::min((layout.high - layout.low) / step, 4000.0f));
  std::vector<double> sum{0};
  for (int k = 0; k < kParts; ++k)
    sum.push_back(sum.back() +
                  double(layout.high - layout.low) / kParts /
                      double(wanted(std::lerp(layout.low, layout.high, (float(k) + 0.5f) / float(kParts)))));
  layout.count = std::min(
      std::max(layout.startOpen || layout.endOpen ? 1u : 2u, std::uint32_t(std::ceil(sum.back() - 0.05))),
      kMostSpans);
  std::size_t part = 0;
  for (std::uint32_t i = 0; i <= layout.count; ++i) {
    const double want = sum.back() * i / layout.count;
    while (part + 2 < sum.size() && sum[part + 1] < want) ++part;
    const double share = (want - sum[part]) / (sum[part + 1] - sum[part]);
    layout.inner.push_back(layout.low + (double(part) + share) / kParts * double(layout.high - layout.low));
  }
  return layout;
}

class Fitter {
 public:
  Fitter(const OldCourse& old, const Layout& layout) : old_(old), layout_(layout) {
    const std::uint32_t head = layout.startOpen ? 0 : layout.first,
                        tail = layout.endOpen ? 0 : old.spans - layout.last;
    spans_ = head + layout.count + tail;
    points_.assign(spans_ + 3, vec4(0));
    firstFree_ = layout.startOpen ? 1 : layout.first + 2;
    freeEnd_ = layout.endOpen ? spans_ + 2 : head + layout.count + 1;
    for (std::uint32_t j = 0; j < firstFree_; ++j)
      points_[j] = layout.startOpen ? old.at(layout.low) : old.points[j];
    for (std::uint32_t j = freeEnd_; j < points_.size(); ++j)
      points_[j] = layout.endOpen ? old.at(layout.high) : old.points[j + old.spans - spans_];
    head_ = head;
    std::vector<double> knots;
    for (std::uint32_t k = 0; k < head; ++k) knots.push_back(old.knots[k]);
    knots.insert(knots.end(), layout.inner.begin(), layout.inner.end());
    for (std::uint32_t k = 1; k <= tail; ++k) knots.push_back(old.knots[layout.last + k]);
    map_.emplace(std::move(knots));
  }

  void run() {
    std::vector<Sample>& samples = samples_;
    const Redrawing& r = old_.redrawing;
    const float low = r.keepFrom, high = std::min(r.keepTo, old_.arc.length());
    const std::uint32_t from = layout_.startOpen ? 0 : head_ - 1,
                        to = std::min(spans_, head_ + layout_.count + (layout_.endOpen ? 0 : 1));
    for (std::uint32_t span = from; span < to; ++span)
      for (int k = 0; k < kPlaces; ++k) {
        const float t = (float(k) + 0.5f) / kPlaces;
        samples.push_back({span, t, float(map_->at(double(span) + double(t)))});
        // Old spans at the borders begin with their own places.
        if (span < head_) samples.back().along = old_.arc.along(float(span) + t);
        if (span >= head_ + layout_.count)
          samples.back().along = old_.arc.along(float(span) + t + float(old_.spans) - float(spans_));
      }
    const int unknowns = int(freeEnd_) - int(firstFree_);
    for (int round = 0; round < kFitRounds; ++round) {
      std::vector<Eigen::Triplet<double>> entries;
      Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, 4);
      for (const Sample& sample : samples) {
        const vec4 w = deBoorWeights(sample.span, spans_, sample.t);
        dvec4 rest(old_.at(sample.along));
        for (int k = 0; k < 4; ++k)
          if (row(sample.span, k) < 0) rest -= double(w[k]) * dvec4(points_[sample.span + std::uint32_t(k)]);
        for (int k = 0; k < 4; ++k) {
          const int i = row(sample.span, k);
          if (i < 0) continue;
          for (int axis = 0; axis < 4; ++axis) right(i, axis) += double(w[k]) * rest[axis];
          for (int l = 0; l < 4; ++l)
            if (const int j = row(sample.span, l); j >= 0 && j <= i)
              entries.emplace_back(i, j, double(w[k]) * double(w[l]));
        }
      }
      Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
      matrix.setFromTriplets(entries.begin(), entries.end());
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>
          factor(matrix);
      const Eigen::MatrixXd x = factor.solve(right);
      for (int i = 0; i < unknowns; ++i)
        points_[firstFree_ + std::uint32_t(i)] = vec4(x(i, 0), x(i, 1), x(i, 2), x(i, 3));
      centreError_ = radiusError_ = 0;
      worst_ = 0;
      for (Sample& sample : samples) {
        const Bezier segment = bezierOfSpan(points_, sample.span);
        const vec4 is = segment.at(sample.t), want = old_.at(sample.along);
        const vec3 off = vec3(is) - vec3(want);
        const vec3 derivative(segment.derivative(sample.t));
        const float speed = glm::length(derivative);
        const vec3 tangent = speed > 0 ? derivative / speed : vec3(0);
        const float ahead = glm::dot(off, tangent), aside = glm::length(off - ahead * tangent);
        centreError_ = std::max(centreError_, aside);
        radiusError_ = std::max(radiusError_, std::abs(is.w - want.w) / want.w);
        // A narrowed lumen asks for no truer course.
        const float wide = evaluate(old_.points, old_.arc.parameterAt(sample.along)).w;
        worst_ = std::max(
            {worst_, aside / (kCentreShare * wide), std::abs(is.w - want.w) / (kRadiusShare * wide)});
        sample.along = std::clamp(sample.along + ahead, low, high);
      }
    }
  }

  bool fits() const {
    return worst_ <= 1 && std::ranges::all_of(points_, [](const vec4& p) {
             return p.w > 0 && std::isfinite(p.w + p.x + p.y + p.z);
           });
  }

  Redrawn result() const {
    Redrawn out;
    out.points = points_;
    out.centreError = centreError_, out.radiusError = radiusError_;
    const Layout& l = layout_;
    const std::uint32_t before = l.startOpen ? 0 : l.first - 1,
                        after = l.endOpen ? old_.spans : std::min(l.last + 1, old_.spans);
    out.changedFrom = float(before), out.changedTo = float(after);
    const float shift = float(spans_) - float(old_.spans);
    // Old places against new parameters, in order.
    std::vector<vec2> places;
    for (const Sample& sample : samples_)
      if (const float u = float(sample.span) + sample.t; places.empty() || sample.along > places.back().x)
        places.push_back({sample.along, u});
    places.insert(places.begin(),
                  {l.startOpen ? l.low : old_.arc.along(float(before)), l.startOpen ? 0.0f : float(before)});
    places.push_back({l.endOpen ? l.high : old_.arc.along(float(after)), float(after) + shift});
    out.place = [places = std::move(places), arc = old_.arc, before = l.startOpen ? -1.0f : float(before),
                 after = l.endOpen ? float(after) + 1 : float(after), shift](float u) {
      if (u <= before) return u;
      if (u >= after) return u + shift;
      const float along = std::clamp(arc.along(u), places.front().x, places.back().x);
      const auto above = std::ranges::upper_bound(places.begin() + 1, places.end() - 1, along, {}, &vec2::x);
      const vec2 low = *(above - 1), high = *above;
      return high.x > low.x ? std::lerp(low.y, high.y, (along - low.x) / (high.x - low.x)) : low.y;
    };
    return out;
  }

 private:
  struct Sample {
    std::uint32_t span;
    float t;
    float along;  // [m] of the old course
  };
  int row(std::uint32_t span, int k) const {
    const std::uint32_t j = span + std::uint32_t(k);
    return j >= firstFree_ && j < freeEnd_ ? int(j - firstFree_) : -1;
  }

  const OldCourse& old_;
  const Layout& layout_;
  std::uint32_t spans_ = 0, head_ = 0, firstFree_ = 0, freeEnd_ = 0;  // head_: old spans before the new ones
  std::vector<vec4> points_;
  std::optional<KnotMap> map_;
  std::vector<Sample> samples_;
  float centreError_ = 0, radiusError_ = 0, worst_ = 0;
};

}  // namespace

Redrawn redrawVessel(std::span<const vec4> points, const Redrawing& redrawing) {
  OldCourse old{points, ArcLength(points), spanCount(points), {}, redrawing};
  for (std::uint32_t k = 0; k <= old.spans; ++k) old.knots.push_back(old.arc.along(float(k)));
  if (!(std::min(redrawing.keepTo, old.arc.length()) > redrawing.keepFrom)) return {};
  Redrawn best;
  float step = std::max(redrawing.step, 1e-5f);
  for (int halving = 0; halving <= kHalvings; ++halving, step *= 0.5f) {
    const Layout layout = layOut(old, step);
    Fitter fitter(old, layout);
    fitter.run();
    best = fitter.result();
    if (fitter.fits()) break;
  }
  return best;
}

}  // namespace vasa
