#include <doctest/doctest.h>

#include "body/skinning.h"
#include "io/gltf.h"
#include "support/shared_data.h"

using namespace vasa;

TEST_CASE("every mesh file of the real anatomy loads, named and in metres") {
  VASA_REQUIRE_SHARED_DATA(data);
  const struct {
    const char* file;
    std::size_t elements;
  } files[] = {
      {"bp3d_arteries.glb", 636}, {"bp3d_veins.glb", 395}, {"bp3d_bones.glb", 203}, {"bp3d_heart.glb", 23}};
  for (const auto& listed : files) {
    const char* file = listed.file;
    CAPTURE(file);
    const auto elements = readGltfElements(data / "bp3d" / file);
    REQUIRE_MESSAGE(elements.ok(), (elements ? "" : elements.error().message));
    CHECK(elements->size() == listed.elements);
    for (const MeshElement& element : *elements) {
      CHECK(element.name.starts_with("FJ"));
      CHECK(element.ontologyId.starts_with("FMA"));
      CHECK(!element.category.empty());
      CHECK(!element.mesh.empty());
      const Aabb box = element.mesh.bounds();
      CHECK(box.low.y > -0.1f);
      CHECK(box.high.y < 1.7f);
    }
  }
}

TEST_CASE("the real body has its joints, meshes and clips") {
  VASA_REQUIRE_SHARED_DATA(data);
  const auto body = readBody(data / "bp3d/bp3d_body.glb");
  REQUIRE_MESSAGE(body.ok(), (body ? "" : body.error().message));
  CHECK(body->skeleton.joints.size() == 64);
  REQUIRE(body->meshes.size() == 3);
  CHECK(body->meshes[0].name == "bones");
  CHECK(body->meshes[1].name == "heart");
  CHECK(body->meshes[2].name == "skin");
  CHECK(body->meshes[2].colour.a == doctest::Approx(0.35));
  CHECK(body->meshes[2].mesh.positions.size() == 13380);
  CHECK(body->height() == doctest::Approx(1.7145).epsilon(0.01));
  REQUIRE(body->clips.size() == 11);
  CHECK(body->clips[0].name == "walk_02_01");
  const std::uint32_t frames[] = {86, 44, 121, 240, 375, 120, 120, 75, 120, 110, 120};
  for (std::size_t i = 0; i < 11; ++i) {
    CHECK(body->clips[i].framesPerSecond == 30);
    CHECK(body->clips[i].frameCount() == frames[i]);
  }
}

TEST_CASE("real bodies are at rest where their vertices are stored") {
  VASA_REQUIRE_SHARED_DATA(data);
  for (const char* file :
       {"bp3d/bp3d_body.glb", "rigs/makehuman_male_cmu31.glb", "rigs/makehuman_female_cmu31.glb",
        "rigs/makehuman_male_game53.glb", "rigs/CesiumMan.glb", "rigs/RiggedFigure.glb"}) {
    CAPTURE(file);
    const auto body = readBody(data / file);
    REQUIRE_MESSAGE(body.ok(), (body ? "" : body.error().message));
    const auto matrices = skinMatrices(body->skeleton, restPose(body->skeleton));
    for (const SkinnedMesh& mesh : body->meshes) {
      std::vector<vec3> positions, normals;
      skinVertices(mesh, matrices, positions, normals);
      float moved = 0, turned = 0;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        moved = std::max(moved, glm::distance(positions[i], mesh.mesh.positions[i]));
        turned = std::max(turned, glm::distance(normals[i], mesh.normals[i]));
      }
      CHECK(moved < 1e-4f);
      CHECK(turned < 1e-3f);
    }
  }
}
