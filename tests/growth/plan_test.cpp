#include "growth/plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "core/hash.h"
#include "growth/capillary.h"
#include "support/growth.h"
#include "support/networks.h"

using namespace vasa;

namespace {

// Looks along -z on a square of the world, 1000 pixels wide.
shared::GrowthView viewOf(float width, vec3 middle) {
  shared::GrowthView view{};
  view.viewProjection = glm::translate(glm::scale(mat4(1), vec3(2 / width, 2 / width, 0.01f)), -middle);
  view.eye = {0, 0, 1};
  view.depth = {0, 0, 0, 1};
  view.right = {1, 0, 0};
  view.up = {0, 1, 0};
  view.focal = 1000 / width;
  view.seed = 1;
  return view;
}

CapillaryPlan planOf(const test::GrownNetwork& grown, const shared::GrowthView& view,
                     const CapillaryWish& wish) {
  CapillaryPlan plan;
  planCapillaries({grown.posed(), grown.rules.tables, grown.beds, view}, wish, plan);
  return plan;
}

vec3 middleOf(const test::GrownNetwork& grown) {
  const PosedNetwork posed = grown.posed();
  return bedCentre(posed, grown.beds.spans, grown.beds.beds[grown.beds.beds.size() / 2]);
}

const CapillaryWish kAll{.levels = 3, .edges = 5, .budget = 4'000'000, .smallest = 0};

}  // namespace

TEST_CASE("a plan has every tree once, whole, in batches that fit the ring") {
  const test::GrownNetwork grown(test::windingNetwork(200, 2));
  const CapillaryPlan plan = planOf(grown, viewOf(10, vec3(0.5f)), kAll);
  CHECK(plan.curves == curveCount(grown.rules.tables, grown.beds, 3));
  CHECK(plan.curves == plan.wishedCurves);
  REQUIRE(plan.batches.size() > 1);
  std::set<std::pair<std::uint32_t, std::uint32_t>> trees;
  std::uint64_t sum = 0;
  for (const CapillaryBatch& batch : plan.batches) {
    CHECK(batch.curves <= shared::kRingCurves);
    CHECK(batch.edges == 5);
    sum += batch.curves;
    for (std::uint32_t j = 0; j < batch.jobCount; ++j) {
      const shared::GrowthJob& job = plan.jobs[batch.firstJob + j];
      const std::uint32_t end =
          j + 1 < batch.jobCount ? plan.jobs[batch.firstJob + j + 1].firstCurve : batch.curves;
      CHECK(end - job.firstCurve ==
            grown.rules.treeSize(grown.beds.beds[job.bed].system, job.levels, job.sparse));
      CHECK(trees.insert({job.bed, job.side}).second);
    }
  }
  CHECK(sum == plan.curves);
  CHECK(trees.size() == plan.trees);
  CHECK(plan.jobs.size() <= mostJobs(grown.beds));
}

TEST_CASE("what is out of the picture is left out, and what is far off has fewer generations") {
  const test::GrownNetwork grown(test::windingNetwork(60, 2));
  CHECK(planOf(grown, viewOf(1, vec3(50)), kAll).curves == 0);
  const auto part = planOf(grown, viewOf(0.2f, vec3(0.5f)), kAll);
  CHECK(part.curves > 0);
  CHECK(part.curves < planOf(grown, viewOf(10, vec3(0.5f)), kAll).curves);
  CapillaryWish fine = kAll;
  fine.smallest = 1;
  const auto near = planOf(grown, viewOf(3, vec3(0.5f)), fine),
             far = planOf(grown, viewOf(300, vec3(0.5f)), fine),
             farthest = planOf(grown, viewOf(3e5f, vec3(0.5f)), fine);
  CHECK(far.curves < near.curves);
  CHECK(farthest.curves == 0);
  CHECK(planOf(grown, viewOf(10, vec3(0.5f)), {}).batches.empty());
}

TEST_CASE("the budget holds, and takes from all vessels alike") {
  const test::GrownNetwork grown(test::windingNetwork(100, 6));
  const auto view = viewOf(10, vec3(0.5f));
  const auto all = planOf(grown, view, kAll);
  for (const std::uint32_t budget :
       {1u, 500u, std::uint32_t(all.curves / 3), std::uint32_t(all.curves - 1)}) {
    CapillaryWish wish = kAll;
    wish.budget = budget;
    const auto plan = planOf(grown, view, wish);
    CAPTURE(budget);
    CHECK(plan.curves <= budget);
    CHECK(plan.wishedCurves == all.curves);
    if (budget > 10'000) CHECK(plan.curves > budget * 0.9);
    CHECK(plan.jobs.size() <= mostJobs(grown.beds));
  }
}

TEST_CASE("polylines have as many edges as was said, or more where they are larger") {
  const test::GrownNetwork grown(test::windingNetwork(20, 6));
  CapillaryWish wish = kAll;
  for (const std::uint32_t edges : {3u, 5u, 8u, 10u}) {
    wish.edges = edges;
    for (const auto& batch : planOf(grown, viewOf(10, vec3(0.5f)), wish).batches) CHECK(batch.edges == edges);
  }
  wish.edges = 0;
  CHECK(planOf(grown, viewOf(0.05f, middleOf(grown)), wish).batches.front().edges == 10);
  CHECK(planOf(grown, viewOf(500, vec3(0.5f)), wish).batches.front().edges == 3);
}

TEST_CASE("trees thinner than a pixel are threads, unless all is to be drawn or edges are said") {
  const test::GrownNetwork grown(test::windingNetwork(20, 6));
  CapillaryWish wish{.levels = 3};
  const auto edgesAt = [&](float width) {
    return planOf(grown, viewOf(width, middleOf(grown)), wish).batches.at(0).edges;
  };
  CHECK(edgesAt(0.05f) == 10);
  CHECK(edgesAt(20) == shared::kThreads);
  wish.edges = 3;
  CHECK(edgesAt(20) == 3);
  wish.edges = 0;
  wish.smallest = 0;
  CHECK(edgesAt(20) == 3);
}

TEST_CASE("of threads whose last generation is short every second curve is drawn") {
  const test::GrownNetwork grown(test::windingNetwork(20, 6));
  const auto sparseAt = [&](float width, float smallest) {
    const auto plan = planOf(grown, viewOf(width, middleOf(grown)), {.levels = 3, .smallest = smallest});
    return std::ranges::count_if(plan.jobs, [](const shared::GrowthJob& job) { return job.sparse != 0; });
  };
  CHECK(sparseAt(20, 0.5f) > 0);
  CHECK(sparseAt(0.05f, 0.5f) == 0);
  CHECK(sparseAt(20, 0) == 0);
}

TEST_CASE("beyond the budget the deepest generations go first, so that every bed keeps its stems") {
  const test::GrownNetwork grown(test::windingNetwork(100, 6));
  const auto view = viewOf(10, vec3(0.5f));
  const auto all = planOf(grown, view, kAll);
  CapillaryWish wish = kAll;
  for (const std::uint32_t levels : {3u, 2u, 1u}) {
    wish.budget = std::uint32_t(curveCount(grown.rules.tables, grown.beds, levels));
    const auto plan = planOf(grown, view, wish);
    CHECK(plan.curves == wish.budget);
    CHECK(plan.trees == all.trees);
    CHECK(plan.wishedCurves == all.curves);
  }
  wish.budget /= 2;
  CHECK(planOf(grown, view, wish).curves <= wish.budget);
  CHECK(planOf(grown, view, wish).curves > wish.budget * 0.8);
}

TEST_CASE("the farthest trees come first, and the plan is the same again") {
  const test::GrownNetwork grown(test::windingNetwork(80, 8));
  const auto view = viewOf(10, vec3(0.5f));
  const auto plan = planOf(grown, view, kAll), again = planOf(grown, view, kAll);
  CHECK(hashOf(std::span<const shared::GrowthJob>(plan.jobs)) ==
        hashOf(std::span<const shared::GrowthJob>(again.jobs)));
  const PosedNetwork posed = grown.posed();
  const auto heightOf = [&](const shared::GrowthJob& job) {
    return bedCentre(posed, grown.beds.spans, grown.beds.beds[job.bed]).z;
  };
  for (std::size_t i = 1; i < plan.jobs.size(); ++i)
    CHECK(heightOf(plan.jobs[i]) >= heightOf(plan.jobs[i - 1]) - 1e-6f);
}
