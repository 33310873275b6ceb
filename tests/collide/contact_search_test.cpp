#include "collide/contact_search.h"

#include <doctest/doctest.h>

#include "collide/closest_tubes.h"
#include "collide/tube_detector.h"
#include "support/tube_network.h"

using namespace vasa;

TEST_CASE("crossing tubes: the place, the depth, and a unit normal from j to i") {
  Bezier a, b;
  for (int k = 0; k < 4; ++k) {
    a.b[std::size_t(k)] = vec4(float(k) / 3, 0, 0, 0.1f);
    b.b[std::size_t(k)] = vec4(0.25f, 0.15f, float(k) - 1.5f, 0.1f);
  }
  const Contact contact = nearestPlace(a, b);
  CHECK(contact.s == doctest::Approx(0.25).epsilon(1e-4));
  CHECK(contact.t == doctest::Approx(0.5).epsilon(1e-4));
  CHECK(contact.f == doctest::Approx(-0.05).epsilon(1e-5));
  CHECK(contact.normal.y == doctest::Approx(-1));
  CHECK(nearestPlaceFrom(a, b, 0.9f, 0.1f).f == doctest::Approx(-0.05).epsilon(1e-5));
  CHECK(glm::length(nearestPlace(a, a).normal) == doctest::Approx(1));
}

TEST_CASE("of several places where tubes run near one another the deepest is found") {
  // A straight tube, and one that waves beside it and comes a little nearer at one end than at the other.
  for (const float nearer : {0.004f, 0.001f, -0.001f, -0.004f}) {
    Bezier a, b;
    for (int k = 0; k < 4; ++k) {
      const float x = float(k) / 3;
      a.b[std::size_t(k)] = vec4(x, 0, 0, 0.02f);
      b.b[std::size_t(k)] =
          vec4(x, 0.04f + (k == 1 || k == 2 ? 0.05f : 0) + nearer * x, 0.001f * float(k), 0.02f);
    }
    const Contact contact = nearestPlace(a, b), truth = closestOfTubes(a, b, 1e-9);
    CHECK(contact.f == doctest::Approx(truth.f).scale(1e-3).epsilon(1e-3));
    CHECK(contact.s == doctest::Approx(truth.s).epsilon(0.01));
  }
}

TEST_CASE("contacts of a network are the certified nearest places") {
  const TubeList list = test::makeTubeNetwork(3000, 6);
  const Exclusions exclusions(3000, list.excluded);
  TubeDetector detector(list.poses[0], exclusions);
  for (const auto& pose : list.poses) {
    detector.update(pose);
    const auto pairs = detector.detect();
    const auto contacts = detector.contacts();
    REQUIRE(contacts.size() == pairs.size());
    std::size_t other = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Contact& contact = contacts[k];
      const Bezier &a = pose[pairs[k].i], &b = pose[pairs[k].j];
      CHECK(TubePair{contact.i, contact.j} == pairs[k]);
      CHECK(contact.f < 1e-7f);
      const vec4 p = a.at(contact.s), q = b.at(contact.t);
      CHECK(glm::distance(vec3(p), vec3(q)) - p.w - q.w ==
            doctest::Approx(contact.f).scale(1e-3).epsilon(1e-3));
      other += contact.f > closestOfTubes(a, b, 1e-8).f + 1e-6f;
    }
    CHECK(other == 0);
  }
}
