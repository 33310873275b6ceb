#include "convert/strand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "convert/without_folds.h"
#include "core/ids.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr float kTinyStep = 0.25f;  // radii: a step of less would only put a wiggle into the fit

}  // namespace

Along nearestAlong(const Sections& sections, vec3 p) {
  Along best;
  best.distance = std::numeric_limits<float>::infinity();
  float arc = 0;
  for (std::uint32_t i = 0; i + 1 < sections.size(); ++i) {
    const vec3 a(sections[i]), b(sections[i + 1]);
    const float length = glm::distance(a, b), t = closestOnSegment(p, a, b);
    const float distance = glm::distance(p, a + t * (b - a));
    if (distance < best.distance)
      best = {i, t, arc + t * length, glm::mix(sections[i], sections[i + 1], t), distance};
    arc += length;
  }
  return best;
}

float lengthOf(const Sections& sections) {
  float sum = 0;
  for (std::size_t i = 1; i < sections.size(); ++i)
    sum += glm::distance(vec3(sections[i - 1]), vec3(sections[i]));
  return sum;
}

Along atArc(const Sections& sections, float arc) {
  float reached = 0;
  for (std::uint32_t i = 0; i + 1 < sections.size(); ++i) {
    const float length = glm::distance(vec3(sections[i]), vec3(sections[i + 1]));
    if (reached + length >= arc || i + 2 == sections.size()) {
      const float t = length > 0 ? std::clamp((arc - reached) / length, 0.0f, 1.0f) : 0.0f;
      return {i, t, reached + t * length, glm::mix(sections[i], sections[i + 1], t), 0};
    }
    reached += length;
  }
  return {};
}

float endRadius(const Sections& sections, bool last) {
  const std::size_t count = sections.size();
  const auto at = [&](std::size_t i) { return sections[last ? count - 1 - i : i]; };
  float radius = at(0).w;
  for (std::size_t i = 1; i < count && glm::distance(vec3(at(i)), vec3(at(0))) <= 2 * radius; ++i)
    radius = std::max(radius, at(i).w);
  return radius;
}

vec3 outwardDirection(const Sections& sections, bool last) {
  const float radius = endRadius(sections, last), length = lengthOf(sections);
  const auto at = [&](float arc) { return vec3(atArc(sections, last ? length - arc : arc).section); };
  const float far = std::min(3.5f * radius, length), near = std::min(1.5f * radius, 0.3f * far);
  const vec3 away = at(near) - at(far);
  const float size = glm::length(away);
  return size > 0 ? away / size : vec3(0, 1, 0);
}

void trimTaper(Sections& sections, bool last) {
  const float radius = endRadius(sections, last);
  if (last) std::ranges::reverse(sections);
  std::size_t cut = 0;
  const vec3 tip(sections.front());
  while (cut + 2 < sections.size() && sections[cut].w < 0.7f * radius &&
         glm::distance(tip, vec3(sections[cut + 1])) <= radius)
    ++cut;
  sections.erase(sections.begin(), sections.begin() + std::ptrdiff_t(cut));
  if (last) std::ranges::reverse(sections);
}

std::uint32_t StrandGraph::add(Strand strand) {
  strands.push_back(std::move(strand));
  return std::uint32_t(strands.size() - 1);
}

vec4 StrandGraph::sectionAt(StrandEnd end) const {
  const Sections& sections = strands[end.strand].sections;
  return end.last ? sections.back() : sections.front();
}

void StrandGraph::extendTo(StrandEnd end, vec3 place) {
  Sections& sections = strands[end.strand].sections;
  const vec4 tip = sectionAt(end);
  const bool replace = glm::distance(vec3(tip), place) < kTinyStep * tip.w && sections.size() > 2;
  const vec4 section(place, tip.w);
  if (glm::distance(vec3(tip), place) == 0) return;
  if (replace)
    (end.last ? sections.back() : sections.front()) = section;
  else
    sections.insert(end.last ? sections.end() : sections.begin(), section);
}

void StrandGraph::addEnd(std::uint32_t joint, StrandEnd end) {
  joints[joint].ends.push_back(end);
  Strand& strand = strands[end.strand];
  (end.last ? strand.endJoint : strand.startJoint) = joint;
  extendTo(end, joints[joint].place);
}

std::uint32_t StrandGraph::join(std::optional<std::uint32_t> host, vec3 place,
                                std::span<const StrandEnd> ends) {
  const std::uint32_t joint = std::uint32_t(joints.size());
  joints.push_back({host, place, {}});
  for (const StrandEnd& end : ends) addEnd(joint, end);
  return joint;
}

void StrandGraph::dissolve(std::uint32_t joint) {
  for (const StrandEnd& end : joints[joint].ends)
    (end.last ? strands[end.strand].endJoint : strands[end.strand].startJoint) = kNone;
  joints[joint].ends.clear();
  joints[joint].host.reset();
}

void StrandGraph::release(StrandEnd end) {
  const std::uint32_t joint = jointAt(end);
  if (joint == kNone) return;
  std::erase(joints[joint].ends, end);
  (end.last ? strands[end.strand].endJoint : strands[end.strand].startJoint) = kNone;
  const std::size_t left = joints[joint].ends.size();
  if (left == 0 || (left == 1 && !joints[joint].host)) dissolve(joint);
}

void StrandGraph::drop(std::uint32_t strand) {
  release({strand, false});
  release({strand, true});
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (joints[j].host != strand) continue;
    joints[j].host.reset();
    if (joints[j].ends.size() < 2) dissolve(j);
  }
  strands[strand].sections.clear();
}

std::uint32_t StrandGraph::split(std::uint32_t strand, float arc) {
  const Along cut = atArc(strands[strand].sections, arc);
  Strand rest = strands[strand];
  Sections& whole = strands[strand].sections;
  rest.sections.assign(whole.begin() + cut.segment + 1, whole.end());
  whole.resize(cut.segment + 1);
  const vec3 place(cut.section);
  if (glm::distance(vec3(whole.back()), place) > 0 || whole.size() < 2) whole.push_back(cut.section);
  if (glm::distance(vec3(rest.sections.front()), place) > 0 || rest.sections.size() < 2)
    rest.sections.insert(rest.sections.begin(), cut.section);
  rest.startJoint = kNone;
  strands[strand].endJoint = kNone;
  const std::uint32_t second = add(std::move(rest));
  if (const std::uint32_t joint = strands[second].endJoint; joint != kNone)
    for (StrandEnd& end : joints[joint].ends)
      if (end == StrandEnd{strand, true}) end.strand = second;
  for (Joint& joint : joints) {
    if (joint.host != strand) continue;
    const Along first = nearestAlong(strands[strand].sections, joint.place);
    if (nearestAlong(strands[second].sections, joint.place).distance < first.distance) joint.host = second;
  }
  const StrandEnd halves[] = {{strand, true}, {second, false}};
  return join(std::nullopt, place, halves);
}

void StrandGraph::removeFolds() {
  std::vector<std::vector<vec3>> hosted(strands.size());
  for (const Joint& joint : joints)
    if (joint.host) hosted[*joint.host].push_back(joint.place);
  std::vector<bool> changed(strands.size(), false);
  for (std::size_t s = 0; s < strands.size(); ++s) {
    if (strands[s].dropped()) continue;
    Sections kept = withoutFolds(strands[s].sections, hosted[s]);
    changed[s] = kept.size() < strands[s].sections.size();
    strands[s].sections = std::move(kept);
  }
  for (Joint& joint : joints) {
    if (!joint.host || !changed[*joint.host] || joint.ends.empty()) continue;
    joint.place = vec3(nearestAlong(strands[*joint.host].sections, joint.place).section);
    for (const StrandEnd& end : joint.ends) extendTo(end, joint.place);
  }
}

// Depth-first over joints: a joint on a host needs the joints at the host's ends settled before it.
std::optional<std::uint32_t> StrandGraph::jointInCircle() const {
  enum : char { unseen, open, done };
  std::vector<char> state(joints.size(), unseen);
  struct Step {
    std::uint32_t joint;
    int next;
  };
  std::vector<Step> stack;
  for (std::uint32_t first = 0; first < joints.size(); ++first) {
    if (state[first] != unseen) continue;
    state[first] = open;
    stack.push_back({first, 0});
    while (!stack.empty()) {
      Step& step = stack.back();
      const Joint& joint = joints[step.joint];
      if (!joint.host || step.next == 2) {
        state[step.joint] = done;
        stack.pop_back();
        continue;
      }
      const Strand& host = strands[*joint.host];
      const std::uint32_t needed = step.next++ == 0 ? host.startJoint : host.endJoint;
      if (needed == kNone || state[needed] == done) continue;
      if (state[needed] == open) return step.joint;
      state[needed] = open;
      stack.push_back({needed, 0});
    }
  }
  return std::nullopt;
}

void StrandGraph::breakCircles() {
  while (const auto found = jointInCircle()) {
    const std::uint32_t joint = *found, host = *joints[joint].host;
    const Sections& sections = strands[host].sections;
    const Along at = nearestAlong(sections, joints[joint].place);
    const float length = lengthOf(sections), margin = std::min(at.section.w, 0.25f * length);
    const std::vector<StrandEnd> ends = joints[joint].ends;
    const bool nearStart = at.arc < margin, nearEnd = length - at.arc < margin;
    const StrandEnd tip{host, nearEnd};
    dissolve(joint);
    std::uint32_t meeting;
    if (!nearStart && !nearEnd) {
      meeting = split(host, at.arc);
    } else if (isFree(tip)) {
      meeting = join(std::nullopt, vec3(sectionAt(tip)), std::span(&tip, 1));
    } else {
      meeting = jointAt(tip);
    }
    for (const StrandEnd& end : ends)
      if (joints[meeting].host != end.strand) addEnd(meeting, end);
    if (joints[meeting].ends.size() < 2 && !joints[meeting].host) dissolve(meeting);
  }
}

}  // namespace vasa
