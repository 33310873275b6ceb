#include "io/animated_mesh.h"

#include <doctest/doctest.h>

#include "core/atomic_file.h"
#include "io/gltf.h"
#include "io/obj.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// Two triangles of two kinds that share an edge, and move.
AnimatedMesh sample() {
  AnimatedMesh mesh;
  mesh.name = "vessels";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.25f}};
  mesh.normals.assign(4, vec3(0, 0, 1));
  mesh.parts = {{"artery", {1, 0, 0}, {{0, 1, 2}}}, {"vein", {0, 0, 1}, {{1, 3, 2}}}};
  mesh.labelOfVertex = {0, 1, 0, 1};
  mesh.labels = {{"left \"x\" artery", "artery", "FMA1"}, {"a vein \xff", "vein", ""}};
  mesh.clip = "walk";
  mesh.times = {0, 0.5f, 1};
  mesh.shapes = {std::vector<vec3>(4, vec3(0, 0, 1)), {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 2, 0}}};
  mesh.normalShapes.assign(2, std::vector<vec3>(4, vec3(0)));
  mesh.weights = {{0, 0}, {1, 0}, {0, 1}};
  return mesh;
}

std::filesystem::path write(const TemporaryFolder& folder, const char* name,
                            std::span<const std::byte> bytes) {
  REQUIRE(writeFileAtomically(folder.path() / name, bytes).ok());
  return folder.path() / name;
}

}  // namespace

TEST_CASE("an animated mesh becomes a GLB that our own complete check takes, moving or not") {
  const TemporaryFolder folder;
  AnimatedMesh mesh = sample();
  const auto summary = checkGltf(write(folder, "a.glb", encodeGlb(mesh)));
  if (!summary.ok()) FAIL(summary.error().message);
  CHECK(summary->meshes == 1);
  CHECK(summary->animations == 1);
  const auto elements = readGltfElements(folder.path() / "a.glb");
  REQUIRE(elements.ok());
  REQUIRE(elements->size() == 2);  // as the weights of the first key leave them: its own shape
  for (std::size_t k = 0; k < 2; ++k) {
    const MeshElement& element = (*elements)[k];
    CHECK(element.category == mesh.labels[k].kind);
    CHECK(element.ontologyId == mesh.labels[k].ontologyId);
    // Not the other vessels' materials, by whose names its kind would be another.
    CHECK(element.surroundings == std::vector<std::string>{"vessels"});
    REQUIRE(element.mesh.triangles == std::vector<uvec3>{{0, 1, 2}});
    for (int c = 0; c < 3; ++c)
      CHECK(element.mesh.positions[c] == mesh.positions[mesh.parts[k].triangles[0][c]]);
  }
  CHECK((*elements)[0].name == mesh.labels[0].name);
  mesh.weights[0] = {1, 0.5f};
  const auto shaped = readGltfElements(write(folder, "s.glb", encodeGlb(mesh)));
  REQUIRE(shaped.ok());
  CHECK((*shaped)[1].mesh.positions == std::vector<vec3>{{1, 0, 1}, {1, 2, 1.25f}, {0, 1, 1}});
  mesh.labelOfVertex = {0, 7, 0, 1};  // of no vessel there is
  const auto stray = readGltfElements(write(folder, "n.glb", encodeGlb(mesh)));
  REQUIRE(stray.ok());
  CHECK(stray->size() == 2);
  CHECK((*stray)[1].name == "vessels");
  mesh = sample();
  CHECK(encodeGlb(mesh) == encodeGlb(mesh));
  mesh.normals.clear(), mesh.normalShapes.clear();
  CHECK(checkGltf(write(folder, "flat.glb", encodeGlb(mesh))).ok());
  mesh.shapes.clear(), mesh.normalShapes.clear(), mesh.times.clear(), mesh.weights.clear();
  const auto still = checkGltf(write(folder, "b.glb", encodeGlb(mesh)));
  REQUIRE(still.ok());
  CHECK(still->animations == 0);
}

TEST_CASE("an OBJ has an object a vessel and is read back the same") {
  const TemporaryFolder folder;
  const std::string text = encodeObj(sample());
  const auto elements = readObj(write(folder, "a.obj", std::as_bytes(std::span(text))));
  if (!elements.ok()) FAIL(elements.error().message);
  REQUIRE(elements->size() == 2);
  CHECK((*elements)[0].name == "left \"x\" artery");
  CHECK((*elements)[0].surroundings == std::vector<std::string>{"artery"});
  CHECK((*elements)[0].mesh.positions[1] == vec3(1, 0, 0));
  CHECK((*elements)[1].mesh.triangles.size() == 1);
  CHECK((*elements)[1].mesh.positions[1] == vec3(1, 1, 0.25f));
}

TEST_CASE("an OBJ's name that ends with a backslash does not swallow what comes after it") {
  const TemporaryFolder folder;
  AnimatedMesh mesh = sample();
  mesh.labels[0].name = "artery\\";
  const std::string text = encodeObj(mesh);
  const auto elements = readObj(write(folder, "a.obj", std::as_bytes(std::span(text))));
  if (!elements.ok()) FAIL(elements.error().message);
  CHECK((*elements)[0].name == "artery\\");
  CHECK((*elements)[0].surroundings == std::vector<std::string>{"artery"});
}
