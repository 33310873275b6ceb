#include "growth/plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "growth/random.h"

namespace vasa {
namespace {

// [pixels] of the thickest stems: thinner trees are threads; where a body is 720 pixels tall, 0.5
constexpr float kThread = 0.6f;

// Lengths of a system's curves in first radii of the stem.
struct Sizes {
  std::array<float, shared::kMostGrowthLevels> longest{};  // curve of each generation
  std::array<float, shared::kMostGrowthLevels> reach{};    // of a tree with so many generations more
  float stem = 0;
};

void addGeneration(const shared::GrowthTables& tables, std::uint32_t symbol, float radius,
                   std::uint32_t generation, float way, Sizes& sizes) {
  const shared::GrowthSymbol& s = tables.symbol[symbol];
  const float length = radius * s.reach * (1 + s.reachSpread);
  sizes.longest[generation] = std::max(sizes.longest[generation], length);
  sizes.reach[generation] = std::max(sizes.reach[generation], way + length);
  if (generation + 1 == 3) return;  // deeper ones are taken to shrink alike
  for (std::uint32_t c = 0; c < s.childCount; ++c) {
    const shared::GrowthChild& child = tables.child[s.firstChild + c];
    addGeneration(tables, child.symbol, radius * child.radius * child.stretch, generation + 1,
                  way + length * child.at, sizes);
  }
}

Sizes sizesOf(const shared::GrowthTables& tables, const shared::GrowthSystem& system) {
  Sizes sizes;
  addGeneration(tables, system.axiom, 1, 0, 0, sizes);
  for (std::size_t g = 3; g < shared::kMostGrowthLevels; ++g) {
    const float shrink =
        sizes.longest[g - 2] > 0 ? std::min(sizes.longest[g - 1] / sizes.longest[g - 2], 1.0f) : 0;
    sizes.longest[g] = sizes.longest[g - 1] * shrink;
    sizes.reach[g] = sizes.reach[g - 1] + sizes.longest[g];
  }
  return sizes;
}

struct Plane {
  vec3 normal;
  float offset;
};

// Left, right, top, bottom and near side of what is seen; points inside have positive distances.
std::array<Plane, 5> planesOf(const mat4& m) {
  const auto row = [&](int i) { return vec4(m[0][i], m[1][i], m[2][i], m[3][i]); };
  const std::array<vec4, 5> rows{row(3) + row(0), row(3) - row(0), row(3) + row(1), row(3) - row(1),
                                 row(3) - row(2)};
  std::array<Plane, 5> planes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const float length = glm::length(vec3(rows[i]));
    planes[i] = length > 0 ? Plane{vec3(rows[i]) / length, rows[i].w / length} : Plane{vec3(0), 1};
  }
  return planes;
}

// A span's trees as this picture sees them.
struct Seen {
  float distance;  // the farthest come first
  std::uint32_t span, levels, edges, size, trees;
};

// By the size of the longest stem of all systems, so that trees side by side share a batch.
std::uint32_t edgesFor(float pixels) { return pixels < 40 ? 3 : pixels < 80 ? 5 : pixels < 200 ? 8 : 10; }

std::uint32_t endsIn(std::uint8_t bits) { return (bits & 1u) + (bits >> 1 & 1u); }

class Planner {
 public:
  Planner(const PlanInput& input, const CapillaryWish& wish)
      : in_(input), wish_(wish), planes_(planesOf(input.view.viewProjection)) {
    for (std::size_t s = 0; s < sizes_.size(); ++s) {
      sizes_[s] = sizesOf(in_.tables, in_.tables.system[s]);
      longestStem_ = std::max(longestStem_, in_.tables.system[s].mostRadius * sizes_[s].longest[0]);
      thickestStem_ = std::max(thickestStem_, 2 * in_.tables.system[s].mostRadius);
    }
  }

  bool see(std::uint32_t span, Seen& seen) const {
    const std::uint32_t number = in_.sites.sites[span].system & 0xffu;
    const shared::GrowthSystem& system = in_.tables.system[number];
    const vec4* p = &in_.points[in_.sites.spans[span].point];
    const vec3 centre = vec3(p[0] + p[1] + p[2] + p[3]) * 0.25f;
    float wide = 0, thick = 0;
    for (int i = 0; i < 4; ++i) {
      wide = std::max(wide, glm::distance(centre, vec3(p[i])));
      thick = std::max(thick, p[i].w);
    }
    const bool ends = in_.sites.freeEnds[span] != 0;
    const float root =
        std::max(std::min(thick * system.share, system.mostRadius), ends ? thick * system.tipRadius : 0.0f);
    const Sizes& sizes = sizes_[number];
    std::uint32_t levels = levelsOf(in_.tables, number, wish_.levels);
    const float radius = wide + thick + root * sizes.reach[levels - 1];
    for (const Plane& plane : planes_)
      if (glm::dot(plane.normal, centre) + plane.offset < -radius) return false;
    const float depth = glm::dot(vec3(in_.view.depth), centre) + in_.view.depth.w;
    const float pixels = in_.view.focal / std::max(depth - radius * in_.view.perspective, 0.01f);
    while (levels > 1 && root * sizes.longest[levels - 1] * pixels < wish_.smallest) --levels;
    if (root * sizes.longest[0] * pixels < wish_.smallest) return false;
    const float distance = in_.view.perspective > 0 ? depth : -glm::dot(in_.view.eye, centre);
    seen = {distance, span, levels, edgesAt(in_.view.focal / std::max(depth, 0.01f)), 0, treesOn(span)};
    seen.size = sizeOf(seen);
    return true;
  }

  // Curves of a tree.
  std::uint32_t sizeOf(const Seen& seen) const {
    return in_.tables.symbol[in_.tables.system[in_.sites.sites[seen.span].system & 0xffu].axiom]
        .treeSize[seen.levels];
  }

  std::uint32_t tipsOf(std::uint32_t span) const {
    return in_.tables.system[in_.sites.sites[span].system & 0xffu].tips;
  }
  std::uint32_t treesOn(std::uint32_t span) const {
    return in_.sites.sites[span].sprouts + tipsOf(span) * endsIn(in_.sites.freeEnds[span]);
  }

 private:
  // Where a metre is so many pixels.
  std::uint32_t edgesAt(float pixels) const {
    if (wish_.edges) return wish_.edges;
    const std::uint32_t edges = edgesFor(longestStem_ * pixels);
    const bool thin = wish_.smallest > 0 && thickestStem_ * pixels < kThread;
    return thin && edges == shared::kThreadEdges ? shared::kThreads : edges;
  }

  const PlanInput& in_;
  const CapillaryWish& wish_;
  std::array<Plane, 5> planes_;
  std::array<Sizes, shared::kMostGrowthSystems> sizes_;
  float longestStem_ = 0, thickestStem_ = 0;  // of all systems
};

// Takes generations from the deepest trees until all keep to the budget or are stems. Returns how many curves
// that leaves.
std::uint64_t curvesWithin(std::uint32_t budget, const Planner& planner, std::vector<Seen>& seen) {
  std::uint64_t curves = 0;
  for (std::uint32_t most = shared::kMostGrowthLevels; most > 0; --most) {
    curves = 0;
    for (Seen& one : seen) {
      one.levels = std::min(one.levels, most);
      one.size = planner.sizeOf(one);
      curves += std::uint64_t(one.trees) * one.size;
    }
    if (curves <= budget) break;
  }
  return curves;
}

// Fills batches with whole trees.
class BatchWriter {
 public:
  explicit BatchWriter(CapillaryPlan& plan) : plan_(plan) {}

  void add(const Seen& seen, std::uint32_t firstSprout, std::uint32_t count) {
    while (count > 0) {
      if (plan_.batches.empty() || plan_.batches.back().edges != seen.edges || room() < seen.size)
        plan_.batches.push_back({std::uint32_t(plan_.jobs.size()), 0, 0, seen.edges});
      CapillaryBatch& batch = plan_.batches.back();
      const std::uint32_t trees = std::min(count, room() / seen.size);
      plan_.jobs.push_back({batch.curves, seen.span, firstSprout, seen.levels});
      ++batch.jobCount;
      batch.curves += trees * seen.size;
      plan_.curves += std::uint64_t(trees) * seen.size;
      plan_.trees += trees;
      firstSprout += trees;
      count -= trees;
    }
  }

 private:
  std::uint32_t room() const { return shared::kRingCurves - plan_.batches.back().curves; }
  CapillaryPlan& plan_;
};

}  // namespace

std::uint32_t levelsOf(const shared::GrowthTables& tables, std::uint32_t system, std::uint32_t wished) {
  const shared::GrowthSymbol& axiom = tables.symbol[tables.system[system].axiom];
  std::uint32_t levels = std::clamp(wished, 1u, shared::kMostGrowthLevels);
  while (levels > 1 && axiom.treeSize[levels] == 0) --levels;
  return levels;
}

std::uint64_t curveCount(const shared::GrowthTables& tables, const CapillarySites& sites,
                         std::uint32_t levels) {
  if (levels == 0) return 0;
  std::uint64_t count = 0;
  for (std::size_t span = 0; span < sites.sites.size(); ++span) {
    const std::uint32_t system = sites.sites[span].system & 0xffu;
    const std::uint32_t trees =
        sites.sites[span].sprouts + tables.system[system].tips * endsIn(sites.freeEnds[span]);
    if (trees > 0)
      count += std::uint64_t(trees) *
               tables.symbol[tables.system[system].axiom].treeSize[levelsOf(tables, system, levels)];
  }
  return count;
}

std::uint32_t mostJobs(const CapillarySites& sites, std::uint32_t budget) {
  // A job a span and a free end; one more where a batch is full, and batches are at least half full or change
  // edges.
  return 3 * std::uint32_t(sites.spans.size()) + 2 * (budget / shared::kRingCurves + 2);
}

void planCapillaries(const PlanInput& input, const CapillaryWish& wish, CapillaryPlan& plan) {
  plan.jobs.clear();
  plan.batches.clear();
  plan.curves = plan.trees = plan.wishedCurves = 0;
  if (wish.levels == 0) return;
  const Planner planner(input, wish);
  std::vector<Seen> seen;
  for (std::uint32_t span = 0; span < input.sites.sites.size(); ++span) {
    Seen one;
    if (input.sites.sites[span].sprouts + input.sites.freeEnds[span] == 0 || !planner.see(span, one))
      continue;
    seen.push_back(one);
    plan.wishedCurves += std::uint64_t(one.trees) * one.size;
  }
  const std::uint64_t curves =
      wish.fewerLevels ? curvesWithin(wish.budget, planner, seen) : plan.wishedCurves;
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.span < b.span;
  });
  const double share = curves > wish.budget ? double(wish.budget) / double(curves) : 1;
  BatchWriter writer(plan);
  for (const Seen& one : seen) {
    const auto granted = [&](std::uint32_t wished) {
      if (share >= 1) return wished;
      const std::uint64_t left = (wish.budget - std::min<std::uint64_t>(plan.curves, wish.budget)) / one.size;
      return std::uint32_t(
          std::min<std::uint64_t>(std::uint64_t(wished * share + unitFloat(scramble(one.span))), left));
    };
    writer.add(one, 0, granted(input.sites.sites[one.span].sprouts));
    for (const std::uint32_t end : {0u, 1u})
      if (input.sites.freeEnds[one.span] >> end & 1u)
        writer.add(one, shared::kTipSprout | (end ? shared::kLastSprout : 0u),
                   granted(planner.tipsOf(one.span)));
  }
}

}  // namespace vasa
