// Costs are gaps over what is allowed there, so 1 is the limit everywhere and joins of all sorts compare.
// All candidates are collected first and then taken cheapest first; taking one changes the strands a little
// (a tip is cut back or led on), so places are looked up again when a candidate is taken.
#include "convert/attach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "convert/shared_rims.h"
#include "convert/vessel_names.h"
#include "core/disjoint_sets.h"
#include "core/ids.h"
#include "core/parallel.h"

namespace vasa {
namespace {

constexpr float kSnapRadii = 1.0f;     // a side place this near to an end is that end
constexpr float kFacing = 0.2f;        // least -cos between outward directions for ends to meet as ends
constexpr float kAligned = 0.82f;      // 35 degrees
constexpr float kNamedAligned = 0.7f;  // 45 degrees: the names speak for it too
constexpr float kNamedRatio = 3.5f;
// Of radii: a thick vessel does not go on in a thin one, nor hang on it.
constexpr float kLargestRatio = 2.5f;
constexpr float kAheadCost = 0.25f;  // straight-ahead joins cost this much more than touching ones
// Of the way to the axis straight across: a slant of 30 degrees.
constexpr float kFarthestAhead = 2;
constexpr int kAheadSteps = 12;
constexpr float kTouchRadii = 0.15f;
constexpr std::size_t kNoSection = std::size_t(-1);
// A tip's radii: the rim that it ends at is no farther away and no wider, and no narrower than the second.
constexpr float kRimRadii = 2.0f, kLeastRimRadii = 0.5f;
constexpr float kClosingCost = 0.6f;  // limit for joins that close a ring

struct Candidate {
  StrandEnd end;
  std::uint32_t strand;           // to join to
  std::optional<bool> otherLast;  // the other strand's end; none: its side
  float cost;
  float gap;
  bool bridge = false;
  std::size_t cutTo = 0;           // sections to take off the end first
  const SharedRim* rim = nullptr;  // their surfaces hang together: no gap, whatever lies between the axes
};

struct OpenTip {
  StrandEnd end;
  vec3 place;
  vec3 outward;
  float radius;
};

class Attacher {
 public:
  Attacher(StrandGraph& graph, std::span<const SourceElement> elements, float bodyHeight,
           const AttachOptions& options)
      : graph_(graph),
        elements_(elements),
        rims_(sharedRims(elements)),
        rimTaken_(rims_.size(), false),
        rimsOf_(elements.size()),
        bodyHeight_(bodyHeight),
        options_(options) {
    for (std::uint32_t rim = 0; rim < rims_.size(); ++rim)
      for (const std::uint32_t element : {rims_[rim].first, rims_[rim].second})
        rimsOf_[element].push_back(rim);
  }

  AttachReport run() {
    // Joining opens no new ends, but a tip led on may come near something; two rounds settle that.
    for (int round = 0; round < 2; ++round) {
      collectTips();
      std::vector<std::vector<Candidate>> found(tips_.size());
      parallelFor(tips_.size(), 16, [&](std::size_t i) { found[i] = candidatesOf(tips_[i]); });
      take(found);
    }
    collectTips();
    std::vector<std::vector<Candidate>> touching(tips_.size());
    parallelFor(tips_.size(), 16, [&](std::size_t i) { touching[i] = touchingCandidates(tips_[i]); });
    take(touching);
    joinAcrossRims();
    if (options_.bridges) {
      collectTips();
      std::vector<std::vector<Candidate>> found(1);
      found[0] = bridgeCandidates();
      take(found);
    }
    return std::move(report_);
  }

 private:
  void collectTips() {
    tips_.clear();
    boxes_.clear();
    strandsOf_.assign(elements_.size(), {});
    for (std::uint32_t s = 0; s < graph_.strands.size(); ++s) {
      const Strand& strand = graph_.strands[s];
      Aabb box;
      for (const vec4& section : strand.sections) box.add(vec3(section), section.w);
      boxes_.push_back(box);
      if (strand.dropped()) continue;
      strandsOf_[strand.element].push_back(s);
      for (const bool last : {false, true})
        if (graph_.isFree({s, last})) tips_.push_back(tipOf({s, last}));
    }
  }
  OpenTip tipOf(StrandEnd end) const {
    const Sections& sections = graph_.strands[end.strand].sections;
    return {end, vec3(graph_.sectionAt(end)), outwardDirection(sections, end.last),
            endRadius(sections, end.last)};
  }
  bool mayJoin(std::uint32_t a, std::uint32_t b) const {
    return a != b && !graph_.strands[b].dropped() &&
           sameFamily(graph_.strands[a].kind, graph_.strands[b].kind);
  }

  std::vector<Candidate> candidatesOf(const OpenTip& tip) const {
    std::vector<Candidate> found;
    const float reach = std::max({options_.aheadMax, options_.nearMax});
    for (std::uint32_t s = 0; s < graph_.strands.size(); ++s) {
      if (!mayJoin(tip.end.strand, s)) continue;
      Aabb box = boxes_[s];
      if (box.low -= reach, box.high += reach; !box.overlaps({tip.place, tip.place})) continue;
      if (auto side = sideCandidate(tip, s)) found.push_back(*side);
    }
    for (const OpenTip& other : tips_)
      if (mayJoin(tip.end.strand, other.end.strand))
        if (auto facing = facingCandidate(tip, other)) found.push_back(*facing);
    for (const std::uint32_t rim : rimsOf_[graph_.strands[tip.end.strand].element])
      if (auto shared = rimCandidate(tip, rims_[rim])) found.push_back(*shared);
    return found;
  }

  static bool endsAt(const OpenTip& tip, const SharedRim& rim) {
    const float reach = kRimRadii * tip.radius;
    return glm::distance(tip.place, rim.centre) <= reach && rim.radius <= reach &&
           rim.radius >= kLeastRimRadii * tip.radius;
  }

  // Where a tip's surface goes on in another element's, no mesh is missing, however wide the collar between
  // them: the first ring of a branch lies on the rim of a collar that is its host's.
  std::optional<Candidate> rimCandidate(const OpenTip& tip, const SharedRim& rim) const {
    if (!endsAt(tip, rim)) return std::nullopt;
    const float reach = kRimRadii * tip.radius, away = glm::distance(tip.place, rim.centre);
    const std::uint32_t own = graph_.strands[tip.end.strand].element;
    std::optional<Candidate> best;
    for (const std::uint32_t s : strandsOf_[own == rim.first ? rim.second : rim.first]) {
      if (!mayJoin(tip.end.strand, s)) continue;
      const Along at = nearestAlong(graph_.strands[s].sections, tip.place);
      const float gap = std::max(0.0f, at.distance - at.section.w);
      if (tip.radius > kLargestRatio * at.section.w || gap > reach + at.section.w) continue;
      if (best && gap >= best->gap) continue;
      // What hangs together comes before all that merely touches, the nearest of it first: a twig that
      // crosses a branch's foot would take the foot from the trunk.
      best = Candidate{tip.end, s, std::nullopt, away / reach - 1, gap};
      best->rim = &rim;
    }
    return best;
  }

  std::optional<Candidate> sideCandidate(const OpenTip& tip, std::uint32_t host) const {
    const Sections& sections = graph_.strands[host].sections;
    const Along at = nearestAlong(sections, tip.place);
    const float gap = std::max(0.0f, at.distance - at.section.w);
    const float near = std::clamp(options_.nearRadii * tip.radius, options_.nearMin, options_.nearMax);
    const float ahead = std::clamp(options_.aheadRadii * tip.radius, options_.aheadMin, options_.aheadMax);
    Candidate best{tip.end, host, std::nullopt, gap / near, gap};
    // A thick vessel does not hang on a thin one's side.
    if (tip.radius > kLargestRatio * at.section.w) best.cost = std::numeric_limits<float>::infinity();
    for (int step = 1; step <= kAheadSteps && best.cost > kAheadCost; ++step) {
      const float way = ahead * float(step) / kAheadSteps;
      const Along there = nearestAlong(sections, tip.place + way * tip.outward);
      if (there.distance > there.section.w || tip.radius > kLargestRatio * there.section.w) continue;
      const float cost = kAheadCost + (1 - kAheadCost) * way / ahead;
      if (cost < best.cost) best.cost = cost, best.gap = std::min(gap, way);
      break;
    }
    if (!(best.cost <= 1)) return std::nullopt;
    return best;
  }

  // Coarse meshes taper towards an end and miss their host, but the walls near the end still touch it.
  std::vector<Candidate> touchingCandidates(const OpenTip& tip) const {
    std::vector<Candidate> found;
    for (std::uint32_t s = 0; s < graph_.strands.size(); ++s) {
      if (!mayJoin(tip.end.strand, s) || !boxes_[s].overlaps(boxes_[tip.end.strand])) continue;
      const std::size_t section = touchingSection(tip, s);
      if (section == kNoSection) continue;
      Candidate candidate{tip.end, s, std::nullopt, 1, 0};
      candidate.cutTo = section;
      found.push_back(candidate);
    }
    return found;
  }
  // Counted from the tip: the section within two radii of the tip whose wall comes nearest to the host's, if
  // they touch.
  std::size_t touchingSection(const OpenTip& tip, std::uint32_t host) const {
    const Sections& own = graph_.strands[tip.end.strand].sections;
    std::size_t best = kNoSection;
    float least = kTouchRadii * tip.radius;
    for (std::size_t i = 0; i + 2 <= own.size(); ++i) {
      const vec4 section = own[tip.end.last ? own.size() - 1 - i : i];
      if (glm::distance(vec3(section), tip.place) > 2 * tip.radius) break;
      const Along at = nearestAlong(graph_.strands[host].sections, vec3(section));
      if (tip.radius > kLargestRatio * at.section.w) continue;
      if (const float gap = at.distance - at.section.w - section.w; gap < least) least = gap, best = i;
    }
    return best;
  }

  std::optional<Candidate> facingCandidate(const OpenTip& tip, const OpenTip& other) const {
    const vec3 between = other.place - tip.place;
    const float gap = glm::length(between), large = std::max(tip.radius, other.radius);
    const float far = std::clamp(options_.facingRadii * large, options_.facingMin, options_.facingMax);
    if (gap > std::max(far, 1.2f * large) || glm::dot(tip.outward, other.outward) > -kFacing)
      return std::nullopt;
    Candidate candidate{tip.end, other.end.strand, other.end.last, 0.5f * gap / (1.2f * large), gap};
    if (large > kLargestRatio * std::min(tip.radius, other.radius)) return std::nullopt;
    if (gap <= 1.2f * large) return candidate;
    if (!aligned(tip, other, kAligned)) return std::nullopt;
    candidate.cost = 0.5f + 0.5f * gap / far;
    return candidate;
  }
  static bool aligned(const OpenTip& tip, const OpenTip& other, float least) {
    const vec3 way = glm::normalize(other.place - tip.place);
    return glm::dot(way, tip.outward) >= least && glm::dot(way, other.outward) <= -least;
  }

  std::vector<Candidate> bridgeCandidates() const {
    std::vector<Candidate> found;
    for (const OpenTip& tip : tips_)
      for (const OpenTip& other : tips_) {
        if (!mayJoin(tip.end.strand, other.end.strand) || tip.end.strand > other.end.strand) continue;
        const float gap = glm::distance(tip.place, other.place), large = std::max(tip.radius, other.radius);
        const float limit = std::min(options_.bridgeRadii * large, options_.bridgeBodyHeights * bodyHeight_);
        if (gap > limit || large > kNamedRatio * std::min(tip.radius, other.radius) ||
            !aligned(tip, other, kNamedAligned))
          continue;
        const std::uint32_t a = graph_.strands[tip.end.strand].element,
                            b = graph_.strands[other.end.strand].element;
        if (a != b && !namesContinue(elements_[a].label, elements_[b].label)) continue;
        found.push_back({tip.end, other.end.strand, other.end.last, gap / limit, gap, true});
      }
    return found;
  }

  void take(std::vector<std::vector<Candidate>>& found) {
    std::vector<Candidate> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    collectParts();
    std::ranges::stable_sort(all, {}, &Candidate::cost);
    for (const Candidate& candidate : all) {
      char* const rimTaken = candidate.rim ? &rimTaken_[std::size_t(candidate.rim - rims_.data())] : nullptr;
      if (rimTaken && *rimTaken) continue;
      if (!graph_.isFree(candidate.end) || !mayClose(candidate) || isGuess(candidate)) continue;
      const bool joined = candidate.otherLast ? joinToEnd(candidate, {candidate.strand, *candidate.otherLast})
                                              : joinToSide(candidate);
      if (joined) unite(candidate.end.strand, candidate.strand);
      if (joined && rimTaken) *rimTaken = true;
      if (joined && candidate.gap > kToldGap && !candidate.rim)
        report_.gaps.push_back({graph_.strands[candidate.end.strand].element,
                                graph_.strands[candidate.strand].element, candidate.gap, candidate.bridge});
    }
  }

  // Surfaces that hang together where neither vessel ends, as where branches leave from one another's feet: a
  // short vessel of the thinner one leads from axis to axis.
  void joinAcrossRims() {
    collectTips();
    collectParts();
    for (std::size_t k = 0; k < rims_.size(); ++k) {
      const SharedRim& rim = rims_[k];
      const auto a = sideAt(rim, rim.first), b = sideAt(rim, rim.second);
      if (rimTaken_[k] || !a || !b || !mayJoin(a->strand, b->strand) || isOnePart(a->strand, b->strand))
        continue;
      if (!mayShareCircuit(a->strand, b->strand)) continue;
      if (glm::distance(vec3(a->axis), vec3(b->axis)) <= rim.radius) continue;  // too short for a vessel
      const auto [branch, host] = a->axis.w < b->axis.w ? std::pair(*a, *b) : std::pair(*b, *a);
      Strand strand = graph_.strands[branch.strand];
      strand.sections = {vec4(vec3(branch.axis), rim.radius), vec4(rim.centre, rim.radius),
                         vec4(vec3(host.axis), rim.radius)};
      const std::uint32_t added = graph_.add(std::move(strand));
      parts_.add();
      circuit_.push_back(Circuit::unknown);
      for (const auto& [side, last] : {std::pair(branch, false), std::pair(host, true)}) {
        const StrandEnd end{added, last};
        graph_.join(side.strand, vec3(side.axis), std::span(&end, 1));
        unite(added, side.strand);
        ++report_.endToSide;
      }
      rimTaken_[k] = true;
    }
  }
  struct Side {
    std::uint32_t strand;
    vec4 axis;  // where it is nearest to the rim
  };
  std::optional<Side> sideAt(const SharedRim& rim, std::uint32_t element) const {
    std::optional<Side> best;
    float least = kRimRadii * rim.radius;
    for (const std::uint32_t s : strandsOf_[element]) {
      const Along at = nearestAlong(graph_.strands[s].sections, rim.centre);
      if (const float gap = at.distance - at.section.w; gap < least) least = gap, best = {s, at.section};
    }
    return best;
  }

  // Of what nothing says the kind of, one may be an artery and the other a vein: across a gap elements are
  // joined only where their names go on in one another, and pieces of one only where it is short.
  bool isGuess(const Candidate& candidate) const {
    const Strand &a = graph_.strands[candidate.end.strand], &b = graph_.strands[candidate.strand];
    if (candidate.rim || candidate.gap <= kToldGap || a.kind != VesselKind::other) return false;
    if (a.element == b.element) return candidate.bridge;
    return !namesContinue(elements_[a.element].label, elements_[b.element].label);
  }

  // The lungs' arteries touch the body's here and there without meeting them. Anastomoses are real, but an
  // element's own skeleton knows its rings, and between elements a ring wants ends that touch.
  bool mayClose(const Candidate& candidate) {
    if (!mayShareCircuit(candidate.end.strand, candidate.strand)) return false;
    if (!isOnePart(candidate.end.strand, candidate.strand)) return true;
    const bool own = graph_.strands[candidate.end.strand].element == graph_.strands[candidate.strand].element;
    return !own && (candidate.bridge || candidate.cost <= kClosingCost);
  }
  bool mayShareCircuit(std::uint32_t strand, std::uint32_t other) {
    const Circuit a = circuit_[parts_.find(strand)], b = circuit_[parts_.find(other)];
    return a == b || a == Circuit::unknown || b == Circuit::unknown;
  }
  void collectParts() {
    parts_ = DisjointSets(graph_.strands.size());
    circuit_.clear();
    for (const Strand& strand : graph_.strands)
      circuit_.push_back(circuitOf(elements_[strand.element].label));
    for (const Joint& joint : graph_.joints)
      for (const StrandEnd& end : joint.ends)
        unite(end.strand, joint.host ? *joint.host : joint.ends.front().strand);
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    const Circuit first = circuit_[parts_.find(a)], second = circuit_[parts_.find(b)];
    parts_.unite(a, b);
    circuit_[parts_.find(a)] = second == Circuit::unknown ? first : second;
  }
  bool isOnePart(std::uint32_t a, std::uint32_t b) { return parts_.find(a) == parts_.find(b); }

  bool joinToSide(const Candidate& candidate) {
    Sections& own = graph_.strands[candidate.end.strand].sections;
    for (std::size_t i = 0; i < candidate.cutTo && own.size() > 2; ++i)
      candidate.end.last ? own.pop_back() : void(own.erase(own.begin()));
    const OpenTip tip = tipOf(candidate.end);
    const Sections& host = graph_.strands[candidate.strand].sections;
    const Along at = nearestAlong(host, tip.place);
    // Near an end of the host that faces this one, or that has a joint, the end is meant.
    const float length = lengthOf(host), snap = kSnapRadii * std::max(at.section.w, tip.radius);
    if (std::min(at.arc, length - at.arc) < snap) {
      const StrandEnd other{candidate.strand, at.arc > length - at.arc};
      const OpenTip there = tipOf(other);
      const bool facing = glm::dot(tip.outward, there.outward) < -kFacing &&
                          (!candidate.rim || endsAt(there, *candidate.rim));
      const bool hostedThere = !graph_.isFree(other) && graph_.joints[graph_.jointAt(other)].host;
      if (facing || (!graph_.isFree(other) && !hostedThere)) return joinToEnd(candidate, other);
    }
    const vec3 place = placeOnHost(tip, host, at, snap);
    if (turnsBack(candidate.end, candidate.strand, place)) return false;
    cutInside(candidate.end, host);
    trimTaper(graph_.strands[candidate.end.strand].sections, candidate.end.last);
    graph_.join(candidate.strand, place, std::span(&candidate.end, 1));
    ++report_.endToSide;
    return true;
  }

  // Where the branch's own course comes nearest to the host's axis, so that it keeps its slant.
  // @param margin  [m] at the host's ends, which are not meant
  static vec3 placeOnHost(const OpenTip& tip, const Sections& host, const Along& at, float margin) {
    const float length = lengthOf(host);
    Along best = at;
    for (int step = 1; step <= kAheadSteps; ++step) {
      const float way = kFarthestAhead * at.distance * float(step) / kAheadSteps;
      const Along there = nearestAlong(host, tip.place + way * tip.outward);
      if (there.distance < best.distance && there.arc >= margin && there.arc <= length - margin) best = there;
    }
    return vec3(best.section);
  }

  // Sections at the tip that the host's lumen swallows.
  void cutInside(StrandEnd end, const Sections& host) {
    Sections& sections = graph_.strands[end.strand].sections;
    while (sections.size() > 2) {
      const vec4 tip = graph_.sectionAt(end);
      const Along at = nearestAlong(host, vec3(tip));
      if (at.distance > 0.8f * at.section.w) return;
      end.last ? sections.pop_back() : void(sections.erase(sections.begin()));
    }
  }

  bool joinToEnd(const Candidate& candidate, StrandEnd other) {
    const vec4 tip = graph_.sectionAt(candidate.end), target = graph_.sectionAt(other);
    if (!graph_.isFree(other)) {
      const std::uint32_t joint = graph_.jointAt(other);
      const auto& ends = graph_.joints[joint].ends;
      const bool sameHost = graph_.joints[joint].host == candidate.end.strand;
      const bool already =
          std::ranges::any_of(ends, [&](const StrandEnd& e) { return e.strand == candidate.end.strand; });
      if (sameHost || already || candidate.bridge) return false;
      graph_.addEnd(joint, candidate.end);
      ++report_.endToEnd;
      return true;
    }
    if (turnsBack(candidate.end, other.strand, vec3(target))) return false;
    const float gap = glm::distance(vec3(tip), vec3(target));
    vec3 place = 0.5f * vec3(tip + target);
    if (gap > 3 * std::max(tip.w, target.w)) {
      lead(candidate.end, other);
      place = vec3(target);
    } else {
      for (const StrandEnd& end : {candidate.end, other}) {
        cutBeyond(end, place);
        trimTaper(graph_.strands[end.strand].sections, end.last);
      }
    }
    const StrandEnd ends[] = {candidate.end, other};
    graph_.join(std::nullopt, place, ends);
    ++report_.endToEnd;
    return true;
  }

  // Overlapping ends: sections past the meeting place go.
  void cutBeyond(StrandEnd end, vec3 place) {
    Sections& sections = graph_.strands[end.strand].sections;
    const vec3 outward = outwardDirection(sections, end.last);
    while (sections.size() > 2) {
      const vec4 tip = graph_.sectionAt(end);
      if (glm::dot(vec3(tip) - place, outward) <= 0 || glm::distance(vec3(tip), place) > 4 * tip.w) return;
      end.last ? sections.pop_back() : void(sections.erase(sections.begin()));
    }
  }

  // Leads a strand across a long gap: a Hermite arc along both ends' directions.
  void lead(StrandEnd end, StrandEnd to) {
    const vec4 a = graph_.sectionAt(end), b = graph_.sectionAt(to);
    const float gap = glm::distance(vec3(a), vec3(b));
    const vec3 da = gap * outwardDirection(graph_.strands[end.strand].sections, end.last);
    const vec3 db = -gap * outwardDirection(graph_.strands[to.strand].sections, to.last);
    const int steps = std::clamp(int(gap / std::max(a.w, b.w)), 3, 24);
    Sections& sections = graph_.strands[end.strand].sections;
    for (int i = 1; i < steps; ++i) {
      const float t = float(i) / float(steps), t2 = t * t, t3 = t2 * t;
      const vec3 p = (2 * t3 - 3 * t2 + 1) * vec3(a) + (t3 - 2 * t2 + t) * da + (3 * t2 - 2 * t3) * vec3(b) +
                     (t3 - t2) * db;
      sections.insert(end.last ? sections.end() : sections.begin(), vec4(p, glm::mix(a.w, b.w, t)));
    }
  }

  // Whether the strand's other end already hangs on `other` nearby: a twig bent back onto its own trunk.
  bool turnsBack(StrandEnd end, std::uint32_t other, vec3 place) const {
    const std::uint32_t joint = graph_.jointAt({end.strand, !end.last});
    if (joint == kNone) return false;
    const Joint& far = graph_.joints[joint];
    const bool touches = far.host == other ||
                         std::ranges::any_of(far.ends, [&](const StrandEnd& e) { return e.strand == other; });
    return touches && glm::distance(far.place, place) < 0.5f * lengthOf(graph_.strands[end.strand].sections);
  }

  StrandGraph& graph_;
  std::span<const SourceElement> elements_;
  const std::vector<SharedRim> rims_;
  std::vector<char> rimTaken_;                                  // by a join
  std::vector<std::vector<std::uint32_t>> rimsOf_, strandsOf_;  // by element
  float bodyHeight_;
  AttachOptions options_;
  std::vector<OpenTip> tips_;
  std::vector<Aabb> boxes_;
  DisjointSets parts_{0};         // of strands that are connected
  std::vector<Circuit> circuit_;  // of a part, at its root
  AttachReport report_;
};

}  // namespace

AttachReport attachEnds(StrandGraph& graph, std::span<const SourceElement> elements, float bodyHeight,
                        const AttachOptions& options) {
  return Attacher(graph, elements, bodyHeight, options).run();
}

}  // namespace vasa
