#include "surface/fork_smooth.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/networks.h"
#include "surface/fork_check.h"
#include "surface/fork_template.h"

using namespace vasa;

namespace {

// A network whose points follow waves of 3 cm through space.
class Waves {
 public:
  explicit Waves(const Network& network)
      : table(makeSweepTable(network)), network_(network), frames_(network.sectionCount()) {}

  /// @param height  of the waves [m]
  PosedNetwork at(float height) {
    points_.assign(network_.points().begin(), network_.points().end());
    for (vec4& p : points_)
      p += height * vec4(std::sin(200 * p.y), std::sin(200 * p.z), std::sin(200 * p.x), 0);
    pinEnds(network_, points_);
    networkFrames(network_, points_, restReferences(network_), frames_);
    return {table, points_, frames_};
  }

  const SweepTable table;

 private:
  const Network& network_;
  std::vector<vec4> points_;
  std::vector<quat> frames_;
};

struct Shown {
  std::vector<SurfacePoint> points;
  bool stump = false;
};

constexpr ForkSteps kUnsmoothed;

Shown show(const PosedNetwork& posed, const shared::ForkRecord& fork, const ForkSteps* fixed) {
  const ForkShape shape = forkShape(posed.table, fork, [](std::uint32_t) { return 8u; });
  Shown shown{std::vector<SurfacePoint>(shape.vertices())};
  const ForkLayout layout = evaluateFork(posed, fork, shape, shown.points, fixed);
  shown.stump = isStump(layout);
  return shown;
}

bool alike(const std::vector<SurfacePoint>& a, const std::vector<SurfacePoint>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].position != b[i].position || a[i].normal != b[i].normal) return false;
  return true;
}

float farthest(const std::vector<SurfacePoint>& a, const std::vector<SurfacePoint>& b) {
  float way = 0;
  for (std::size_t i = 0; i < a.size(); ++i) way = std::max(way, glm::distance(a[i].position, b[i].position));
  return way;
}

}  // namespace

TEST_CASE("smoothing leaves forks that do not fold as they are, to the bit, and unfolds nearly all others") {
  const Network network = test::branchingNetwork(61, 4);
  Waves waves(network);
  std::uint32_t folded = 0, stumps = 0;
  for (const float height : {0.0f, 0.002f, 0.004f, 0.006f}) {
    const PosedNetwork posed = waves.at(height);
    for (const shared::ForkRecord& fork : waves.table.forks) {
      const bool folds = foldedUnsmoothed(posed, fork, 8) > 0;
      const Shown fitting = show(posed, fork, nullptr);
      if (!folds) CHECK(alike(fitting.points, show(posed, fork, &kUnsmoothed).points));
      CHECK(foldedTriangles(posed, fork, 8, nullptr) == 0);
      folded += folds;
      stumps += fitting.stump;
    }
  }
  MESSAGE(folded << " fold, " << stumps << " are stumps");
  CHECK(folded >= 10);
  CHECK(5 * stumps <= folded);
}

TEST_CASE("what another cut through its quads unfolds is not smoothed, and has as many triangles") {
  std::uint32_t turned = 0, kept = 0, cut = 0;  // steps of what can be unfolded
  for (const std::uint32_t seed : {3u, 4u, 5u}) {
    const Network network = test::branchingNetwork(61, seed);
    Waves waves(network);
    const PosedNetwork posed = waves.at(0.006f);
    for (const shared::ForkRecord& fork : waves.table.forks) {
      const ForkShape shape = forkShape(waves.table, fork, [](std::uint32_t) { return 8u; });
      std::vector<SurfacePoint> points(shape.vertices());
      const ForkSteps before = evaluateFork(posed, fork, shape, points, nullptr, false).steps;
      const ForkLayout layout = evaluateFork(posed, fork, shape, points);
      if (!isStump(layout)) {
        kept += before.most();
        turned += layout.steps.most();
      }
      const std::vector<uvec3> always = forkTriangles(shape, layout, {}),
                               now = forkTriangles(shape, layout, points);
      CHECK(now.size() == always.size());
      cut += now != always;
    }
  }
  MESSAGE(turned << " steps for " << kept << ", " << cut << " forks with a quad cut otherwise");
  CHECK(2 * turned < kept);
  CHECK(cut > 15);
}

TEST_CASE("a fork that begins to fold hardly jumps") {
  constexpr int kSteps = 240;
  std::vector<float> jumps;  // [radii of the trunk]
  for (const std::uint32_t seed : {3u, 4u, 5u}) {
    const Network network = test::branchingNetwork(61, seed);
    Waves waves(network);
    std::vector<Shown> before(waves.table.forks.size());
    std::vector<bool> folded(before.size());
    for (int step = 0; step <= kSteps; ++step) {
      const PosedNetwork posed = waves.at(0.006f * float(step) / kSteps);
      for (std::size_t i = 0; i < before.size(); ++i) {
        const shared::ForkRecord& fork = waves.table.forks[i];
        const bool folds = foldedUnsmoothed(posed, fork, 8) > 0;
        Shown now = show(posed, fork, nullptr);
        if (step > 0 && folds && !folded[i] && !now.stump && !before[i].stump)
          jumps.push_back(farthest(before[i].points, now.points) / posed.points[fork.a.point].w);
        folded[i] = folds;
        before[i] = std::move(now);
      }
    }
  }
  std::ranges::sort(jumps);
  REQUIRE(jumps.size() >= 30);
  MESSAGE(jumps.size() << " begin to fold; then one moves by " << jumps[jumps.size() / 2]
                       << " radii in the median, " << jumps[jumps.size() * 9 / 10]
                       << " of ten the most but one, " << jumps.back() << " at most");
  CHECK(jumps[jumps.size() / 2] < 0.3f);
  CHECK(jumps[jumps.size() * 9 / 10] < 0.5f);
  CHECK(jumps.back() < 1.25f);
}
