#include "collide/contact_search.h"

#include <doctest/doctest.h>

#include <array>

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

TEST_CASE("of two places where tubes come near one another the deeper is found, whatever their chords say") {
  // c0 + c1 t + c2 t² + c3 t³
  const auto cubic = [](vec3 c0, vec3 c1, vec3 c2, vec3 c3) {
    Bezier tube;
    const std::array<vec3, 4> b{c0, c0 + c1 / 3.0f, c0 + (2.0f * c1 + c2) / 3.0f, c0 + c1 + c2 + c3};
    for (std::size_t k = 0; k < 4; ++k) tube.b[k] = vec4(b[k], 0.02f);
    return tube;
  };
  const Bezier a = cubic(vec3(0), {1, 0, 0}, vec3(0), vec3(0));
  // The other runs beside it at a height y, and crosses over it at t = 0.3 and 0.8. There y is equal but for
  // what is added; but it bends up at the first, so that a chord lies above it, and down at the second.
  const float size = 0.1f, third = -2 / 3.0f * size;
  const vec3 cross{0, 0, 0.4f};
  for (const float more : {-0.008f, 0.003f, 0.006f}) {
    const float slope = size * (0.0417f + more);
    const Bezier b = cubic(0.24f * cross + vec3(0, 0.04f - third * 0.166375f - 0.3f * slope, 0),
                           -1.1f * cross + vec3(1, third * 0.9075f + slope, 0),
                           cross - vec3(0, third * 1.65f, 0), {0, third, 0});
    const Contact contact = nearestPlace(a, b), truth = closestOfTubes(a, b, 1e-9);
    CHECK(contact.s == doctest::Approx(truth.s).epsilon(0.01));
    CHECK(contact.f == doctest::Approx(truth.f).scale(0.04).epsilon(1e-5));
    CHECK(contact.s == doctest::Approx(more > 0 ? 0.3 : 0.8).epsilon(0.05));
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
