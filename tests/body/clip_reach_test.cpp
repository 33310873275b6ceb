#include "body/clip_reach.h"

#include <doctest/doctest.h>

#include "body/chain.h"

using namespace vasa;
using namespace vasa::test;

namespace {

Track<vec3> trackTo(vec3 first, vec3 last) { return {Interpolation::linear, {0, 1}, {first, last}}; }

// A body that stands 5 km from the origin, with twenty links.
Skeleton chainFarOff() {
  std::vector<vec3> centres;
  for (int i = 0; i <= 20; ++i) centres.emplace_back(5000, 0.1f * float(i), 0);
  return chainBody(centres).skeleton;
}

}  // namespace

TEST_CASE("a clip strays where a joint may come farther than a kilometre from where the body stands") {
  const Skeleton skeleton = chainFarOff();
  const auto stays = [&](std::uint32_t joint, const Track<vec3>& translation, const Track<vec3>& scale) {
    Clip clip;
    clip.tracks.push_back({JointId{joint}, translation, {}, scale});
    return staysNear(skeleton, clip);
  };
  CHECK(staysNear(skeleton, Clip{}));
  CHECK(stays(0, trackTo({5000, 0, 0}, {5990, 0, 0}), {}));
  CHECK(!stays(0, trackTo({5000, 0, 0}, {6010, 0, 0}), {}));
  CHECK(!stays(7, trackTo({0, 0, 0}, {0, 0, 3e38f}), {}));
  CHECK(stays(3, {}, trackTo({1, 1, 1}, {2, -2, 2})));
  CHECK(!stays(3, {}, trackTo({1, 1, 1}, {1, 1, -1e6f})));
  // Between its keys a spline leaves them by as much as its tangents are long.
  const auto spline = [](float tangent) {
    return Track<vec3>{Interpolation::cubic,
                       {0, 1},
                       {vec3(0), vec3(0, 0.1f, 0), vec3(tangent, 0, 0), vec3(0), vec3(0, 0.1f, 0), vec3(0)}};
  };
  CHECK(stays(1, spline(100), {}));
  CHECK(!stays(1, spline(1e5f), {}));
}
