#include "surface/fork_trials.h"

#include <algorithm>
#include <utility>

#include "core/hash.h"
#include "core/parallel.h"
#include "curve/frame.h"
#include "surface/fork_check.h"

namespace vasa {
namespace {

constexpr std::uint32_t kAround = 8;
constexpr std::uint32_t kOtherAround[] = {4, 6, 12, 16};
constexpr float kSqueezed = 0.9f, kSheared = 0.15f;

std::vector<mat3> strains() {
  std::vector<mat3> maps{mat3(1)};
  for (int axis = 0; axis < 3; ++axis) {
    maps.emplace_back(1);
    maps.back()[axis][axis] = kSqueezed;
    for (const float shear : {-kSheared, kSheared}) {
      maps.emplace_back(1);
      maps.back()[axis][(axis + 1) % 3] = shear;
    }
  }
  return maps;
}

}  // namespace

ForkTrials::ForkTrials(const Network& network, ForkMemory& memory)
    : network_(network), memory_(memory), strained_(network.vessels().size(), false) {
  for (const Vessel& vessel : network.vessels()) keys_.push_back(hashOf(network.pointsOf(vessel)));
  shapes_.resize(strains().size());
  for (Shape& shape : shapes_) {
    shape.points.resize(network.points().size());
    shape.frames.resize(network.sectionCount());
  }
}

// Numbers as they would be if its vessel were the only one.
shared::ForkRing ForkTrials::within(shared::ForkRing ring, std::uint32_t vessel) const {
  ring.knot -= firstKnot(network_, {vessel});
  ring.point -= ring.firstPoint;
  ring.lastPoint -= ring.firstPoint;
  ring.firstPoint = 0;
  return ring;
}

std::uint64_t ForkTrials::keyOf(shared::ForkRecord fork, std::span<const shared::ForkBranch> branches) const {
  std::uint64_t key = hashOf(std::span(&keys_[fork.vesselA], 1), keys_[fork.vesselB]);
  for (shared::ForkBranch branch : branches.subspan(fork.firstBranch, fork.branchCount)) {
    const std::uint32_t crossing = vesselOfPoint(branch.crossPoint);
    key = hashOf(std::span(&keys_[branch.vessel], 1), key);
    key = hashOf(std::span(&keys_[crossing], 1), key);
    branch.crossPoint -= network_.vessels()[crossing].firstPoint;
    branch.ring = within(branch.ring, branch.vessel);
    branch.vessel = 0;
    key = hashOf(std::span<const shared::ForkBranch>(&branch, 1), key);
  }
  fork.a = within(fork.a, fork.vesselA);
  fork.b = within(fork.b, fork.vesselB);
  fork.vesselA = fork.vesselB = fork.firstBranch = 0;
  return hashOf(std::span<const shared::ForkRecord>(&fork, 1), key);
}

// A branch may pierce the wall as one vessel and leave the fork as the next of its line.
std::uint32_t ForkTrials::vesselOfPoint(std::uint32_t point) const {
  const auto after = std::ranges::upper_bound(network_.vessels(), point, {}, &Vessel::firstPoint);
  return std::uint32_t(after - network_.vessels().begin()) - 1;
}

void ForkTrials::strain(std::uint32_t index) {
  if (std::exchange(strained_[index], true)) return;
  static const std::vector<mat3> maps = strains();
  const Vessel& vessel = network_.vessels()[index];
  for (std::size_t i = 0; i < maps.size(); ++i) {
    Shape& shape = shapes_[i];
    for (std::uint32_t p = vessel.firstPoint; p < vessel.firstPoint + vessel.pointCount; ++p)
      shape.points[p] = vec4(maps[i] * vec3(network_.points()[p]), network_.points()[p].w);
    const auto points = Network::pointsOf(vessel, shape.points);
    knotFrames(points, anyPerpendicular(unitTangent(points, 0)),
               std::span(shape.frames).subspan(firstKnot(network_, {index}), vessel.spanCount() + 1));
  }
}

ForkFolds ForkTrials::tried(const SweepTable& table, const shared::ForkRecord& fork) const {
  ForkFolds folds;
  for (std::size_t i = 0; i < shapes_.size() && !folds.stump; ++i) {
    const PosedNetwork posed{table, shapes_[i].points, shapes_[i].frames};
    const std::uint32_t found = foldedUnsmoothed(posed, fork, kAround);
    (i == 0 ? folds.rest : folds.strained) += found;
    if (found > 0) {
      const ForkLayout layout = settledFork(posed, fork, kAround);
      folds.stump = isStump(layout);
      if (i == 0) folds.steps = layout.steps.most();
    }
    if (i > 0) continue;
    for (const std::uint32_t around : kOtherAround)
      if (const std::uint32_t others = foldedUnsmoothed(posed, fork, around); others > 0)
        folds.others += others, folds.otherStumps += isStump(posed, fork, around);
  }
  return folds;
}

std::vector<ForkFolds> ForkTrials::foldsOf(std::span<const shared::ForkRecord> forks,
                                           std::span<const shared::ForkBranch> branches) {
  std::vector<ForkFolds> result(forks.size());
  std::vector<std::uint64_t> keys;
  std::vector<std::size_t> unknown;
  for (std::size_t i = 0; i < forks.size(); ++i) {
    keys.push_back(keyOf(forks[i], branches));
    const auto known = memory_.folds.find(keys[i]);
    if (known != memory_.folds.end()) {
      result[i] = known->second;
      continue;
    }
    unknown.push_back(i);
    strain(forks[i].vesselA), strain(forks[i].vesselB);
    for (const auto& branch : branches.subspan(forks[i].firstBranch, forks[i].branchCount))
      strain(branch.vessel), strain(vesselOfPoint(branch.crossPoint));
  }
  SweepTable table;
  table.branches.assign(branches.begin(), branches.end());
  parallelFor(unknown.size(), 8,
              [&](std::size_t k) { result[unknown[k]] = tried(table, forks[unknown[k]]); });
  for (const std::size_t i : unknown) memory_.folds[keys[i]] = result[i];
  return result;
}

}  // namespace vasa
