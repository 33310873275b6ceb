#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <string>

#include "network/fork_patch.h"
#include "shared/fork.h"
#include "shared/growth.h"
#include "shared/patch.h"
#include "shared/tubes.h"

// lavapipe stops all loops of an invocation silently when they have gone round 65,535 times together. So the
// most that an invocation of each compute pass may do is added up here from the constants that bound its
// loops, and has to stay below half of that. tests/gpu shows that the limit is there.

using namespace vasa;

namespace {

constexpr unsigned kBudget = 30'000;

std::map<std::string, unsigned> mostLoops() {
  using namespace shared;
  constexpr unsigned m = kMaxAround, rings = kMaxStrips + 1, chord = 5;
  constexpr unsigned forkRows = kTrunkRows + 1 + kCollarRows;
  constexpr unsigned forkTries = kMostSmoothings + 3;
  // a quad of a tube or a fork, a triangle of a patch: up to four samples of each
  constexpr unsigned samples = 4 + 1, seenQuad = 2 * (1 + samples), seenTriangle = 1 + samples;
  return {
      {"measure.comp", chord + kMaxAlong},
      {"around.comp", m},
      // rings looked at and written, quads seen, vertices, triangles, blocks of vertices, sums over the group
      {"tubes.comp", 2 * rings + kMaxStrips * m * (1 + seenQuad) + rings * m + kMaxStrips * 2 * m +
                         rings * m / kBlockVertices + kGroupSweeps},
      // a ring search, m vertices and their directions a row, quads found and vertices smoothed, vertices
      // packed, quads seen, corners of quads and of their triangles looked at and written, sums over the
      // group, vertices written
      {"forks.comp", 4 * kMostForkVertices + forkTries * (kMostForkPieces + 2 * kMostForkVertices) +
                         kMostForkVertices + kMostForkPieces * (1 + seenQuad) +
                         kMostForkPieces * (1 + 4 + 1 + 6) + forkRows * 4 * m + 5 * m + kGroupForks +
                         2 * kMostForkVertices / 32 + kMostForkVertices},
      {"capillary.comp", 32 + kMostGrowthLevels * (1 + kMostGrowthChildren) + 3 * (kMostCapillaryEdges + 1)},
      {"patch_triangles.comp", kThreadTriangles * (2 + seenTriangle) + kPatchThreads},
      // patches, their pairs of rings
      {"patch_strain.comp", 65536 / 3 / kStrainThreads * (1 + 4 + 6)},
      // what is pressed and free, steps and normals; vertices, their triangles
      {"patch_smooth.comp", (kPatchSteps + 3) * (1 + kMostSmoothed / kSmoothThreads * (1 + kMostFan))},
      // directions, the ring's vertices, where it begins, the strip's triangles and those without area
      {"patches.comp", 3 * m + kMostOnLoop + 2 * m},
      {"skin.comp", 0},
      {"template_plan.comp", 2 * (kWindow / kPlanThreads + 1)},
      {"access_read.comp", 0},
      {"access_write.comp", 0},
  };
}

}  // namespace

TEST_CASE("no invocation of any compute pass comes near the device's budget of loops") {
  for (const auto& most : mostLoops()) {
    CAPTURE(most.first);
    CHECK(most.second < kBudget);
  }
}

TEST_CASE("every compute shader has been counted") {
  std::size_t shaders = 0;
  for (const auto& entry : std::filesystem::directory_iterator("shaders")) {
    if (entry.path().extension() != ".comp") continue;
    ++shaders;
    CHECK_MESSAGE(mostLoops().contains(entry.path().filename().string()), entry.path().string());
  }
  CHECK(shaders == mostLoops().size());
}
