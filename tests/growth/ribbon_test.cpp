#include "growth/ribbon.h"

#include <doctest/doctest.h>

using namespace vasa;

namespace {

// Straight along x, from 2 cm to 1 cm thick; seen along -z with 100 pixels a metre.
struct Scene {
  Capillary capillary;
  shared::GrowthView view{};
  std::vector<shared::CapillaryVertex> vertices = std::vector<shared::CapillaryVertex>(12);

  Scene() {
    for (int i = 0; i < 4; ++i) capillary.curve.b[std::size_t(i)] = vec4(float(i) / 3, 0, 0, 0.02f - 0.01f * float(i) / 3);
    view.viewProjection = mat4(1);
    view.eye = {0, 0, 1};
    view.depth = {0, 0, 0, 1};
    view.right = {1, 0, 0};
    view.up = {0, 1, 0};
    view.focal = 100;
    view.thinnest = 1;
    view.capillary = 0xff0000ff;
  }
  void write() { writeRibbon(capillary, view, 0xffff0000, 0xff00ff00, 5, vertices); }
};

}  // namespace

TEST_CASE("a ribbon is as wide as its curve, gets thinner, and faces the camera") {
  Scene scene;
  scene.write();
  for (std::uint32_t i = 0; i <= 5; ++i) {
    const float radius = 0.02f - 0.01f * float(i) / 5;
    const float beyond = i == 0 ? -0.01f : i == 5 ? 0.005f : 0;  // half a radius
    CHECK(scene.vertices[2 * i].clip.x == doctest::Approx(float(i) / 5 + beyond).epsilon(1e-5));
    CHECK(std::abs(scene.vertices[2 * i].clip.y) == doctest::Approx(radius).epsilon(1e-4));
    CHECK(scene.vertices[2 * i].clip.y == -scene.vertices[2 * i + 1].clip.y);
    CHECK(scene.vertices[2 * i].clip.z == 0);
    CHECK((scene.vertices[2 * i].colour >> 24) == 255);
  }
}

TEST_CASE("a leaf ends in a point") {
  Scene scene;
  scene.capillary.leaf = true;
  scene.view.focal = 1000;
  scene.write();
  CHECK(std::abs(scene.vertices[10].clip.y) == doctest::Approx(0.003f));
  CHECK(std::abs(scene.vertices[8].clip.y) == doctest::Approx(0.012f));
}

TEST_CASE("its colour runs from the vessel's towards the bed's") {
  Scene scene;
  scene.write();
  CHECK((scene.vertices[0].colour & 0xffffffu) == 0xff0000u);
  CHECK((scene.vertices[10].colour & 0xffu) == 128);  // half way: phase 0.5 at the end of a stem
  CHECK(((scene.vertices[10].colour >> 16) & 0xffu) == 128);
}

TEST_CASE("thinner than a pixel it stays one pixel wide and fades instead") {
  Scene scene;
  scene.view.focal = 10;
  scene.write();
  CHECK(std::abs(scene.vertices[0].clip.y) == doctest::Approx(0.05f));
  CHECK((scene.vertices[0].colour >> 24) == 102);  // 0.4 of a pixel
  CHECK((scene.vertices[10].colour >> 24) == 51);
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
