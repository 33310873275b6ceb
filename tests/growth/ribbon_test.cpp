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
    for (int i = 0; i < 4; ++i)
      capillary.curve.b[std::size_t(i)] = vec4(float(i) / 3, 0, 0, 0.02f - 0.01f * float(i) / 3);
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

namespace {

// Of a strip's triangles, in the picture.
float areaOf(const std::vector<shared::CapillaryVertex>& vertices) {
  float sum = 0;
  for (std::size_t i = 0; i + 2 < vertices.size(); ++i) {
    const vec4 a = vertices[i + 1].clip - vertices[i].clip, b = vertices[i + 2].clip - vertices[i].clip;
    sum += 0.5f * std::abs(a.x * b.y - a.y * b.x);
  }
  return sum;
}

}  // namespace

TEST_CASE("a thread covers what its ribbon does with two thirds of the triangles") {
  Scene scene;
  scene.view.focal = 10;  // a tenth of a unit a pixel: thinner than that
  std::vector<shared::CapillaryVertex> ribbon(8), thread(shared::kThreadVertices);
  writeRibbon(scene.capillary, scene.view, 0xffff0000, 0xff00ff00, shared::kThreadEdges, ribbon);
  writeThread(scene.capillary, scene.view, 0xffff0000, 0xff00ff00, thread);
  CHECK(3 * ribbonTriangles(shared::kThreads) == 2 * ribbonTriangles(shared::kThreadEdges));
  CHECK(areaOf(thread) == doctest::Approx(areaOf(ribbon)).epsilon(1e-4));
  CHECK(thread[0].clip == ribbon[0].clip);
  CHECK(thread[1].clip == ribbon[1].clip);
  CHECK(thread[2].clip == ribbon[2].clip);
  CHECK(thread[3].clip == ribbon[5].clip);
  CHECK(thread[5].colour == ribbon[7].colour);
  CHECK(ribbonIndices(shared::kThreads, 3).size() == 3 * 4 * 3);
}

TEST_CASE("a leaf's thread has two triangles, between the same corners, and fades less") {
  Scene scene;
  scene.view.focal = 10;
  scene.capillary.leaf = true;
  std::vector<shared::CapillaryVertex> ribbon(8), thread(shared::kThreadVertices);
  writeRibbon(scene.capillary, scene.view, 0xffff0000, 0xff00ff00, shared::kThreadEdges, ribbon);
  writeThread(scene.capillary, scene.view, 0xffff0000, 0xff00ff00, thread);
  CHECK(thread[0].clip == thread[1].clip);
  CHECK(thread[4].clip == thread[5].clip);
  CHECK(areaOf(thread) == doctest::Approx(areaOf(ribbon) * 2 / 3).epsilon(0.01));
  CHECK(float(thread[1].colour >> 24) / float(ribbon[1].colour >> 24) ==
        doctest::Approx(1.25f).epsilon(0.02));
}
