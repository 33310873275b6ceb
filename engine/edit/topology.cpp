#include "edit/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/disjoint_sets.h"
#include "curve/arc_length.h"
#include "curve/fit.h"
#include "curve/frame.h"
#include "edit/graft_course.h"
#include "edit/redraw.h"
#include "math/aabb.h"
#include "network/kinks.h"

namespace vasa {
namespace {

// Of 15 degrees: a branch less steep runs within its host for four radii.
constexpr float kLeastLeavingCosine = 0.966f;
constexpr float kBranchSpan = 0.01f;     // [m] so that it bends with the body as others do
constexpr float kLongestBridge = 0.05f;  // [m] of a join: what is longer is a graft

std::string listOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    text += (i ? ", " : "") + ("\"" + names[i] + "\"");
  return names.size() > kMost ? text + fmt::format(" and {} more", names.size() - kMost) : text;
}

Result<void> mustBeNew(const Draft& draft, const std::string& name) {
  if (draft.hasName(name))
    return badInput("another vessel is named \"" + name + "\" already; choose another name");
  return {};
}

VesselId append(Draft& draft, NetworkBuilder::Label label, std::vector<vec4> points) {
  draft.lines.push_back({std::move(label), std::move(points), {}, false, true});
  return {std::uint32_t(draft.lines.size() - 1)};
}

// Hangs an end on a vessel at a share of its length: on its side, or at its end.
Draft::Place placeAt(const Draft& draft, VesselId vessel, double share) {
  const ArcLength arc(draft.line(vessel).points);
  return {vessel, arc.parameterAt(float(share) * arc.length())};
}

void hang(Draft& draft, VesselEnd end, Draft::Place place, double share) {
  if (share <= 0 || share >= 1) {
    const VesselEnd other{place.vessel, share >= 1};
    if (Draft::Joint* joint = draft.jointOf(other))
      joint->ends.push_back(end);
    else
      draft.joints.push_back({std::nullopt, {other, end}});
    return;
  }
  const Host host{place.vessel, place.parameter};
  for (Draft::Joint& joint : draft.joints)
    if (joint.host == host) return joint.ends.push_back(end);
  draft.joints.push_back({host, {end}});
}

// A straight vessel with knots at equal distances.
std::vector<vec4> straight(vec3 from, vec3 to, float radius) {
  const auto spans = std::uint32_t(std::max(2.0f, std::ceil(glm::distance(from, to) / kBranchSpan)));
  std::vector<vec4> points;
  for (std::uint32_t j = 0; j < spans + 3; ++j)
    points.emplace_back(glm::mix(from, to, float(greville(j, spans)) / float(spans)), radius);
  return points;
}

}  // namespace

Result<std::string> apply(const BranchEdit& edit, VesselId vessel, Draft& draft) {
  if (auto fresh = mustBeNew(draft, edit.name); !fresh) return fresh.error();
  const Draft::Place place = placeAt(draft, vessel, edit.at);
  const auto& points = draft.line(vessel).points;
  const vec4 root = evaluate(points, place.parameter);
  const vec3 direction(glm::normalize(edit.direction)), tangent = unitTangent(points, place.parameter);
  const float length = float(edit.lengthMm) * kMm, cosine = std::abs(glm::dot(direction, tangent));
  if (edit.at > 0 && edit.at < 1) {
    if (cosine > kLeastLeavingCosine)
      return badInput(fmt::format(
          "dx dy dz runs along the vessel, {:.0f} degrees off its course ({:.2f} {:.2f} {:.2f}); a branch leaves by 15 at least",
          std::acos(std::min(cosine, 1.0f)) * 180 / kPi, tangent.x, tangent.y, tangent.z));
    const float inside = root.w / std::sqrt(1 - cosine * cosine);
    if (length <= inside)
      return badInput(fmt::format(
          "length_mm {:.1f} ends within the vessel, whose wall it meets after {:.1f} mm; make it longer",
          edit.lengthMm, inside / kMm));
  }
  const NetworkBuilder::Label label{edit.name, {}, draft.line(vessel).label.kind};
  const VesselId branch =
      append(draft, label, straight(vec3(root), vec3(root) + length * direction, float(edit.radiusMm) * kMm));
  hang(draft, {branch, false}, place, edit.at);
  return fmt::format("\"{}\" of {:.1f} mm, {:.0f} degrees off the vessel's course", edit.name, edit.lengthMm,
                     std::acos(std::clamp(glm::dot(direction, tangent), -1.0f, 1.0f)) * 180 / kPi);
}

namespace {

// Of a graft's straight way, in diagonals of the box around all vessels: a way through a body and back again
// is shorter, and what leads it takes time with each millimetre.
constexpr int kLongestWay = 4;

float wayOf(const Draft& draft, const GraftTask& task) {
  const auto at = [&](Draft::Place place) {
    return vec3(evaluate(draft.line(place.vessel).points, place.parameter));
  };
  vec3 before = at(task.from);
  float way = 0;
  for (const vec3& place : task.via) way += glm::distance(std::exchange(before, place), place);
  return way + glm::distance(before, at(task.to));
}

float reachOf(const Draft& draft) {
  Aabb box;
  for (const Draft::Line& line : draft.lines)
    for (const vec4& point : line.points) box.add(vec3(point));
  return glm::length(box.extent());
}

// Of each line the part of the network that it belongs to: the least number of a line there.
std::vector<std::uint32_t> partsOf(const Draft& draft) {
  DisjointSets parts(draft.lines.size());
  for (const Draft::Joint& joint : draft.joints) {
    if (joint.ends.empty()) continue;
    const std::uint32_t first = joint.host ? joint.host->vessel.value : joint.ends[0].vessel.value;
    for (const VesselEnd& end : joint.ends) parts.unite(first, end.vessel.value);
  }
  std::vector<std::uint32_t> part;
  for (std::uint32_t i = 0; i < draft.lines.size(); ++i) part.push_back(parts.find(i));
  return part;
}

// Of what was one part, and is several now, the one with most vessel stays. @return how many vessels went
std::size_t removeCutOff(Draft& draft, std::span<const std::uint32_t> before, std::uint32_t whole) {
  const std::vector<std::uint32_t> now = partsOf(draft);
  std::map<std::uint32_t, float> lengths;
  const auto isOf = [&](std::uint32_t i) { return before[i] == whole && !draft.lines[i].gone; };
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    if (!isOf(i)) continue;
    const std::vector<vec4>& points = draft.lines[i].points;
    for (std::size_t k = 1; k < points.size(); ++k)
      lengths[now[i]] += glm::distance(vec3(points[k - 1]), vec3(points[k]));
  }
  if (lengths.size() < 2) return 0;
  const auto most = std::ranges::max_element(lengths, {}, [](const auto& part) { return part.second; });
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < now.size(); ++i)
    if (isOf(i) && now[i] != most->first) draft.remove({i}), ++count;
  return count;
}

}  // namespace

Result<std::string> apply(const GraftEdit& edit, VesselId from, Draft& draft) {
  const auto to = draft.find(edit.other);
  if (!to) return badInput("\"" + edit.other + "\": " + to.error().message);
  if (from == *to) return badInput("A and B must be two vessels");
  const std::string name =
      edit.name.empty() ? "graft from " + draft.line(from).label.name + " to " + draft.line(*to).label.name
                        : edit.name;
  if (auto fresh = mustBeNew(draft, name); !fresh) return fresh.error();
  GraftTask task{
      placeAt(draft, from, edit.at), placeAt(draft, *to, edit.otherAt), float(edit.radiusMm) * kMm, {}};
  for (const dvec3& place : edit.via) task.via.push_back(vec3(place) * kMm);
  if (const float way = wayOf(draft, task), most = kLongestWay * reachOf(draft); way > most)
    return badInput(fmt::format(
        "its way is {:.0f} mm long, and nothing over {:.0f} is led: {} times what all vessels reach over; "
        "are its places in millimetres of the network?",
        way / kMm, most / kMm, kLongestWay));
  GraftCourse course = leadGraft(draft, task);
  std::vector<std::string> inTheWay;
  for (const VesselId each : course.inTheWay) inTheWay.push_back(draft.line(each).label.name);
  if (!inTheWay.empty() && edit.via.empty())
    return badInput("no way was found around " + listOf(inTheWay) +
                    "; lead the graft past with via x y z, or begin and end elsewhere");
  for (std::uint32_t span = 0; span < spanCount(course.points); ++span)
    if (kinks(bezierOfSpan(course.points, span))) {
      const vec3 at(bezierOfSpan(course.points, span).at(0.5f));
      return badInput(fmt::format(
          "its course would kink at {:.0f} {:.0f} {:.0f} mm; lead it there more gently with via x y z, or make it thinner",
          at.x / kMm, at.y / kMm, at.z / kMm));
    }
  const float length = lengthOf(course.points);
  const VesselId graft = append(draft, {name, {}, draft.line(from).label.kind}, std::move(course.points));
  hang(draft, {graft, false}, task.from, edit.at);
  hang(draft, {graft, true}, task.to, edit.otherAt);
  return fmt::format("\"{}\" of {:.1f} mm{}", name, length / kMm,
                     inTheWay.empty() ? "" : ", through " + listOf(inTheWay));
}

Result<std::string> apply(const CutEdit& edit, VesselId vessel, Draft& draft) {
  const std::vector<vec4> points = draft.line(vessel).points;
  const ArcLength arc(points);
  const float length = arc.length(), from = float(edit.from) * length, to = float(edit.to) * length;
  const float low = arc.parameterAt(from), high = arc.parameterAt(to), spans = float(spanCount(points));
  const bool keepsHead = edit.from > 0, keepsTail = edit.to < 1;
  if (!keepsHead && !keepsTail) return badInput("nothing would be left of the vessel; write delete");
  for (const auto& [kept, at, rest] :
       {std::tuple{keepsHead, low, from}, std::tuple{keepsTail, high, length - to}})
    if (const float wide = 2 * evaluate(points, at).w; kept && rest < wide)
      return badInput(fmt::format(
          "only {:.1f} mm would be left on one side, less than the vessel is wide ({:.1f} mm); cut from 0 or up to 1",
          rest / kMm, wide / kMm));
  if (const auto hanging = draft.hangingOn(vessel, keepsHead ? low : -1, keepsTail ? high : spans + 1);
      !hanging.empty())
    return badInput(listOf(hanging) + (hanging.size() > 1 ? " hang" : " hangs") +
                    " on what would be cut out; delete " + (hanging.size() > 1 ? "them" : "it") +
                    " first, or cut elsewhere");
  const auto pieceOf = [&](float keepFrom, float keepTo, float at) {
    const float step = length / spans;
    return redrawVessel(points,
                        {at, at, std::min(step, std::max(keepTo - keepFrom, 1e-4f)), keepFrom, keepTo, {}});
  };
  Redrawn head, tail;
  if (keepsHead) head = pieceOf(0, from, from);
  if (keepsTail) tail = pieceOf(to, length, to);
  VesselId second = vessel;
  if (keepsHead && keepsTail) {
    std::string name = draft.line(vessel).label.name;
    for (int k = 2; draft.hasName(name); ++k) name = draft.line(vessel).label.name + fmt::format(" ({})", k);
    NetworkBuilder::Label label = draft.line(vessel).label;
    label.name = name;
    second = append(draft, label, tail.points);
  }
  const auto detach = [&](VesselEnd end) {
    if (Draft::Joint* joint = draft.jointOf(end)) std::erase(joint->ends, end);
  };
  if (!keepsHead) detach({vessel, false});
  if (!keepsTail) detach({vessel, true});
  if (second != vessel)
    if (Draft::Joint* joint = draft.jointOf({vessel, true}))
      std::ranges::replace(joint->ends, VesselEnd{vessel, true}, VesselEnd{second, true});
  const auto map = [&](float u) -> std::optional<Draft::Place> {
    if (keepsHead && u <= low)
      return Draft::Place{vessel, std::min(head.place(u), float(spanCount(head.points)))};
    if (keepsTail && u >= high)
      return Draft::Place{second, std::clamp(tail.place(u), 0.0f, float(spanCount(tail.points)))};
    return std::nullopt;
  };
  draft.redraw(vessel, keepsHead ? head.points : tail.points, map, keepsHead ? head.changedFrom : 0,
               keepsTail ? tail.changedTo : spans);
  draft.dropEmptyJoints();
  const std::string taken = fmt::format("{:.1f} mm taken out", (to - from) / kMm);
  return second == vessel ? taken : taken + "; the rest is \"" + draft.line(second).label.name + "\"";
}

Result<std::string> apply(const JoinEdit& edit, VesselId first, Draft& draft) {
  const auto second = draft.find(edit.other);
  if (!second) return badInput("\"" + edit.other + "\": " + second.error().message);
  if (first == *second) return badInput("A and B must be two vessels");
  // The nearest two ends that are free, or meet each other and nobody else.
  const auto joinable = [&](VesselEnd a, VesselEnd b) {
    const Draft::Joint *at = draft.jointOf(a), *bt = draft.jointOf(b);
    return (!at && !bt) || (at && at == bt && !at->host && at->ends.size() == 2);
  };
  VesselEnd a, b;
  float gap = std::numeric_limits<float>::infinity();
  for (const bool lastA : {true, false})
    for (const bool lastB : {false, true}) {
      const VesselEnd ends[2] = {{first, lastA}, {*second, lastB}};
      const float apart =
          glm::distance(vec3(endPoint(draft.line(first), lastA)), vec3(endPoint(draft.line(*second), lastB)));
      if (joinable(ends[0], ends[1]) && apart < gap) gap = apart, a = ends[0], b = ends[1];
    }
  const std::string other = draft.line(*second).label.name;
  if (!a.vessel.valid())
    return badInput("no end of it and none of \"" + other +
                    "\" are both free; cut them off where they meet others first");
  if (gap > kLongestBridge)
    return badInput(fmt::format("its free end lies {:.1f} mm from \"{}\", more than {:.0f}; write graft",
                                gap / kMm, other, kLongestBridge / kMm));
  // Samples of A up to its end, then of B from its; both as they run from there.
  std::vector<vec4> samples;
  const auto addSamples = [&](const VesselEnd& end, bool towardsEnd) {
    const auto& own = draft.line(end.vessel).points;
    const std::uint32_t count = 4 * spanCount(own);
    for (std::uint32_t k = 0; k <= count; ++k) {
      const std::uint32_t at = end.last == towardsEnd ? k : count - k;
      const vec4 sample = evaluate(own, 0.25f * float(at));
      if (samples.empty() || glm::distance(vec3(sample), vec3(samples.back())) > 1e-6f)
        samples.push_back(sample);
    }
  };
  addSamples(a, true), addSamples(b, false);
  if (!a.last) std::ranges::reverse(samples);
  std::vector<vec4> joined = fitSpline(samples, {{0.05f, 2e-5f, 5e-4f}, {0.01f, 1e-6f, 1e-4f}, 4096});
  // Places are found again by their nearest point.
  const auto nearest = [joined](vec3 at) {
    const std::uint32_t steps = 32 * spanCount(joined);
    float best = 0, least = std::numeric_limits<float>::infinity();
    for (std::uint32_t k = 0; k <= steps; ++k)
      if (const float d = glm::distance(vec3(evaluate(joined, float(k) / 32)), at); d < least)
        least = d, best = float(k) / 32;
    for (float step = 1.0f / 64; step > 1e-5f; step *= 0.5f)
      for (const float u : {best - step, best + step})
        if (const float d = glm::distance(vec3(evaluate(joined, u)), at); d < least)
          least = d, best = std::clamp(u, 0.0f, float(spanCount(joined)));
    return best;
  };
  if (Draft::Joint* joint = draft.jointOf(a)) joint->ends.clear();
  draft.dropEmptyJoints();
  const VesselEnd farOfSecond{*second, !b.last};
  if (Draft::Joint* joint = draft.jointOf(farOfSecond))
    std::ranges::replace(joint->ends, farOfSecond, VesselEnd{first, a.last});
  const std::vector<vec4> before = draft.line(first).points, other_ = draft.line(*second).points;
  for (Draft::Joint& joint : draft.joints)
    if (joint.host && joint.host->vessel == *second) joint.host = Host{first, -1 - joint.host->parameter};
  draft.redraw(
      first, std::move(joined),
      [&](float u) {
        return Draft::Place{
            first, u < 0 ? nearest(vec3(evaluate(other_, -1 - u))) : nearest(vec3(evaluate(before, u)))};
      },
      0, float(spanCount(before)));
  const VesselKind kind = draft.line(first).label.kind, was = draft.line(*second).label.kind;
  draft.remove(*second);
  return fmt::format(
      "\"{}\" is part of it{}{}", other,
      gap > 1e-5f ? fmt::format(", over a gap of {:.1f} mm", gap / kMm) : "",
      was != kind ? fmt::format("; its kind was {} and is {} now", kindName(was), kindName(kind)) : "");
}

Result<std::string> apply(const RenameEdit& edit, VesselId vessel, Draft& draft) {
  if (auto fresh = mustBeNew(draft, edit.name); !fresh) return fresh.error();
  draft.line(vessel).label.name = edit.name;
  return "named \"" + edit.name + "\"";
}

Result<std::string> apply(const KindEdit& edit, VesselId vessel, Draft& draft) {
  const std::string before(kindName(draft.line(vessel).label.kind));
  draft.line(vessel).label.kind = edit.kind;
  return fmt::format("{}, was {}", kindName(edit.kind), before);
}

Result<std::string> apply(const DeleteEdit& edit, VesselId vessel, Draft& draft) {
  std::vector<VesselId> below{vessel};
  for (std::size_t i = 0; i < below.size(); ++i)
    for (const Draft::Joint& joint : draft.joints)
      if (joint.host && joint.host->vessel == below[i])
        for (const VesselEnd& end : joint.ends)
          if (std::ranges::find(below, end.vessel) == below.end()) below.push_back(end.vessel);
  if (below.size() > 1 && !edit.tree) {
    const auto hanging = draft.hangingOn(vessel, -1, 1e9f);
    return badInput(listOf(hanging) + (hanging.size() > 1 ? " hang" : " hangs") +
                    " on it; delete it with its branches (in a journal: delete ... tree) to take all " +
                    fmt::format("{} below it away, too", below.size() - 1));
  }
  const std::vector<std::uint32_t> before = partsOf(draft);
  const std::uint32_t whole = before[vessel.value];
  for (const VesselId each : below) draft.remove(each);
  std::size_t taken = below.size();
  if (edit.tree) taken += removeCutOff(draft, before, whole);
  return taken > 1 ? fmt::format("taken away with {} that hung on it", taken - 1) : "taken away";
}

}  // namespace vasa
