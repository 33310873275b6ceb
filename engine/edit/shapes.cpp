#include "edit/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "curve/arc_length.h"
#include "curve/frame.h"
#include "edit/bump.h"
#include "edit/redraw.h"
#include "network/kinks.h"

namespace vasa {
namespace {

constexpr float kStepsOfLesion = 10;  // spans over a lesion's length: bump() is then met within 0.3 %
// A tube has a radius everywhere; a hundredth of it lets nothing through.
constexpr float kOccludedPercent = 99;
constexpr float kStentSlack = 0.02f;  // of the stent's radius, over which the wall comes to lie on it
constexpr float kWayToFalloff = 3;    // bends a straight vessel by less than 35 degrees

struct Course {
  std::span<const vec4> points;
  ArcLength arc;
  explicit Course(const Draft::Line& line) : points(line.points), arc(line.points) {}
  float metres(double share) const { return float(share) * arc.length(); }
  vec4 at(float along) const { return evaluate(points, arc.parameterAt(along)); }
  vec3 tangent(float along) const { return unitTangent(points, arc.parameterAt(along)); }
};

// The first place where a tube folds over itself that did not before; negative: none.
float firstFold(std::span<const vec4> before, std::span<const vec4> after, float from, float to) {
  const auto foldsIn = [](std::span<const vec4> points, std::uint32_t span) {
    return kinks(bezierOfSpan(points, span));
  };
  const auto first = std::uint32_t(std::max(from, 0.0f)),
             last = std::min(std::uint32_t(std::ceil(to)), spanCount(before));
  for (std::uint32_t span = first; span < last; ++span)
    if (foldsIn(before, span)) return -1;  // it was no better
  const std::uint32_t end = last + spanCount(after) - spanCount(before);
  for (std::uint32_t span = first; span < end && span < spanCount(after); ++span)
    if (foldsIn(after, span)) return float(span);
  return -1;
}

Result<void> redrawLine(Draft& draft, VesselId vessel, const Redrawing& redrawing) {
  const Draft::Line& line = draft.line(vessel);
  Redrawn drawn = redrawVessel(line.points, redrawing);
  for (const vec4& p : drawn.points)
    if (!(p.w > 0)) return badInput("the radius would not stay above 0; make the change longer or less");
  if (const float fold = firstFold(line.points, drawn.points, drawn.changedFrom, drawn.changedTo);
      fold >= 0) {
    const ArcLength arc(drawn.points);
    return badInput(fmt::format(
        "the wall would fold over itself at {:.3f} of the vessel, where it is wider than its bend allows; make "
        "it longer, narrower or less one-sided",
        arc.along(fold) / arc.length()));
  }
  // An end that meets others stays where it is.
  for (const bool last : {false, true})
    if (draft.jointOf({vessel, last})) {
      vec4& end = last ? drawn.points.back() : drawn.points.front();
      end = vec4(vec3(endPoint(line, last)), end.w);
    }
  draft.redraw(
      vessel, std::move(drawn.points),
      [&](float u) {
        return Draft::Place{vessel, drawn.place(u)};
      },
      drawn.changedFrom, drawn.changedTo);
  return {};
}

// 1 along the vessel, and 0 at ends that meet others: what keeps them where they are.
float holdOfEnds(const Draft& draft, VesselId vessel, float length, float reach, float along) {
  float hold = 1;
  if (draft.jointOf({vessel, false})) hold *= smoothStep(along / reach);
  if (draft.jointOf({vessel, true})) hold *= smoothStep((length - along) / reach);
  return hold;
}

// By EditSide.
constexpr vec3 kAxes[] = {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}};

// The unit direction at right angles to the tangent that is nearest to `wanted`; none where that runs along
// it.
vec3 aside(vec3 wanted, vec3 tangent) {
  const vec3 part = wanted - glm::dot(wanted, tangent) * tangent;
  return glm::length(part) > 0.1f * glm::length(wanted) ? glm::normalize(part) : vec3(0);
}

// Away from the centre of the bend; on a straight vessel to the body's front, or up.
vec3 outsideOfBend(const Course& course, float along, float reach) {
  const vec3 tangent = course.tangent(along);
  const vec3 before(course.at(std::max(along - reach, 0.0f))), here(course.at(along)),
      after(course.at(along + reach));
  const vec3 out = here - 0.5f * (before + after);
  const vec3 part = out - glm::dot(out, tangent) * tangent;
  if (glm::length(part) > 0.01f * reach) return glm::normalize(part);
  const vec3 front = aside({0, 0, 1}, tangent);
  return glm::length(front) > 0 ? front : aside({0, 1, 0}, tangent);
}

float percentOf(float whole, float part) { return 100 * (1 - part / whole); }

Result<std::string> narrow(Draft& draft, VesselId vessel, double at, float length, float percent,
                           float eccentricity) {
  const Course course(draft.line(vessel));
  const float middle = course.metres(at), half = 0.5f * length, depth = percent / 100;
  if (length > course.arc.length())
    return badInput(fmt::format("length_mm {:.1f} is more than the vessel's own {:.1f} mm", length / kMm,
                                course.arc.length() / kMm));
  const vec3 side = eccentricity > 0 ? outsideOfBend(course, middle, half) : vec3(0);
  const float whole = course.at(middle).w;
  Redrawing redrawing{std::max(middle - half, 0.0f), std::min(middle + half, course.arc.length()),
                      length / kStepsOfLesion};
  redrawing.shape = [&, vesselLength = course.arc.length()](float along, vec4 was) {
    const float share = depth * bump((along - middle) / half);
    const float off =
        eccentricity > 0 ? eccentricity * share * was.w * holdOfEnds(draft, vessel, vesselLength, half, along)
                         : 0.0f;
    return vec4(vec3(was) + off * side, was.w * (1 - share));
  };
  if (auto drawn = redrawLine(draft, vessel, redrawing); !drawn) return drawn.error();
  float least = whole;
  const Course now(draft.line(vessel));
  for (int k = -20; k <= 20; ++k) least = std::min(least, now.at(now.metres(at) + half * float(k) / 20).w);
  return fmt::format("diameter {:.2f} mm, was {:.2f} mm ({:.1f} %)", 2 * least / kMm, 2 * whole / kMm,
                     percentOf(whole, least));
}

}  // namespace

Result<std::string> apply(const RadiusEdit& edit, VesselId vessel, Draft& draft) {
  const Course course(draft.line(vessel));
  const float length = course.arc.length(), from = course.metres(edit.from), to = course.metres(edit.to);
  const float middle = 0.5f * (from + to), half = 0.5f * (to - from), factor = float(edit.factor);
  // Outside of the stretch the factor fades over one diameter; at an end of the vessel it need not.
  const float before = edit.smooth ? 0 : std::min(from, 2 * course.at(from).w);
  const float after = edit.smooth ? 0 : std::min(length - to, 2 * course.at(to).w);
  const auto share = [&](float along) {
    if (edit.smooth) return bump((along - middle) / half);
    if (along < from) return before > 0 ? smoothStep(1 - (from - along) / before) : 0.0f;
    if (along > to) return after > 0 ? smoothStep(1 - (along - to) / after) : 0.0f;
    return 1.0f;
  };
  float step = edit.smooth ? 2 * half / kStepsOfLesion : half;
  for (const float fade : {before, after})
    if (fade > 0) step = std::min(step, fade / 3);
  Redrawing redrawing{from - before, to + after, step};
  redrawing.shape = [&](float along, vec4 was) {
    return vec4(vec3(was), was.w * std::pow(factor, share(along)));
  };
  if (auto drawn = redrawLine(draft, vessel, redrawing); !drawn) return drawn.error();
  return fmt::format("radius times {:.3g} from {:.1f} to {:.1f} mm", factor, from / kMm, to / kMm);
}

Result<std::string> apply(const StenosisEdit& edit, VesselId vessel, Draft& draft) {
  return narrow(draft, vessel, edit.at, float(edit.lengthMm) * kMm, float(edit.percent),
                float(edit.eccentricity));
}

Result<std::string> apply(const OccludeEdit& edit, VesselId vessel, Draft& draft) {
  const Course course(draft.line(vessel));
  const float length = std::min(4 * course.at(course.metres(edit.at)).w, course.arc.length());
  return narrow(draft, vessel, edit.at, length, kOccludedPercent, 0);
}

Result<std::string> apply(const AneurysmEdit& edit, VesselId vessel, Draft& draft) {
  const Course course(draft.line(vessel));
  const float length = course.arc.length(), middle = course.metres(edit.at),
              half = 0.5f * float(edit.lengthMm) * kMm;
  const float radius = 0.5f * float(edit.diameterMm) * kMm, whole = course.at(middle).w;
  if (2 * half > length)
    return badInput(fmt::format("length_mm {:.1f} is more than the vessel's own {:.1f} mm", 2 * half / kMm,
                                length / kMm));
  if (radius <= whole)
    return badInput(fmt::format("diameter_mm {:.1f} is no more than the {:.1f} mm that the vessel has there",
                                edit.diameterMm, 2 * whole / kMm));
  vec3 side(0);
  if (edit.side != EditSide::none) {
    side = aside(kAxes[int(edit.side)], course.tangent(middle));
    if (glm::length(side) == 0) return badInput("the vessel runs to that side itself; choose another side");
  }
  Redrawing redrawing{std::max(middle - half, 0.0f), std::min(middle + half, length),
                      2 * half / kStepsOfLesion};
  redrawing.shape = [&](float along, vec4 was) {
    const float more = (radius - whole) * bump((along - middle) / half);
    return vec4(vec3(was) + more * holdOfEnds(draft, vessel, length, half, along) * side, was.w + more);
  };
  if (auto drawn = redrawLine(draft, vessel, redrawing); !drawn) return drawn.error();
  const Course now(draft.line(vessel));
  float most = 0;
  for (int k = 0; k <= 400; ++k)
    most = std::max(most, now.at(now.metres(edit.at) + half * (float(k) / 200 - 1)).w);
  return fmt::format("diameter {:.2f} mm, was {:.2f} mm", 2 * most / kMm, 2 * whole / kMm);
}

Result<std::string> apply(const MoveEdit& edit, VesselId vessel, Draft& draft) {
  const Course course(draft.line(vessel));
  const float length = course.arc.length(), middle = course.metres(edit.at);
  const vec3 way = vec3(edit.byMm) * kMm;
  const float falloff = edit.falloffMm > 0 ? float(edit.falloffMm) * kMm : kWayToFalloff * glm::length(way);
  // An end that meets others holds the course within what lies between the two, so that the place itself
  // moves all the way.
  const bool heldStart = draft.jointOf({vessel, false}) != nullptr,
             heldEnd = draft.jointOf({vessel, true}) != nullptr;
  const float before = heldStart ? std::min(falloff, middle) : falloff,
              after = heldEnd ? std::min(falloff, length - middle) : falloff;
  const float least = std::min({before, after, length});
  if (!(least > glm::length(way)))
    return badInput(fmt::format(
        "it lies {:.1f} mm from where the vessel meets another, or has so short a falloff, which is too near to be moved by {:.1f} mm; "
        "choose a place farther on, a longer falloff_mm or a shorter way",
        least / kMm, glm::length(way) / kMm));
  Redrawing redrawing{std::max(middle - before, 0.0f), std::min(middle + after, length),
                      std::min(before, after) / 4};
  redrawing.shape = [&](float along, vec4 was) {
    return was + vec4(bump((along - middle) / (along < middle ? before : after)) * way, 0);
  };
  if (auto drawn = redrawLine(draft, vessel, redrawing); !drawn) return drawn.error();
  return fmt::format("moved by {:.1f} mm, fading over {:.1f} mm", glm::length(way) / kMm, falloff / kMm);
}

Result<std::string> apply(const StentEdit& edit, VesselId vessel, Draft& draft) {
  const Course course(draft.line(vessel));
  const float length = course.arc.length(), from = course.metres(edit.from), to = course.metres(edit.to);
  const float floor = float(edit.radiusMm) * kMm;
  float narrowest = floor;
  for (int k = 0; k <= 400; ++k)
    narrowest = std::min(narrowest, course.at(std::lerp(from, to, float(k) / 400)).w);
  if (narrowest >= floor)
    return badInput(fmt::format(
        "the vessel is nowhere narrower there than radius_mm {:.2f}; a stent would hang loose in it",
        edit.radiusMm));
  const float before = std::min(from, 2 * floor), after = std::min(length - to, 2 * floor);
  Redrawing redrawing{from - before, to + after, std::min(0.5f * floor, (to - from) / 8)};
  redrawing.shape = [&](float along, vec4 was) {
    const float share = along < from ? smoothStep(1 - (from - along) / before)
                        : along > to ? smoothStep(1 - (along - to) / after)
                                     : 1.0f;
    const float lack = floor - was.w, slack = kStentSlack * floor;
    return vec4(vec3(was), was.w + share * 0.5f * (lack + std::sqrt(lack * lack + slack * slack)));
  };
  if (auto drawn = redrawLine(draft, vessel, redrawing); !drawn) return drawn.error();
  const Course now(draft.line(vessel));
  float least = 1e9f;
  for (int k = 0; k <= 400; ++k)
    least = std::min(least, now.at(now.metres(std::lerp(edit.from, edit.to, double(k) / 400))).w);
  return fmt::format("least diameter {:.2f} mm, was {:.2f} mm", 2 * least / kMm, 2 * narrowest / kMm);
}

}  // namespace vasa
