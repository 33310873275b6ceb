#include "collide/paper_detector.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "brute_force.h"
#include "collide/closest_tubes.h"
#include "support/tube_network.h"

using namespace vasa;

TEST_CASE("the paper's method misses nothing, and reports less the smaller its tolerance") {
  const TubeList list = test::makeTubeNetwork(800, 2);
  const Exclusions exclusions(800, list.excluded);
  std::size_t before = 800 * 800;
  for (const float tolerance : {1e-3f, 1e-4f, 1e-6f}) {
    PaperDetector detector(list.poses[0], exclusions, tolerance);
    for (const auto& pose : list.poses) {
      const auto truth = test::intersectingPairsByBruteForce(pose, exclusions, 1e-9);
      detector.update(pose);
      const auto found = detector.detect();
      CHECK(std::is_sorted(found.begin(), found.end()));
      CHECK(std::includes(found.begin(), found.end(), truth.begin(), truth.end()));
      CHECK(found.size() >= truth.size());
      if (tolerance == 1e-6f) CHECK(found.size() <= truth.size() + 2);
    }
    CHECK(detector.detect().size() <= before);
    before = detector.detect().size();
  }
}

TEST_CASE("none and one") {
  const Exclusions nothing(0);
  PaperDetector none({}, nothing);
  none.update({});
  CHECK(none.detect().empty());
  const TubeList list = test::makeTubeNetwork(1, 1);
  const Exclusions exclusions(1);
  PaperDetector one(list.poses[0], exclusions);
  one.update(list.poses[1]);
  CHECK(one.detect().empty());
}
