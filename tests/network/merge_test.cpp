#include "network/merge.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "network/sample_network.h"

using namespace vasa;

TEST_CASE("two networks stand side by side in one, each as it was") {
  const auto one = test::sampleBuilder().build(1.75f);
  REQUIRE(one.ok());
  const std::vector<Network> both{*one, *one};
  const auto merged = mergeNetworks(both);
  REQUIRE(merged.ok());
  CHECK(merged->vessels().size() == 10);
  CHECK(merged->componentCount() == 4);
  CHECK(merged->junctionCount() == 4);
  CHECK(std::ranges::equal(merged->points().subspan(one->points().size()), one->points()));
  CHECK(merged->node({2}).host->vessel.value == 5);
}

TEST_CASE("nothing to merge is refused") { CHECK(!mergeNetworks({}).ok()); }
