#include "body/sliding.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

#include "body/bowing.h"
#include "core/parallel.h"

// Control points are shifted by what the curve at their Greville abscissae is. These are all thirds of a
// span, so that a course sampled six times a span has each of them among its samples.
namespace vasa {
namespace {

// Published strains of thighs' and knees' arteries tell it: with 0.13, 0.17, 0.2, 0.25, 0.3, 0.4 and 0.5 m
// 15, 17, 18, 18, 18, 17 and 17 of the 25 figures of `vasa realism` that are not blind agree within one
// standard deviation. Of the best it is the longest: the lower third of the superficial femoral artery
// shortens more than the upper one in life (Cheng 2010), below 0.3 the other way round. The wall's stiffness
// grows with r², the bed's hold with r.
constexpr float kSlidingLength = 0.3f, kOfRadius = 3e-3f;
// Over so much of its arc a branch gives way to the shift of what it hangs on: what is shorter comes along.
constexpr float kCarried =
    0.05f;  // [m] of 0.03 to 0.2 the one with which no clip jumps, at 30 and 120 frames a second
// Of the radius of the thinner of two vessels that go on in one another at a fork: what is thicker holds it,
// as the anterior tibial artery, which goes through its membrane, holds the popliteal (0.81).
constexpr float kSideBranch = 0.8f;
constexpr std::uint32_t kSpanSamples = 6;  // a span
constexpr float kUnstrained =
    2e-4f;  // more than rounding makes of legs of a millimetre, less than shifts anything by 0.03 mm

// A course in a pose.
struct Sampled {
  std::vector<vec3> places;
  std::vector<float> along;  // [m]
};

// What sliding works in, a thread's own: kept, so that a frame allocates nothing.
struct Workspace {
  Sampled posed;
  std::vector<double> step, stretch, factor, shift;
  std::vector<float> was, is, left, lost;
  std::vector<vec3> off, moved, aside;
  std::vector<quat> turns;

  // Whichever courses come to this thread later.
  void reserve(std::size_t rows, std::size_t samples) {
    if (off.capacity() >= rows && posed.places.capacity() >= samples) return;
    for (auto* values : {&step, &stretch, &factor, &shift}) values->reserve(rows + 1);
    for (auto* values : {&was, &is, &left, &lost}) values->reserve(rows);
    for (auto* values : {&off, &moved, &aside}) values->reserve(rows);
    turns.reserve(rows);
    posed.places.reserve(samples);
    posed.along.reserve(samples);
  }
};

// Three times the Greville abscissa of point j.
std::uint32_t grevilleThirds(std::uint32_t j, std::uint32_t spans) {
  const auto knot = [&](std::uint32_t k) { return std::clamp<std::int64_t>(std::int64_t(k) - 3, 0, spans); };
  return std::uint32_t(knot(j + 1) + knot(j + 2) + knot(j + 3));
}

template <class Pieces>
void sample(const Network& network, const Pieces& pieces, std::span<const vec4> points, Sampled& course) {
  course.places.clear();
  for (const auto& piece : pieces) {
    const auto own = Network::pointsOf(network.vessel(piece.vessel), points);
    const std::uint32_t spans = network.vessel(piece.vessel).spanCount();
    const std::size_t joined = course.places.empty() ? 0 : 1, before = course.places.size();
    for (std::uint32_t span = 0; span < spans; ++span) {
      const Bezier segment = bezierOfSpan(own, span);
      for (std::uint32_t k = 0; k < kSpanSamples; ++k)
        course.places.emplace_back(segment.at(float(k) / kSpanSamples));
    }
    course.places.emplace_back(own.back());
    if (piece.backwards) std::reverse(course.places.begin() + std::ptrdiff_t(before), course.places.end());
    course.places.erase(course.places.begin() + std::ptrdiff_t(before),
                        course.places.begin() + std::ptrdiff_t(before + joined));
  }
  course.along.assign(1, 0.0f);
  for (std::size_t i = 1; i < course.places.size(); ++i)
    course.along.push_back(course.along.back() + glm::distance(course.places[i - 1], course.places[i]));
}

float endRadius(const Network& network, VesselEnd end) { return network.points()[network.pointOf(end)].w; }

vec3 placeAt(const Sampled& course, float along, std::size_t from) {
  from = std::min(from, course.along.size() - 2);
  while (from > 0 && course.along[from] > along) --from;
  while (from + 2 < course.along.size() && course.along[from + 1] <= along) ++from;
  const float step = course.along[from + 1] - course.along[from];
  const float share = step > 0 ? std::clamp((along - course.along[from]) / step, 0.0f, 1.0f) : 0;
  return glm::mix(course.places[from], course.places[from + 1], share);
}

}  // namespace

float VesselSlider::slidingLength(float radius) { return kSlidingLength * std::sqrt(radius / kOfRadius); }

VesselSlider::VesselSlider(const Network& network, const Binding* binding, std::span<const VesselHold> holds)
    : network_(&network) {
  // The end that a vessel's end goes on in: at a fork the two thickest, where the third is a side branch of
  // theirs.
  const auto onward = [&](VesselEnd end) -> std::optional<VesselEnd> {
    const NodeId node = network.vessel(end.vessel).node(end.last);
    if (!node.valid() || network.node(node).host || network.node(node).endCount < 2) return std::nullopt;
    const auto at = network.ends(network.node(node));
    std::vector<VesselEnd> ends(at.begin(), at.end());
    std::ranges::stable_sort(ends, std::greater(), [&](VesselEnd of) { return endRadius(network, of); });
    if (ends.size() > 2 && endRadius(network, ends[2]) > kSideBranch * endRadius(network, ends[1]))
      return std::nullopt;
    if (ends[0] != end && ends[1] != end) return std::nullopt;
    const VesselEnd other = ends[ends[0] == end ? 1 : 0];
    return other.vessel == end.vessel ? std::nullopt : std::optional(other);
  };
  std::vector<char> taken(network.vessels().size(), 0);
  const auto follow = [&](VesselEnd start) {
    Course course;
    for (std::optional<VesselEnd> at = start; at && !taken[at->vessel.value];) {
      taken[at->vessel.value] = 1;
      course.pieces.push_back({at->vessel, at->last});
      at = onward({at->vessel, !at->last});
    }
    courses_.push_back(std::move(course));
  };
  for (std::uint32_t v = 0; v < taken.size(); ++v)
    for (const bool last : {false, true})
      if (!taken[v] && !onward({{v}, last})) follow({{v}, last});
  for (std::uint32_t v = 0; v < taken.size(); ++v)
    if (!taken[v]) follow({{v}, false});  // rings
  std::vector<vec3> outwards;
  if (binding) outwards = outwardsOf(*binding, network.points());
  bows_ = !outwards.empty();
  for (Course& course : courses_) layOut(course, holds, outwards);
  settleOrder();
}

void VesselSlider::layOut(Course& course, std::span<const VesselHold> holds, std::span<const vec3> outwards) {
  const Network& network = *network_;
  const std::span<const vec4> points = network.points();
  Sampled rest;
  sample(network, course.pieces, points, rest);
  std::vector<std::uint32_t> samples;  // of each point
  std::uint32_t first = 0;
  for (const Piece& piece : course.pieces) {
    const Vessel& vessel = network.vessel(piece.vessel);
    const std::uint32_t last = first + kSpanSamples * vessel.spanCount();
    for (const VesselHold& hold : holds)
      if (hold.vessel == vessel.name)
        course.holds.push_back(
            glm::mix(rest.along[first], rest.along[last], piece.backwards ? 1 - hold.at : hold.at));
    for (std::uint32_t j = 0; j < vessel.pointCount; ++j) {  // symmetric: the same from either end
      samples.push_back(first + kSpanSamples / 3 * grevilleThirds(j, vessel.spanCount()));
      course.points.push_back(vessel.firstPoint + (piece.backwards ? vessel.pointCount - 1 - j : j));
      course.along.push_back(rest.along[samples.back()]);
    }
    first = last;
  }
  for (float& hold : course.holds)  // at the nearest point
    hold = *std::ranges::min_element(course.along, {}, [&](float at) { return std::abs(at - hold); });
  Rows& rows = course.rows;
  for (std::size_t i = 0; i < course.points.size(); ++i) {
    const std::uint32_t point = course.points[i];
    const float along = course.along[i], length = slidingLength(points[point].w);
    course.legs.push_back(i > 0 ? glm::distance(vec3(points[course.points[i - 1]]), vec3(points[point])) : 0);
    if (i == 0 || along > rows.along.back()) {
      const bool held = std::ranges::find(course.holds, along) != course.holds.end();
      rows.points.push_back(point);
      rows.samples.push_back(samples[i]);
      rows.along.push_back(along);
      rows.tether.push_back(held ? std::numeric_limits<float>::infinity() : 1 / (length * length));
      rows.rest.push_back(points[point]);
      if (!outwards.empty()) rows.outwards.push_back(outwards[point]);
    }
    course.rowOf.push_back(std::uint32_t(rows.points.size() - 1));
  }
  mostRows_ = std::max(mostRows_, rows.points.size());
  // While a piece is added its first sample is there twice.
  mostSamples_ = std::max(mostSamples_, rest.places.size() + 1);
}

// Sets what each course's ends hang on, and sorts.
void VesselSlider::settleOrder() {
  const Network& network = *network_;
  std::vector<std::uint32_t> courseOf(network.vessels().size());
  for (std::uint32_t c = 0; c < courses_.size(); ++c)
    for (const Piece& piece : courses_[c].pieces) courseOf[piece.vessel.value] = c;
  const auto radiusOf = [&](VesselEnd end) { return endRadius(network, end); };
  const auto holdOf = [&](VesselEnd end) -> Hold {
    const NodeId id = network.vessel(end.vessel).node(end.last);
    if (!id.valid()) return {};
    const Node& node = network.node(id);
    if (node.host) return {true, node.host, std::nullopt};
    const auto ends = network.ends(node);
    const VesselEnd thickest = *std::ranges::max_element(ends, {}, radiusOf);
    return {true, std::nullopt, thickest == end ? std::nullopt : std::optional(thickest)};
  };
  std::vector<std::vector<std::uint32_t>> hanging(courses_.size());
  std::vector<std::uint32_t> waiting(courses_.size(), 0);
  for (std::uint32_t c = 0; c < courses_.size(); ++c) {
    Course& course = courses_[c];
    course.start = holdOf({course.pieces.front().vessel, course.pieces.front().backwards});
    course.finish = holdOf({course.pieces.back().vessel, !course.pieces.back().backwards});
    if (course.start.holds) course.holds.push_back(0);
    if (course.finish.holds) course.holds.push_back(course.along.back());
    for (const Hold* hold : {&course.start, &course.finish})
      if (hold->host || hold->end) {
        hanging[courseOf[(hold->host ? hold->host->vessel : hold->end->vessel).value]].push_back(c);
        ++waiting[c];
      }
  }
  std::vector<std::uint32_t> order;
  std::vector<char> settled(courses_.size(), 0);
  const auto settle = [&](std::uint32_t first) {
    std::vector<std::uint32_t> ready{first};
    while (!ready.empty()) {
      const std::uint32_t c = ready.back();
      ready.pop_back();
      if (settled[c]) continue;
      settled[c] = 1;
      order.push_back(c);
      for (const std::uint32_t next : hanging[c])
        if (--waiting[next] == 0) ready.push_back(next);
    }
  };
  for (std::uint32_t c = 0; c < courses_.size(); ++c)
    if (waiting[c] == 0) settle(c);
  for (std::uint32_t c = 0; c < courses_.size(); ++c)
    settle(c);  // those that hang on one another in a circle
  std::vector<Course> sorted;
  for (const std::uint32_t c : order) sorted.push_back(std::move(courses_[c]));
  courses_ = std::move(sorted);
}

void VesselSlider::run(std::span<vec4> points, std::span<const quat> turned) const {
  assert(!bows_ || turned.size() == points.size());
  parallelFor(courses_.size(), 16, [&](std::size_t c) { slide(courses_[c], points, turned); });
  for (const Course& course : courses_) carry(course, points);
  pinEnds(*network_, points);
}

// (1/h_before + 1/h_after + m/ℓ²) a_i - a_{i-1}/h_before - a_{i+1}/h_after = λ_after - λ_before, a
// tridiagonal system solved by elimination; a = 0 at an end that holds. A free end draws back where its
// course is stretched and stays where it is squeezed: beyond it there is no course to follow. Where vessels
// join, their common point is there twice, h = 0 between: it counts once.
void VesselSlider::slide(const Course& course, std::span<vec4> points, std::span<const quat> turned) const {
  const Rows& rows = course.rows;
  const std::size_t n = rows.points.size();
  if (n < 3 || isUnstrained(course, points)) return;
  static thread_local Workspace work;
  work.reserve(mostRows_, mostSamples_);
  auto& [posed, step, stretch, factor, shift, was, is, left, lost, off, moved, aside, turns] = work;
  sample(*network_, course.pieces, points, posed);
  step.assign(n + 1, 0), stretch.assign(n + 1, 1);  // before each row
  factor.resize(n), shift.resize(n);
  for (std::size_t k = 1; k < n; ++k) {
    step[k] = double(rows.along[k]) - rows.along[k - 1];
    stretch[k] = (double(posed.along[rows.samples[k]]) - posed.along[rows.samples[k - 1]]) / step[k];
  }
  bool holdsFirst = course.start.holds, holdsLast = course.finish.holds;
  for (;;) {
    for (std::size_t k = 0; k < n; ++k) {
      factor[k] = shift[k] = 0;
      if ((k == 0 && holdsFirst) || (k + 1 == n && holdsLast)) continue;
      const double before = k > 0 ? 1 / step[k] : 0, after = k + 1 < n ? 1 / step[k + 1] : 0;
      const double pivot = before + after + 0.5 * (step[k] + step[k + 1]) * double(rows.tether[k]) -
                           (k > 0 ? before * factor[k - 1] : 0);
      factor[k] = after / pivot;
      shift[k] = (stretch[k + 1] - stretch[k] + (k > 0 ? before * shift[k - 1] : 0)) / pivot;
    }
    for (std::size_t k = n - 1; k-- > 0;) shift[k] += factor[k] * shift[k + 1];
    const bool outFirst = !holdsFirst && shift.front() < 0, outLast = !holdsLast && shift.back() > 0;
    if (!outFirst && !outLast) break;
    holdsFirst |= outFirst, holdsLast |= outLast;
  }
  // A control point stands off its curve, across it, by h²/6 of the curve's bend, h being the way between
  // control points: so that the course stays, it takes over the distance of those about its new place, by the
  // square of how much farther apart they come to lie.
  was.resize(n), is.resize(n), left.resize(n), lost.resize(n), off.resize(n), moved.resize(n),
      aside.assign(n, vec3(0));
  turns.clear();
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t own = rows.samples[k], point = rows.points[k];
    was[k] = posed.along[own], is[k] = was[k] + float(shift[k]);
    off[k] = vec3(points[point]) - posed.places[own];
    left[k] =
        k > 0 ? float(stretch[k] + (shift[k] - shift[k - 1]) / step[k]) : 1;  // of the stretch before it
    if (bows_) turns.push_back(turned[point]);
  }
  if (bows_) bow({rows.along, left, rows.rest, rows.outwards, turns, course.holds}, lost, aside);
  const auto apart = [n](std::span<const float> along, std::size_t k) {
    return along[std::min(k + 1, n - 1)] - along[k > 0 ? k - 1 : 0];
  };
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t j = std::min(k, n - 2);
    while (j > 0 && was[j] > is[k]) --j;
    while (j + 2 < n && was[j + 1] <= is[k]) ++j;
    const float gap = was[j + 1] - was[j],
                share = gap > 0 ? std::clamp((is[k] - was[j]) / gap, 0.0f, 1.0f) : 0;
    const float before = glm::mix(apart(was, j), apart(was, j + 1), share);
    const float wider = before > 0 ? std::clamp(apart(is, k) / before, 0.0f, 2.0f) : 1;
    const std::uint32_t own = rows.samples[k];
    const vec3 along = posed.places[std::min<std::size_t>(own + 1, posed.places.size() - 1)] -
                       posed.places[own > 0 ? own - 1 : 0];
    vec3 across = wider * wider * glm::mix(off[j], off[j + 1], share) - off[k] + aside[k];
    if (const float square = glm::dot(along, along); square > 0)
      across -= along * (glm::dot(across, along) / square);
    moved[k] = placeAt(posed, is[k], own) - posed.places[own] + across;
  }
  for (std::size_t i = 0; i < course.points.size(); ++i) {
    vec4& point = points[course.points[i]];
    point = vec4(vec3(point) + moved[course.rowOf[i]], point.w);
  }
}

// Whether its control polygon is as long as at rest, leg by leg: most courses in most poses, and much cheaper
// to tell.
bool VesselSlider::isUnstrained(const Course& course, std::span<const vec4> points) const {
  for (std::size_t i = 1; i < course.points.size(); ++i) {
    const std::uint32_t a = course.points[i - 1], b = course.points[i];
    const float rest = course.legs[i];
    if (std::abs(glm::distance(vec3(points[a]), vec3(points[b])) - rest) > kUnstrained * rest) return false;
  }
  return true;
}

// Ends go where what they hang on went, and the course with them.
void VesselSlider::carry(const Course& course, std::span<vec4> points) const {
  const auto shiftOf = [&](const Hold& hold, std::uint32_t point) {
    vec3 place(points[point]);
    if (hold.host)
      place =
          vec3(evaluate(Network::pointsOf(network_->vessel(hold.host->vessel), std::span<const vec4>(points)),
                        hold.host->parameter));
    if (hold.end) place = vec3(points[network_->pointOf(*hold.end)]);
    return place - vec3(points[point]);
  };
  const vec3 start = shiftOf(course.start, course.points.front()),
             finish = shiftOf(course.finish, course.points.back());
  if (start == vec3(0) && finish == vec3(0)) return;
  const float whole = course.along.back();
  const bool hangs[]{course.start.host || course.start.end, course.finish.host || course.finish.end};
  // Between two holds the shares of both add up to one at most.
  const float reach = hangs[0] && hangs[1] ? std::min(kCarried, whole) : kCarried;
  for (std::size_t i = 0; i < course.points.size(); ++i) {
    const vec3 moved = start * (1 - glm::smoothstep(0.0f, reach, course.along[i])) +
                       finish * (1 - glm::smoothstep(0.0f, reach, whole - course.along[i]));
    vec4& point = points[course.points[i]];
    point = vec4(vec3(point) + moved, point.w);
  }
}

}  // namespace vasa
