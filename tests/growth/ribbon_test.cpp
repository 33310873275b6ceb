#include "growth/ribbon.h"

#include <doctest/doctest.h>

#include "reference/ribbon.h"

using namespace vasa;

namespace {

// Straight along x, from 2 cm to 1 cm thick; seen along -z with 100 pixels a metre.
struct Scene {
  Capillary capillary;
  shared::GrowthView view{};
  std::vector<shared::CapillaryVertex> vertices = std::vector<shared::CapillaryVertex>(12);

  Scene() {
    for (int i = 0; i < 4; ++i)
      capillary.curve.b[std::size_t(i)] = vec4(float(i) / 3, 0, 0, 0.02f - 0.01f * float(i) / 3);
    capillary.lastPhase = 0.5f;
    view.viewProjection = mat4(1);
    view.eye = {0, 0, 1};
    view.depth = {0, 0, 0, 1};
    view.right = {1, 0, 0};
    view.up = {0, 1, 0};
    view.focal = 100;
    view.capillary = 0xff0000ff;
  }
  void write() { writeRibbon(capillary, view, 0xffff0000, 5, vertices); }
};

}  // namespace

TEST_CASE("a ribbon is as wide as its curve and its soft edges, gets thinner, and faces the camera") {
  Scene scene;
  scene.write();
  for (std::uint32_t i = 0; i <= 5; ++i) {
    const float radius = 0.02f - 0.01f * float(i) / 5;
    const float beyond = i == 0 ? -0.01f : i == 5 ? 0.005f : 0;  // half a radius
    CHECK(scene.vertices[2 * i].clip.x == doctest::Approx(float(i) / 5 + beyond).epsilon(1e-5));
    CHECK(std::abs(scene.vertices[2 * i].clip.y) == doctest::Approx(radius + 0.0075f).epsilon(1e-4));
    CHECK(scene.vertices[2 * i].clip.y == -scene.vertices[2 * i + 1].clip.y);
    CHECK(scene.vertices[2 * i].clip.z == 0);
    CHECK((scene.vertices[2 * i].colour >> 24) == 255);
  }
}

TEST_CASE("its colour runs from the vessel's towards the bed's") {
  Scene scene;
  scene.write();
  CHECK((scene.vertices[0].colour & 0xffffffu) == 0xff0000u);
  CHECK((scene.vertices[10].colour & 0xffu) == 128);  // half way: phase 0.5 at the end of a stem
  CHECK(((scene.vertices[10].colour >> 16) & 0xffu) == 128);
}

TEST_CASE("thinner than its soft edges it fades: what it covers in all is what the curve does") {
  Scene scene;
  scene.view.focal = 10;  // a pixel is 0.1 wide
  scene.write();
  for (std::uint32_t i = 0; i <= 5; ++i) {
    const float radius = 0.02f - 0.01f * float(i) / 5, reach = radius + 0.075f;
    CHECK(std::abs(scene.vertices[2 * i].clip.y) == doctest::Approx(reach));
    // capillary.frag: a ramp from the edge that would reach 1 after 0.15; its area is reach² / 0.15.
    const float opacity = float(scene.vertices[2 * i].colour >> 24) / 255;
    CHECK(opacity * reach * reach / 0.15f == doctest::Approx(2 * radius).epsilon(0.02));
  }
}

TEST_CASE("what lies deep below the skin, or on the far side, is darker and fainter") {
  Scene scene;
  const auto brightness = [&](vec4 skin) {
    scene.capillary.skin = skin;
    scene.write();
    return scene.vertices[4].colour;
  };
  const std::uint32_t open = brightness(vec4(0)), shallow = brightness(vec4(0, 0, -1, 0.001f)),
                      deep = brightness(vec4(0, 0, -1, 0.03f)), behind = brightness(vec4(0, 0, 1, 0.001f));
  for (const int shift : {16, 24}) {
    const auto part = [&](std::uint32_t colour) { return colour >> shift & 255u; };
    CHECK(part(open) >= part(shallow));
    CHECK(part(shallow) > part(deep));
    CHECK(part(deep) > part(behind));
    CHECK(part(behind) > 0);
  }
}

TEST_CASE("a curve seen end on, and one that is a point, are drawn without a fault") {
  Scene scene;
  for (vec4& p : scene.capillary.curve.b) p = vec4(0, 0, p.x, p.w);
  scene.write();
  for (const auto& vertex : scene.vertices) CHECK(std::isfinite(vertex.clip.x + vertex.clip.y));
  for (vec4& p : scene.capillary.curve.b) p = vec4(0);
  scene.write();
  for (const auto& vertex : scene.vertices) CHECK(std::isfinite(vertex.clip.x + vertex.clip.y));
}

TEST_CASE("the triangles of a ribbon cover it once") {
  const auto indices = ribbonIndices(5, 3);
  CHECK(indices.size() == 3 * 5 * 6);
  CHECK(*std::max_element(indices.begin(), indices.end()) == 3 * 12 - 1);
  CHECK(indices[30] == 12);
}

TEST_CASE("a thread is a ribbon of two edges, a leaf's of one") {
  Scene scene;
  scene.view.focal = 10;
  std::vector<shared::CapillaryVertex> ribbon(6), thread(shared::kThreadVertices);
  CHECK(ribbonTriangles(shared::kThreads) == 4);
  writeRibbon(scene.capillary, scene.view, 0xffff0000, 2, ribbon);
  writeThread(scene.capillary, scene.view, 0xffff0000, thread);
  for (std::size_t i = 0; i < 6; ++i) CHECK(thread[i].clip == ribbon[i].clip);
  CHECK(ribbonIndices(shared::kThreads, 3).size() == 3 * 4 * 3);
  scene.capillary.leaf = true;
  writeThread(scene.capillary, scene.view, 0xffff0000, thread);
  for (const std::size_t i : {0u, 1u}) CHECK(thread[i].clip == ribbon[i].clip);
  for (const std::size_t i : {2u, 3u, 4u, 5u}) CHECK(thread[i].clip == ribbon[4 + i % 2].clip);
}
