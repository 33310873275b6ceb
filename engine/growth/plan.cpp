#include "growth/plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "growth/capillary.h"
#include "growth/random.h"

namespace vasa {
namespace {

// [pixels] of a bed's own stem: thinner trees are threads; where a body is 720 pixels tall, 0.6
constexpr float kThread = 1.2f;
// In sizes of the smallest curves: threads with a last generation shorter than that have every second of its
// curves. On a body 720 pixels tall that is all of them: a third of the time less, and the mean distance from
// a picture of everything goes from 0.26 to 0.34 of 255.
constexpr float kSparse = 8;
// A stem comes from the bed beside its own: in sizes of the bed, as far as its curves reach.
constexpr float kReach = 1.5f;

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

// A bed's trees as this picture sees them.
struct Seen {
  float distance;  // the farthest come first
  std::uint32_t bed, levels, edges;
  bool sparse;  // of the last generation

  bool isSparse(std::uint32_t drawnLevels) const { return sparse && drawnLevels == levels; }
};

// By the size of a bed in the picture.
std::uint32_t edgesFor(float pixels) { return pixels < 40 ? 3 : pixels < 80 ? 5 : pixels < 200 ? 8 : 10; }

std::uint32_t treesOf(const shared::GrowthBed& bed) {
  return std::uint32_t(bed.stem[0].from != shared::kNoStem) +
         std::uint32_t(bed.stem[1].from != shared::kNoStem);
}

// The side of a cube as large as the bed.
float sizeOf(const shared::GrowthBed& bed) {
  return 2 * std::cbrt(bed.side[0].w * bed.side[1].w * bed.side[2].w);
}

class Planner {
 public:
  Planner(const PlanInput& input, const CapillaryWish& wish)
      : in_(input), wish_(wish), planes_(planesOf(input.view.viewProjection)) {}

  bool see(std::uint32_t number, Seen& seen) const {
    const shared::GrowthBed& bed = in_.beds.beds[number];
    const vec3 centre = bedCentre(in_.network, in_.beds.spans, bed);
    const float size = sizeOf(bed), radius = kReach * size + 2 * bed.side[0].w;
    for (const Plane& plane : planes_)
      if (glm::dot(plane.normal, centre) + plane.offset < -radius) return false;
    const float depth = glm::dot(vec3(in_.view.depth), centre) + in_.view.depth.w;
    const float pixels = in_.view.focal / std::max(depth - radius * in_.view.perspective, 0.01f);
    std::uint32_t levels = levelsOf(in_.tables, bed.system, wish_.levels);
    const auto length = [&] { return pixels * size * shrunk(bed.system, levels); };
    while (levels > 0 && length() < wish_.smallest) --levels;
    if (levels == 0) return false;
    const float distance = in_.view.perspective > 0 ? depth : -glm::dot(in_.view.eye, centre);
    const float here = in_.view.focal / std::max(depth, 0.01f);
    const std::uint32_t edges = edgesAt(size * here, std::max(bed.stem[0].own, bed.stem[1].own) * 2 * here);
    seen = {distance, number, levels, edges,
            edges == shared::kThreads && levels > 1 && length() < kSparse * wish_.smallest};
    return true;
  }

  std::uint32_t treeSize(const Seen& seen, std::uint32_t levels) const {
    return vasa::treeSize(in_.tables.symbol[in_.tables.system[in_.beds.beds[seen.bed].system].axiom], levels,
                          seen.isSparse(levels));
  }
  std::uint64_t curvesOf(const Seen& seen, std::uint32_t most) const {
    return std::uint64_t(treesOf(in_.beds.beds[seen.bed])) * treeSize(seen, std::min(seen.levels, most));
  }

 private:
  // Length of the last generation in sizes of the bed: that of a cube which as many as there are fill.
  float shrunk(std::uint32_t system, std::uint32_t levels) const {
    const auto& size = in_.tables.symbol[in_.tables.system[system].axiom].treeSize;
    return 1 / std::cbrt(float(size[levels] - (levels > 1 ? size[levels - 1] : 0)));
  }
  std::uint32_t edgesAt(float size, float thickness) const {
    if (wish_.edges) return wish_.edges;
    const std::uint32_t edges = edgesFor(size);
    return wish_.smallest > 0 && thickness < kThread && edges == 3 ? shared::kThreads : edges;
  }

  const PlanInput& in_;
  const CapillaryWish& wish_;
  std::array<Plane, 5> planes_;
};

// Most generations that keep all trees to the budget, and the share of them that may have one more: the
// deepest generation that all cannot have goes to beds by chance.
struct Ration {
  std::uint32_t whole = shared::kMostGrowthLevels;
  double share = 0;

  std::uint32_t levelsOf(const Seen& seen) const {
    const bool more = unitFloat(scramble(seen.bed)) < share;
    return std::min(seen.levels, whole + (more ? 1u : 0u));
  }
};

Ration rationOf(std::uint32_t budget, const Planner& planner, std::span<const Seen> seen) {
  std::uint64_t above = 0;
  for (std::uint32_t most = shared::kMostGrowthLevels;; --most) {
    std::uint64_t curves = 0;
    if (most > 0)
      for (const Seen& one : seen) curves += planner.curvesOf(one, most);
    if (curves <= budget)
      return {most, above > curves ? double(budget - curves) / double(above - curves) : 0.0};
    above = curves;
  }
}

// Fills batches with whole trees.
class BatchWriter {
 public:
  explicit BatchWriter(CapillaryPlan& plan) : plan_(plan) {}

  void add(const Seen& seen, std::uint32_t side, std::uint32_t levels, std::uint32_t size) {
    if (plan_.batches.empty() || plan_.batches.back().edges != seen.edges ||
        shared::kRingCurves - plan_.batches.back().curves < size)
      plan_.batches.push_back({std::uint32_t(plan_.jobs.size()), 0, 0, seen.edges});
    CapillaryBatch& batch = plan_.batches.back();
    plan_.jobs.push_back({batch.curves, seen.bed, side, levels, std::uint32_t(seen.isSparse(levels))});
    ++batch.jobCount;
    batch.curves += size;
    plan_.curves += size;
    ++plan_.trees;
  }

 private:
  CapillaryPlan& plan_;
};

}  // namespace

std::uint32_t levelsOf(const shared::GrowthTables& tables, std::uint32_t system, std::uint32_t wished) {
  const shared::GrowthSymbol& axiom = tables.symbol[tables.system[system].axiom];
  std::uint32_t levels = std::clamp(wished, 1u, shared::kMostGrowthLevels);
  while (levels > 1 && axiom.treeSize[levels] == 0) --levels;
  return levels;
}

std::uint64_t curveCount(const shared::GrowthTables& tables, const CapillaryBeds& beds,
                         std::uint32_t levels) {
  if (levels == 0) return 0;
  std::uint64_t count = 0;
  for (const shared::GrowthBed& bed : beds.beds)
    count += std::uint64_t(treesOf(bed)) *
             tables.symbol[tables.system[bed.system].axiom].treeSize[levelsOf(tables, bed.system, levels)];
  return count;
}

std::uint32_t mostJobs(const CapillaryBeds& beds) { return 2 * std::uint32_t(beds.beds.size()); }

void planCapillaries(const PlanInput& input, const CapillaryWish& wish, CapillaryPlan& plan) {
  plan.jobs.clear();
  plan.batches.clear();
  plan.curves = plan.trees = plan.wishedCurves = 0;
  if (wish.levels == 0) return;
  const Planner planner(input, wish);
  std::vector<Seen> seen;
  for (std::uint32_t bed = 0; bed < input.beds.beds.size(); ++bed) {
    Seen one;
    if (!planner.see(bed, one)) continue;
    seen.push_back(one);
    plan.wishedCurves += planner.curvesOf(one, one.levels);
  }
  const Ration ration = rationOf(wish.budget, planner, seen);
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.bed < b.bed;
  });
  BatchWriter writer(plan);
  for (const Seen& one : seen) {
    const std::uint32_t levels = ration.levelsOf(one);
    if (levels == 0) continue;
    const std::uint32_t size = planner.treeSize(one, levels);
    for (const std::uint32_t side : {0u, 1u})
      if (input.beds.beds[one.bed].stem[side].from != shared::kNoStem && plan.curves + size <= wish.budget)
        writer.add(one, side, levels, size);
  }
}

}  // namespace vasa
