#include "network/measure.h"

#include <doctest/doctest.h>

#include "network/sample_network.h"

using namespace vasa;

TEST_CASE("lengths and volumes of the sample tree") {
  const auto network = test::sampleBuilder().build(1.75f);
  REQUIRE(network.ok());
  const NetworkMeasures sum = measure(*network, network->points());
  CHECK(sum.arteries == 4);
  CHECK(sum.veins == 1);
  const double side = std::hypot(0.3, 0.1), arm = std::hypot(0.2, 0.3);
  CHECK(sum.length == doctest::Approx(2 + side + 2 * arm).epsilon(1e-5));
  const double volume = kPi * (2 * 1e-4 + side * 1.6e-5 + 2 * arm * 4.9e-5);
  CHECK(sum.volume == doctest::Approx(volume).epsilon(1e-5));
  CHECK(sum.bounds.high.y == doctest::Approx(1.307));
}
