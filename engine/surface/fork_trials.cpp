#include "surface/fork_trials.h"

#include "core/hash.h"
#include "core/parallel.h"
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

std::uint64_t keyOf(shared::ForkRecord fork, std::span<const shared::ForkBranch> branches) {
  const auto own = branches.subspan(fork.firstBranch, fork.branchCount);
  fork.firstBranch = 0;
  return hashOf(std::span<const shared::ForkRecord>(&fork, 1), hashOf(own));
}

}  // namespace

ForkTrials::ForkTrials(const Network& network) {
  for (const mat3& map : strains()) {
    Shape shape{{network.points().begin(), network.points().end()},
                std::vector<quat>(network.sectionCount())};
    for (vec4& point : shape.points) point = vec4(map * vec3(point), point.w);
    std::vector<vec3> references;
    for (const Vessel& vessel : network.vessels())
      references.push_back(anyPerpendicular(unitTangent(Network::pointsOf(vessel, shape.points), 0)));
    networkFrames(network, shape.points, references, shape.frames);
    shapes_.push_back(std::move(shape));
  }
}

ForkFolds ForkTrials::tried(const SweepTable& table, const shared::ForkRecord& fork) const {
  ForkFolds folds;
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    const PosedNetwork posed{table, shapes_[i].points, shapes_[i].frames};
    const std::uint32_t found = foldedTriangles(posed, fork, kAround, ForkForm::bare);
    (i == 0 ? folds.rest : folds.strained) += found;
    for (const std::uint32_t around : kOtherAround)
      if (i == 0) folds.others += foldedTriangles(posed, fork, around, ForkForm::bare);
    if (folds.rest > 0) break;  // not to be drawn anyway
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
    const auto known = known_.find(keys[i]);
    if (known == known_.end())
      unknown.push_back(i);
    else
      result[i] = known->second;
  }
  SweepTable table;
  table.branches.assign(branches.begin(), branches.end());
  parallelFor(unknown.size(), 8,
              [&](std::size_t k) { result[unknown[k]] = tried(table, forks[unknown[k]]); });
  for (const std::size_t i : unknown) known_[keys[i]] = result[i];
  return result;
}

}  // namespace vasa
