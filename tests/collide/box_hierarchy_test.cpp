#include "collide/box_hierarchy.h"

#include <doctest/doctest.h>

#include <random>

#include "math/triangle_pair.h"
#include "random_tubes.h"

using namespace vasa;

namespace {

std::vector<TubePair> byBruteForce(const TubeSurface& surface, std::span<const vec3> positions,
                                   const Exclusions& exclusions) {
  const auto triangle = [&](std::uint32_t tube, std::uint32_t t) {
    const uvec3 v = surface.triangle(tube, t);
    return Triangle{positions[v.x], positions[v.y], positions[v.z]};
  };
  std::vector<TubePair> pairs;
  for (std::uint32_t i = 0; i < exclusions.tubeCount(); ++i)
    for (std::uint32_t j = i + 1; j < exclusions.tubeCount(); ++j) {
      if (exclusions.contains(i, j)) continue;
      bool cross = false;
      for (std::uint32_t a = 0; !cross && a < surface.trianglesPerTube(); ++a)
        for (std::uint32_t b = 0; !cross && b < surface.trianglesPerTube(); ++b)
          cross = trianglesCross(triangle(i, a), triangle(j, b));
      if (cross) pairs.push_back({i, j});
    }
  return pairs;
}

template <class Box>
void compareWithBruteForce() {
  constexpr std::uint32_t kCount = 61;  // no power of two
  const TubeSurface surface(5, 3);
  const auto rest = test::randomTubes(kCount, 3, 1, 0.8f, 0.06f),
             other = test::randomTubes(kCount, 4, 1, 0.8f, 0.06f);
  std::vector<vec3> positions, moved;
  surface.shape(rest, positions);
  surface.shape(other, moved);
  const Exclusions none(kCount);
  const auto truth = byBruteForce(surface, positions, none);
  REQUIRE(truth.size() > 20);
  const std::vector<TubePair> excluded{truth[0], truth[7]};
  const Exclusions some(kCount, excluded);
  BoxHierarchy<Box> hierarchy(surface, positions, some);
  const auto found = hierarchy.detect();
  CHECK(std::vector(found.begin(), found.end()) == byBruteForce(surface, positions, some));
  CHECK(found.size() == truth.size() - 2);
  hierarchy.refit(moved);
  const auto then = hierarchy.detect();
  CHECK(std::vector(then.begin(), then.end()) == byBruteForce(surface, moved, some));
  const std::size_t boxes = 2 * kCount * surface.trianglesPerTube() - 1;
  CHECK(hierarchy.bytes() == boxes * sizeof(Box) + 4 * kCount * (1 + surface.trianglesPerTube()));
}

}  // namespace

TEST_CASE("hierarchies of boxes find the tubes whose triangles cross, in another shape, too") {
  compareWithBruteForce<AlignedBox>();
  compareWithBruteForce<OrientedBox>();
}

TEST_CASE("a hierarchy of none and of one tube") {
  const TubeSurface surface(4, 2);
  std::vector<vec3> positions;
  for (const std::uint32_t count : {0u, 1u}) {
    const Exclusions exclusions(count);
    surface.shape(test::randomTubes(count, 1, 1, 0.5f, 0.01f), positions);
    CHECK(BoxHierarchy<AlignedBox>(surface, positions, exclusions).detect().empty());
    CHECK(BoxHierarchy<OrientedBox>(surface, positions, exclusions).detect().empty());
  }
}

TEST_CASE("an oriented box holds its points, lies along them, and is told apart from its neighbour") {
  std::mt19937 random(9);
  std::normal_distribution<float> normal;
  const mat3 turn = glm::mat3_cast(glm::normalize(quat(0.3f, 0.5f, -0.7f, 0.2f)));
  std::vector<vec3> points, across;
  for (int i = 0; i < 500; ++i) {
    const vec3 p = turn * (vec3(normal(random), normal(random), normal(random)) * vec3(10, 1, 0.2f));
    points.push_back(p);
    across.push_back(p + turn * vec3(0, 0, 2.5f));
  }
  const OrientedBox box = OrientedBox::around(points);
  CHECK(std::abs(glm::dot(box.longest(), turn[0])) > 0.99f);
  for (const vec3& p : points) {
    const vec3 along = glm::abs((p - box.centre) * box.axes);
    CHECK(glm::all(glm::lessThanEqual(along, box.half + 1e-5f)));
  }
  CHECK(box.meets(box));
  CHECK_FALSE(box.meets(OrientedBox::around(across)));
  CHECK(AlignedBox::around(points).meets(AlignedBox::around(across)));
  const vec3 one[] = {{1, 2, 3}, {1, 2, 3}};
  CHECK(OrientedBox::around(one).meets(OrientedBox::around(one)));
}

TEST_CASE("a tube's surface: rings about its centre line, all triangles looking outwards") {
  const TubeSurface surface(6, 4);
  const Bezier tube{{vec4(0, 0, 0, 0.1f), vec4(0, 1, 0, 0.1f), vec4(0.5f, 2, 0, 0.2f), vec4(1, 2, 0, 0.2f)}};
  std::vector<vec3> positions;
  surface.shape({&tube, 1}, positions);
  REQUIRE(positions.size() == surface.verticesPerTube());
  CHECK(surface.trianglesPerTube() == 48);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const vec4 centre = tube.at(float(v / 6) / 4);
    CHECK(glm::distance(positions[v], vec3(centre)) == doctest::Approx(centre.w).epsilon(1e-4));
  }
  for (std::uint32_t t = 0; t < 48; ++t) {
    const uvec3 v = surface.triangle(0, t);
    const vec3 normal = glm::cross(positions[v.y] - positions[v.x], positions[v.z] - positions[v.x]);
    const vec3 middle = (positions[v.x] + positions[v.y] + positions[v.z]) / 3.0f;
    const vec4 centre = tube.at((float(t / 12) + 0.5f) / 4);
    CHECK(glm::dot(normal, middle - vec3(centre)) > 0);
  }
}
