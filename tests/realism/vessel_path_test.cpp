#include "realism/vessel_path.h"

#include "realism/lines.h"

using namespace vasa;

TEST_CASE("a path runs from where one branch leaves to where another does, over vessels joined end to end") {
  const Network network = test::landmarkNetwork();
  const PathFinder finder(network);
  const auto path = finder.find("left high", "left last");
  REQUIRE_MESSAGE(path.ok(), path.error().message);
  CHECK(path->stations.back().rest == doctest::Approx(0.25f).epsilon(1e-3));
  CHECK(path->stations.size() == 251);
  CHECK(path->stations.front().vessel == VesselId{0});
  CHECK(path->stations.front().parameter == doctest::Approx(5).epsilon(1e-3));
  CHECK(path->stations.back().vessel == VesselId{1});
  CHECK(path->stations.back().parameter == doctest::Approx(10).epsilon(1e-3));
  for (std::size_t i = 1; i < path->stations.size(); ++i)
    CHECK(path->stations[i].rest > path->stations[i - 1].rest);
}

TEST_CASE("a part of a path, places by share, other names for the same, and either direction") {
  const Network network = test::landmarkNetwork();
  const PathFinder finder(network);
  const auto third = finder.find("no such artery | LEFT HIGH", "left low", 0.5f, 1);
  REQUIRE(third.ok());
  CHECK(third->stations.back().rest == doctest::Approx(0.05f).epsilon(1e-3));
  CHECK(third->stations.front().parameter == doctest::Approx(10).epsilon(1e-3));
  const auto back = finder.find("left low", "left trunk@0.25");
  REQUIRE(back.ok());
  CHECK(back->stations.back().rest == doctest::Approx(0.1f).epsilon(1e-3));
  CHECK(back->stations.front().parameter == doctest::Approx(15).epsilon(1e-3));
  CHECK(back->stations.back().parameter == doctest::Approx(5).epsilon(1e-3));
}

TEST_CASE("what cannot be found is named") {
  const Network network = test::landmarkNetwork();
  const PathFinder finder(network);
  CHECK(finder.find("left hihg", "left low").error().message == "no vessel is called 'left hihg'");
  CHECK(finder.find("left trunk@two", "left low").error().message.find("'left trunk@two'") == 0);
  CHECK_FALSE(finder.find("left low", "left low").ok());
}
