#include "convert/duplicates.h"

#include <doctest/doctest.h>

#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("of elements that repeat one another the largest is kept") {
  const vec3 a(0), b(0, 0.1f, 0), shift(2e-4f, 0, 0);
  const std::vector<SourceElement> elements{
      source("whole", tubeBetween(a, b, 0.003f)),
      source("again, coarser and moved a little",
             tubeBetween(a + shift, b + shift, 0.003f, TubeEnds::open, 7)),
      source("its lower half", tubeBetween(a, 0.5f * b, 0.003f, TubeEnds::open)),
      source("a vein at the same place", tubeBetween(a, b, 0.003f), VesselKind::vein),
      source("a thinner one inside", tubeBetween(a, b, 0.001f)),
      source("half overlapping", tubeBetween(0.5f * b, 1.5f * b, 0.003f)),
      source("empty", {})};
  const auto duplicates = findDuplicates(elements);
  CHECK(!duplicates[0]);
  CHECK(duplicates[1] == 0u);
  CHECK(duplicates[2] == 0u);
  for (const int kept : {3, 4, 5, 6}) CHECK(!duplicates[kept]);
}

TEST_CASE("equal elements: the first stays") {
  const TriangleMesh mesh = straightTube(0.05f, 0.002f);
  const std::vector<SourceElement> elements{source("one", mesh), source("two", mesh), source("three", mesh)};
  const auto duplicates = findDuplicates(elements);
  CHECK(!duplicates[0]);
  CHECK(duplicates[1] == 0u);
  CHECK(duplicates[2] == 0u);
}

TEST_CASE("the rough radius of a tube") {
  CHECK(roughRadius(straightTube(0.2f, 0.005f)) == doctest::Approx(0.005f).epsilon(0.1));
  CHECK(roughRadius({}) == 0);
}
