#include "convert/overlap.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "convert/source.h"
#include "core/cancellation.h"
#include "core/ids.h"

namespace vasa {
namespace {

vec3 directionAt(const Sections& sections, std::size_t i) {
  const std::size_t before = i ? i - 1 : 0, after = std::min(i + 1, sections.size() - 1);
  return glm::normalize(vec3(sections[after]) - vec3(sections[before]) + vec3(1e-20f));
}

class OverlapFinder {
 public:
  OverlapFinder(const StrandGraph& graph, const OverlapOptions& options) : graph_(graph), options_(options) {
    for (const Strand& strand : graph.strands) {
      boxes_.push_back(boxOf(strand.sections));
      lengths_.push_back(strand.dropped() ? 0 : lengthOf(strand.sections));
    }
  }
  static Aabb boxOf(const Sections& sections) {
    Aabb box;
    for (const vec4& section : sections) box.add(vec3(section), section.w);
    return box;
  }
  float length(std::uint32_t strand) const { return lengths_[strand]; }
  void refresh(std::uint32_t strand) { boxes_[strand] = boxOf(graph_.strands[strand].sections); }

  // For each section the strand of another element along whose axis it runs.
  std::vector<std::uint32_t> coverers(std::uint32_t strand) const {
    const Strand& own = graph_.strands[strand];
    std::vector<std::uint32_t> by(own.sections.size(), kNone);
    for (std::uint32_t other = 0; other < graph_.strands.size(); ++other) {
      const Strand& host = graph_.strands[other];
      if (other == strand || host.dropped() || host.element == own.element ||
          !sameFamily(own.kind, host.kind) || !boxes_[strand].overlaps(boxes_[other]) ||
          lengths_[other] < lengths_[strand])
        continue;
      for (std::size_t i = 0; i < by.size(); ++i)
        if (by[i] == kNone && runsInside(own.sections, i, host.sections)) by[i] = other;
    }
    return by;
  }

 private:
  bool runsInside(const Sections& own, std::size_t i, const Sections& host) const {
    const vec4 section = own[i];
    const Along at = nearestAlong(host, vec3(section));
    const float small = std::min(section.w, at.section.w), large = std::max(section.w, at.section.w);
    if (at.distance > options_.axisRadii * large || large > options_.radiusRatio * small) return false;
    const vec3 along = glm::normalize(vec3(host[at.segment + 1]) - vec3(host[at.segment]) + vec3(1e-20f));
    return std::abs(glm::dot(directionAt(own, i), along)) >= options_.straightness;
  }

  const StrandGraph& graph_;
  OverlapOptions options_;
  std::vector<Aabb> boxes_;
  std::vector<float> lengths_;
};

float coveredShare(const Sections& sections, std::span<const std::uint32_t> by) {
  float covered = 0, whole = 0;
  for (std::size_t i = 1; i < sections.size(); ++i) {
    const float length = glm::distance(vec3(sections[i - 1]), vec3(sections[i]));
    whole += length;
    covered += length * 0.5f * float((by[i] != kNone) + (by[i - 1] != kNone));
  }
  return whole > 0 ? covered / whole : 0;
}

std::uint32_t mostFrequent(std::span<const std::uint32_t> by) {
  std::map<std::uint32_t, int> counts;
  for (const std::uint32_t strand : by)
    if (strand != kNone) ++counts[strand];
  return std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
}

// Takes covered sections off a free end, all but the last of them, so that the end still reaches the other.
void cutBack(Sections& sections, std::vector<std::uint32_t>& by, bool last) {
  if (last) std::ranges::reverse(sections), std::ranges::reverse(by);
  std::size_t run = 0;
  while (run < by.size() && by[run] != kNone) ++run;
  if (run > 1 && sections.size() - (run - 1) >= 2) {
    sections.erase(sections.begin(), sections.begin() + std::ptrdiff_t(run - 1));
    by.erase(by.begin(), by.begin() + std::ptrdiff_t(run - 1));
  }
  if (last) std::ranges::reverse(sections), std::ranges::reverse(by);
}

}  // namespace

std::vector<Absorbed> removeOverlaps(StrandGraph& graph, const OverlapOptions& options) {
  OverlapFinder finder(graph, options);
  std::vector<std::uint32_t> order(graph.strands.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t strand) { return finder.length(strand); });
  std::vector<Absorbed> absorbed;
  for (const std::uint32_t strand : order) {
    checkpoint();
    Strand& own = graph.strands[strand];
    if (own.dropped()) continue;
    std::vector<std::uint32_t> by = finder.coverers(strand);
    if (std::ranges::all_of(by, [](std::uint32_t other) { return other == kNone; })) continue;
    if (coveredShare(own.sections, by) >= options.dropShare) {
      absorbed.push_back({own.element, graph.strands[mostFrequent(by)].element});
      graph.drop(strand);
      continue;
    }
    for (const bool last : {false, true})
      if (graph.isFree({strand, last})) cutBack(own.sections, by, last);
    finder.refresh(strand);
  }
  return absorbed;
}

}  // namespace vasa
