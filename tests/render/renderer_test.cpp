#include "render/renderer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gpu_rig.h"
#include "network/measure.h"
#include "render/picture.h"
#include "support/frames.h"
#include "support/meshes.h"
#include "support/networks.h"

using namespace vasa;

namespace {

using test::covered;
using test::hashOfPicture;

using Pixel = std::array<int, 4>;

Pixel at(const Image& image, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = &image.rgba[4 * (std::size_t(y) * image.width + x)];
  return {p[0], p[1], p[2], p[3]};
}

// Everything that a RenderInput points at.
struct RenderSubject {
  explicit RenderSubject(Network chosen)
      : network(std::move(chosen)), points(test::restPoints(network)), frames(test::framesOf(network)) {}
  RenderInput input(const Camera& camera) const { return {points, frames, joints, camera, {}}; }

  Network network;
  std::vector<vec4> points;
  std::vector<quat> frames;
  std::vector<mat4> joints;
};

// One tube from z = 0 to 1 seen from the side: along the picture's width, an eighth of its height thick.
Camera sideView() {
  Camera camera;
  camera.position = {3, 0, 0.5f};
  camera.target = {0, 0, 0.5f};
  camera.orthographicHeight = 1.6f;
  return camera;
}

// A bone of 200 x 400 x 400 mm, alone on a transparent page; the vessel that there has to be is not drawn.
struct LoneBone {
  LoneBone() { subject.joints = {mat4(1)}; }
  RenderInput input() const {
    RenderInput input = subject.input(sideView());
    input.look.transparent = true;
    input.look.drawArteries = false;
    return input;
  }

  RenderSubject subject{test::straightVessel(1, 0.001f, 0.001f, 1)};
  std::vector<SkinnedMesh> meshes{test::boxMesh("bones", {-0.1f, -0.2f, 0.2f}, {0.1f, 0.2f, 0.6f})};
};

RenderOptions small(std::uint32_t samples = 1) {
  RenderOptions options;
  options.width = 161;
  options.height = 160;
  options.samples = samples;
  options.shape = {16, 4};
  options.timed = false;  // the timer's barriers would hide a missing one
  return options;
}

}  // namespace

TEST_CASE("a tube is where it should be, red, and closed at its ends") {
  VASA_REQUIRE_GPU(rig);
  const RenderSubject subject(test::straightVessel(1, 0.1f, 0.1f, 5));
  Renderer renderer(rig.device(), subject.network, {}, small());
  RenderInput input = subject.input(sideView());
  input.look.transparent = true;
  renderer.draw(input);
  const Image image = renderer.readBack();
  const Pixel middle = at(image, 80, 80);
  CHECK(middle[3] == 255);
  CHECK(middle[0] > 2 * middle[2]);
  CHECK(at(image, 80, 60)[3] == 0);
  // 100 pixels a metre: the tube 100 x 20, half a disc of radius 10 at either end
  CHECK(double(covered(image)) == doctest::Approx(100 * 20 + kPi * 100).epsilon(0.04));

  // Looking at an end: the cap hides the inside.
  input.camera.position = {0, 0, 4};
  input.camera.target = {0, 0, 0};
  renderer.draw(input);
  const Image end = renderer.readBack();
  CHECK(at(end, 80, 80)[3] == 255);
  CHECK(double(covered(end)) == doctest::Approx(kPi * 100).epsilon(0.1));
}

TEST_CASE("the background is the look's colour, sRGB as given") {
  VASA_REQUIRE_GPU(rig);
  const RenderSubject subject(test::straightVessel(1, 0.1f, 0.1f, 1));
  Renderer renderer(rig.device(), subject.network, {}, small(4));
  RenderInput input = subject.input(sideView());
  input.look.background = {0.2f, 0.4f, 0.8f, 0.5f};
  renderer.draw(input);
  const Pixel corner = at(renderer.readBack(), 0, 0);
  CHECK(std::abs(corner[0] - 51) <= 1);
  CHECK(std::abs(corner[1] - 102) <= 1);
  CHECK(std::abs(corner[2] - 204) <= 1);
  CHECK(corner[3] == 255);
}

TEST_CASE("kinds and single sweeps can be hidden and coloured, caps with them") {
  VASA_REQUIRE_GPU(rig);
  const RenderSubject subject(test::straightVessel(1, 0.1f, 0.1f, 2));
  Renderer renderer(rig.device(), subject.network, {}, small());
  RenderInput input = subject.input(sideView());
  input.look.transparent = true;
  input.look.drawArteries = false;
  renderer.draw(input);
  CHECK(covered(renderer.readBack()) == 0);
  input.look.drawArteries = true;
  renderer.setSweepColours(std::vector<std::uint32_t>{packColour({0, 1, 0, 1}), packColour({0, 1, 0, 0})});
  renderer.draw(input);
  const Image image = renderer.readBack();
  // From +x, +z is to the left: the first sweep is on the right.
  CHECK(at(image, 105, 80)[1] > 2 * at(image, 105, 80)[0]);
  CHECK(at(image, 55, 80)[3] == 0);
  CHECK(double(covered(image)) == doctest::Approx(50 * 20 + kPi * 50).epsilon(0.06));
  renderer.setSweepColours({});
  renderer.draw(input);
  CHECK(double(covered(renderer.readBack())) == doctest::Approx(100 * 20 + kPi * 100).epsilon(0.04));
}

TEST_CASE("skin lets what lies behind it show through") {
  VASA_REQUIRE_GPU(rig);
  RenderSubject subject(test::straightVessel(1, 0.1f, 0.1f, 2));
  const std::vector<SkinnedMesh> meshes{test::boxMesh("skin", {-0.3f, -0.3f, 0}, {0.3f, 0.3f, 1})};
  subject.joints = {mat4(1)};
  Renderer renderer(rig.device(), subject.network, meshes, small());
  RenderInput input = subject.input(sideView());
  input.look.drawSkin = false;
  renderer.draw(input);
  const Image bare = renderer.readBack();
  input.look.drawSkin = true;
  renderer.draw(input);
  const Image dressed = renderer.readBack();
  CHECK(at(bare, 80, 80) != at(dressed, 80, 80));
  CHECK(at(dressed, 80, 80)[0] > at(dressed, 80, 80)[2] + 40);  // still red
  CHECK(at(dressed, 80, 62) != at(bare, 80, 62));
  CHECK(at(dressed, 80, 2) == at(bare, 80, 2));

  input.look.transparent = true;
  renderer.draw(input);
  const Pixel shell = at(renderer.readBack(), 80, 62);
  CHECK(shell[3] > 10);
  CHECK(shell[3] < 200);
  CHECK(shell[0] > 100);  // straight alpha: the skin's own colour, not darkened by its opacity
}

TEST_CASE("joints move meshes") {
  VASA_REQUIRE_GPU(rig);
  RenderSubject subject(test::straightVessel(1, 0.001f, 0.001f, 1));
  const std::vector<SkinnedMesh> meshes{test::boxMesh("bones", {-0.1f, -0.1f, 0.4f}, {0.1f, 0.1f, 0.6f})};
  Renderer renderer(rig.device(), subject.network, meshes, small());
  subject.joints = {glm::translate(mat4(1), vec3(0, 0.5f, 0))};
  RenderInput input = subject.input(sideView());
  input.look.transparent = true;
  renderer.draw(input);
  const Image image = renderer.readBack();
  CHECK(at(image, 80, 30)[3] == 255);  // half a metre up
  CHECK(at(image, 80, 75)[3] == 0);
}

TEST_CASE("a supersampled picture is the mean of its pixels, in linear light") {
  VASA_REQUIRE_GPU(rig);
  const RenderSubject subject(test::windingNetwork(20, 2));
  const Camera camera = cameraFrom(View::front, measure(subject.network, subject.points).bounds, 1);
  RenderOptions options = small();
  options.width = options.height = 40;
  options.supersample = 3;
  Renderer fine(rig.device(), subject.network, {}, options);
  options.width = options.height = 120;
  options.supersample = 1;
  Renderer large(rig.device(), subject.network, {}, options);
  fine.draw(subject.input(camera));
  large.draw(subject.input(camera));
  const Image reduced = fine.readBack(), whole = large.readBack();
  REQUIRE(reduced.width == 40);
  const auto linear = [](int byte) { return std::pow((double(byte) / 255 + 0.055) / 1.055, 2.4); };
  for (std::uint32_t y = 0; y < 40; y += 3)
    for (std::uint32_t x = 0; x < 40; ++x) {
      double sum = 0;
      for (std::uint32_t i = 0; i < 9; ++i) sum += linear(at(whole, 3 * x + i % 3, 3 * y + i / 3)[0]);
      CHECK(linear(at(reduced, x, y)[0]) == doctest::Approx(sum / 9).epsilon(0.02));
    }
}

TEST_CASE("a beating heart is smaller, and nothing else is") {
  VASA_REQUIRE_GPU(rig);
  RenderSubject subject(test::straightVessel(1, 0.001f, 0.001f, 1));
  const std::vector<SkinnedMesh> meshes{test::boxMesh("bones", {-0.3f, -0.3f, 0.8f}, {0.3f, 0.3f, 1}),
                                        test::boxMesh("heart", {-0.1f, -0.2f, 0.2f}, {0.1f, 0.2f, 0.6f})};
  subject.joints = {mat4(1)};
  Renderer renderer(rig.device(), subject.network, meshes, small());
  const auto pixels = [&](bool heart, float scale) {
    RenderInput input = subject.input(sideView());
    input.look.transparent = true;
    input.look.drawHeart = heart;
    input.look.drawBones = !heart;
    input.look.drawArteries = false;
    input.heartScale = scale;
    renderer.draw(input);
    return double(covered(renderer.readBack()));
  };
  CHECK(pixels(true, 1) == doctest::Approx(40 * 40).epsilon(0.06));
  CHECK(pixels(true, 0.5f) == doctest::Approx(20 * 20).epsilon(0.12));
  CHECK(pixels(false, 0.5f) == pixels(false, 1));
}

TEST_CASE(
    "an organ is seen through another, whichever comes first in the file; what is keep-out is never drawn") {
  VASA_REQUIRE_GPU(rig);
  RenderSubject subject(test::straightVessel(1, 0.001f, 0.001f, 1));
  subject.joints = {mat4(1)};
  const auto picture = [&](const std::vector<SkinnedMesh>& meshes) {
    Renderer renderer(rig.device(), subject.network, meshes, small());
    RenderInput input = subject.input(sideView());
    input.look.transparent = true;
    input.look.drawArteries = false;
    renderer.draw(input);
    return renderer.readBack();
  };
  const SkinnedMesh right = test::boxMesh("organ: right", {-0.3f, -0.2f, 0.3f}, {-0.2f, 0.2f, 0.6f});
  const SkinnedMesh left = test::boxMesh("organ: left", {0.2f, -0.2f, 0.3f}, {0.3f, 0.2f, 0.6f});
  const SkinnedMesh hidden = test::boxMesh("keep-out: all", {-0.3f, -0.2f, 0.3f}, {0.3f, 0.2f, 0.6f});
  const Image both = picture({right, left}), turned = picture({left, right}), one = picture({left});
  REQUIRE(covered(one) > 0);
  CHECK(both.rgba == turned.rgba);
  int most = 0, mostOfOne = 0;
  for (std::size_t i = 3; i < both.rgba.size(); i += 4) {
    most = std::max(most, int(both.rgba[i]));
    mostOfOne = std::max(mostOfOne, int(one.rgba[i]));
  }
  CHECK(most > mostOfOne + 10);
  CHECK(covered(picture({hidden})) == 0);
}

TEST_CASE("a cutting plane of any direction takes away what lies behind it, and nothing else") {
  VASA_REQUIRE_GPU(rig);
  const LoneBone bone;
  for (const std::uint32_t samples : {1u, 4u}) {
    Renderer renderer(rig.device(), bone.subject.network, bone.meshes, small(samples));
    const auto pixels = [&](std::optional<vec4> cut) {
      RenderInput input = bone.input();
      input.camera.cut = cut;
      renderer.draw(input);
      return double(covered(renderer.readBack()));
    };
    const double whole = pixels(std::nullopt);
    CHECK(pixels(vec4(0, 0, 1, 0)) == whole);                                         // before all of it
    CHECK(pixels(vec4(0, 0, -1, 0)) == 0);                                            // behind
    CHECK(pixels(vec4(0, 0, 1, -0.4f)) == doctest::Approx(whole / 2).epsilon(0.06));  // edge on
    CHECK(pixels(vec4(0, 1, 0, 0)) == doctest::Approx(whole / 2).epsilon(0.06));
    CHECK(pixels(vec4(0, 0.6f, 0.8f, -0.32f)) ==
          doctest::Approx(whole / 2).epsilon(0.1));  // aslant through the middle
  }
}

TEST_CASE("a translucent bone covers its share of the samples, the same ones every time") {
  VASA_REQUIRE_GPU(rig);
  const LoneBone bone;
  for (const std::uint32_t samples : {1u, 4u}) {
    Renderer renderer(rig.device(), bone.subject.network, bone.meshes, small(samples));
    const auto share = [&](float opacity) {
      RenderInput input = bone.input();
      input.look.boneOpacity = opacity;
      renderer.draw(input);
      const Image image = renderer.readBack();
      double sum = 0;
      for (std::size_t i = 3; i < image.rgba.size(); i += 4) sum += image.rgba[i];
      return sum / 255;
    };
    const double whole = share(1);
    CHECK(share(0) == 0);
    for (const float opacity : {0.2f, 0.5f, 0.8f})
      CHECK(share(opacity) == doctest::Approx(opacity * whole).epsilon(0.05));
    CHECK(share(0.5f) == share(0.5f));
  }
}

TEST_CASE("a picture depends on its input alone: not on its templates, nor on frames before it") {
  VASA_REQUIRE_GPU(rig);
  RenderSubject subject(test::windingNetwork(40, 9));
  const std::vector<SkinnedMesh> meshes{test::boxMesh("skin", {-0.2f, 0, -0.2f}, {0.2f, 1, 0.2f})};
  subject.joints = {mat4(1)};
  const Camera front = cameraFrom(View::front, measure(subject.network, subject.points).bounds, 1);
  const Camera left = cameraFrom(View::left, measure(subject.network, subject.points).bounds, 1);
  std::vector<std::uint64_t> hashes;
  for (const std::uint32_t bytes : {1u, 150'000u, 400'000u, 1u << 24}) {
    RenderOptions options = small(4);
    options.templateBytes = bytes;
    Renderer renderer(rig.device(), subject.network, meshes, options);
    if (bytes == 150'000) {
      renderer.draw(subject.input(left));
      CHECK(renderer.staticDraw(subject.input(left), 1) >= 0);
    }
    renderer.draw(subject.input(front));
    hashes.push_back(hashOfPicture(renderer.readBack()));
  }
  CHECK(std::count(hashes.begin(), hashes.end(), hashes[0]) == std::ptrdiff_t(hashes.size()));
}

TEST_CASE(
    "a picture after others of other sizes is that of a renderer made for its size, ambient occlusion and all") {
  VASA_REQUIRE_GPU(rig);
  const RenderSubject subject(test::branchingNetwork(6, 3));
  for (const std::uint32_t samples : {1u, 4u}) {
    RenderOptions options = small(samples);
    options.occlusion = true;
    RenderInput input = subject.input(sideView());
    input.look.occlusion = 1;
    Renderer fresh(rig.device(), subject.network, {}, options);
    fresh.draw(input);
    RenderOptions other = options;
    other.width = 90, other.height = 201;
    Renderer resized(rig.device(), subject.network, {}, other);
    resized.draw(input);
    resized.resize(options.width, options.height);
    resized.draw(input);
    CHECK(hashOfPicture(resized.readBack()) == hashOfPicture(fresh.readBack()));
  }
}

TEST_CASE("leaving out what cannot be seen changes no pixel") {
  VASA_REQUIRE_GPU(rig);
  const RenderSubject subject(test::windingNetwork(60, 5));
  Camera far, near, inside, flat;
  far.position = {0.3f, 0.6f, 4};
  near.position = {0.5f, 0.6f, 0.6f};
  inside.position = {0.02f, 0.5f, 0.05f};  // vessels on both sides of the near plane
  flat.orthographicHeight = 0.3f;
  for (const std::uint32_t samples : {1u, 4u})
    for (const float pixelError : {0.0f, 0.2f}) {
      RenderOptions options = small(samples);
      options.pixelError = pixelError;
      options.timed = true;
      Renderer culled(rig.device(), subject.network, {}, options);
      options.cull = false;
      Renderer whole(rig.device(), subject.network, {}, options);
      for (Camera camera : {far, near, inside, flat}) {
        camera.target = {0, 0.5f, 0};
        culled.draw(subject.input(camera));
        whole.draw(subject.input(camera));
        CHECK(culled.drawnTriangleCount() < whole.drawnTriangleCount());
        CHECK(hashOfPicture(culled.readBack()) == hashOfPicture(whole.readBack()));
      }
    }
}

TEST_CASE("a timed frame tells each stage's time and shows the same picture") {
  VASA_REQUIRE_GPU(rig);
  if (rig.device().timestampBits() == 0) return;
  const RenderSubject subject(test::windingNetwork(40, 9));
  RenderOptions options = small(4);
  options.templateBytes = 1;
  const Camera camera = cameraFrom(View::front, measure(subject.network, subject.points).bounds, 1);
  Renderer untimed(rig.device(), subject.network, {}, options);
  untimed.draw(subject.input(camera));
  CHECK(untimed.times().draw == 0);
  CHECK(untimed.times().total > 0);
  options.timed = true;
  Renderer renderer(rig.device(), subject.network, {}, options);
  renderer.draw(subject.input(camera));
  CHECK(hashOfPicture(renderer.readBack()) == hashOfPicture(untimed.readBack()));
  const FrameTimes times = renderer.times();
  CHECK(times.tessellate > 0);
  CHECK(times.draw > 0);
  CHECK(times.meshes > 0);
  CHECK(times.total >= times.tessellate + times.draw);
}

TEST_CASE("a picture that does not wait for the forks' shader comes without them, until they are there") {
  VASA_REQUIRE_GPU(rig);
  const RenderSubject subject(test::branchingNetwork(12, 5));
  RenderOptions options = small(4);
  options.pixelError = kAutoPixelError;
  RenderInput input =
      subject.input(cameraFrom(View::front, measure(subject.network, subject.network.points()).bounds, 1));
  input.look.transparent = true;
  Renderer waits(rig.device(), subject.network, {}, options);
  waits.draw(input);
  const std::uint64_t whole = hashOfPicture(waits.readBack());

  options.compileBehind = true;
  input.waits = false;
  Renderer hurries(rig.device(), subject.network, {}, options);
  hurries.draw(input);
  CHECK(covered(hurries.readBack()) > 100);
  const std::uint64_t drawn = hurries.drawnTriangleCount();
  if (!hurries.isSettled({})) CHECK(drawn < waits.drawnTriangleCount());
  while (!hurries.isSettled(std::chrono::seconds(1))) hurries.draw(input);
  hurries.draw(input);
  CHECK(hashOfPicture(hurries.readBack()) == whole);
}
