#include "collide/sphere_tree.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "random_tubes.h"

using namespace vasa;

TEST_CASE("the smallest sphere around two") {
  const Sphere far = mergedSphere({vec3(0), 1}, {vec3(4, 0, 0), 1});
  CHECK(far.centre == vec3(2, 0, 0));
  CHECK(far.radius == 3);
  CHECK(mergedSphere({vec3(0), 5}, {vec3(1, 0, 0), 1}).radius == 5);
}

TEST_CASE("4,030 sweeps take half of the paper's 72 KB") {
  const SphereTree tree(test::randomTubes(4030, 1, 0.5f, 0.01f, 0.001f));
  CHECK(tree.levels() == 5);
  CHECK(tree.bytes() == 4606 * 8);
}

TEST_CASE("every tube is a leaf once, and children lie inside their parent after a refit") {
  for (const std::uint32_t count : {1u, 2u, 7u, 8u, 9u, 63u, 100u, 513u}) {
    const auto rest = test::randomTubes(count, count, 0.2f, 0.02f, 0.002f);
    SphereTree tree(rest);
    const auto moved = test::randomTubes(count, count + 1, 0.2f, 0.02f, 0.002f);
    tree.refit(moved);
    std::vector<std::uint32_t> tubes;
    for (std::uint32_t leaf = 0; leaf < count; ++leaf) tubes.push_back(tree.tube(leaf));
    std::sort(tubes.begin(), tubes.end());
    for (std::uint32_t i = 0; i < count; ++i) CHECK(tubes[i] == i);
    for (std::uint32_t leaf = 0; leaf < count; ++leaf) {
      const Sphere own = boundingSphere(moved[tree.tube(leaf)]), kept = tree.sphere(0, leaf);
      CHECK(glm::distance(own.centre, kept.centre) + own.radius <= kept.radius * 1.00001f);
    }
    for (std::uint32_t level = 0; level + 1 < tree.levels(); ++level)
      for (std::uint32_t node = 0; node < tree.count(level); ++node) {
        const Sphere child = tree.sphere(level, node),
                     parent = tree.sphere(level + 1, node / SphereTree::kArity);
        CHECK(glm::distance(child.centre, parent.centre) + child.radius <= parent.radius * 1.00001f);
      }
    CHECK(tree.count(tree.levels() - 1) == 1);
  }
}
