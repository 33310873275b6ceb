#include <doctest/doctest.h>

#include "core/log.h"
#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;
using nlohmann::json;

namespace {

std::vector<MeshElement> elementsOf(GltfBuilder file) {
  const TemporaryFolder folder;
  auto result = readGltfElements(writeBytes(folder.path() / "a.glb", file.glb()));
  REQUIRE_MESSAGE(result.ok(), (result ? "" : result.error().message));
  return std::move(result).value();
}

/// Five points (i, i * i, 0) drawn in a mode.
GltfBuilder points(int mode) {
  GltfBuilder file;
  const int positions = file.floats({0, 0, 0, 1, 1, 0, 2, 4, 0, 3, 9, 0, 4, 16, 0}, "VEC3");
  file.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"mode", mode}}}}});
  file.add("nodes", {{"mesh", 0}});
  return file;
}

using Triangles = std::vector<uvec3>;

}  // namespace

TEST_CASE("lists, strips and fans become triangles that face the same way") {
  CHECK(elementsOf(points(4))[0].mesh.triangles ==
        Triangles{{0, 1, 2}});  // the last two corners are no triangle
  CHECK(elementsOf(points(5))[0].mesh.triangles == Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}});
  CHECK(elementsOf(points(6))[0].mesh.triangles == Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}});
  for (const int mode : {0, 1, 2, 3}) CHECK(elementsOf(points(mode))[0].mesh.empty());
}

TEST_CASE("morph targets are in as far as a mesh's weights say, or its node's in their place") {
  GltfBuilder file = points(4);
  json& primitive = file.document["meshes"][0]["primitives"][0];
  for (const float up : {1.0f, 10.0f})
    primitive["targets"].push_back(
        {{"POSITION", file.floats({0, 0, up, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}});
  CHECK(elementsOf(file)[0].mesh.positions[0] == vec3(0));
  file.document["meshes"][0]["weights"] = {0.5, 0};
  CHECK(elementsOf(file)[0].mesh.positions[0] == vec3(0, 0, 0.5f));
  file.document["nodes"][0]["weights"] = {0, 2};
  CHECK(elementsOf(file)[0].mesh.positions[0] == vec3(0, 0, 20));
  CHECK(elementsOf(file)[0].mesh.positions[1] == vec3(1, 1, 0));
}

TEST_CASE("indices of 8, 16 and 32 bits, and stitches of strips") {
  for (const int type :
       {GltfBuilder::kUnsignedByte, GltfBuilder::kUnsignedShort, GltfBuilder::kUnsignedInt}) {
    GltfBuilder file = points(5);
    const std::vector<std::uint8_t> bytes = {0, 1, 2, 2, 3};
    const int accessor = type == GltfBuilder::kUnsignedByte ? file.accessor(bytes, "SCALAR", type, 5)
                         : type == GltfBuilder::kUnsignedShort
                             ? file.accessor<std::uint16_t>({0, 1, 2, 2, 3}, "SCALAR", type, 5)
                             : file.accessor<std::uint32_t>({0, 1, 2, 2, 3}, "SCALAR", type, 5);
    file.document["meshes"][0]["primitives"][0]["indices"] = accessor;
    CHECK(elementsOf(file)[0].mesh.triangles == Triangles{{0, 1, 2}});
  }
}

TEST_CASE("interleaved vertices are read by their stride") {
  GltfBuilder file;
  const int view = file.view<float>({0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9});
  file.document["bufferViews"][0]["byteStride"] = 16;
  file.add("accessors", {{"bufferView", view}, {"type", "VEC3"}, {"componentType", 5126}, {"count", 3}});
  file.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}});
  file.add("nodes", {{"mesh", 0}});
  CHECK(elementsOf(file)[0].mesh.positions == std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("sparse accessors override what lies below, or zeros") {
  for (const bool based : {true, false}) {
    GltfBuilder file = triangleFile();
    const int indices = file.view<std::uint16_t>({0, 2}), values = file.view<float>({5, 5, 5, 7, 7, 7});
    file.document["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    if (!based) file.document["accessors"][0].erase("bufferView");
    const auto expected = std::vector<vec3>{{5, 5, 5}, based ? vec3{1, 0, 0} : vec3{0}, {7, 7, 7}};
    CHECK(elementsOf(file)[0].mesh.positions == expected);
  }
}

TEST_CASE("quantised positions are read where the extension is declared") {
  GltfBuilder file;
  file.accessor<std::int8_t>({0, 0, 0, 0, 127, 0, 0, 0, 0, -128, 0, 0}, "VEC3", GltfBuilder::kByte, 3);
  file.document["bufferViews"][0]["byteStride"] = 4;
  file.document["accessors"][0]["normalized"] = true;
  file.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}});
  file.add("nodes", {{"mesh", 0}});
  const TemporaryFolder folder;
  const auto refused = readGltfElements(writeBytes(folder.path() / "a.glb", file.glb()));
  REQUIRE(!refused.ok());
  CHECK(refused.error().message.find("declare KHR_mesh_quantization") != std::string::npos);
  file.document["extensionsUsed"] = file.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  CHECK(elementsOf(file)[0].mesh.positions == std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}});
}

TEST_CASE("elements stand where their nodes put them, and mirrored ones keep facing out") {
  GltfBuilder file = triangleFile();
  file.document["nodes"] = json::array({
      {{"translation", {0, 0, 2}}, {"children", {1, 2}}},
      {{"name", "a"},
       {"mesh", 0},
       {"scale", {2, 2, 2}},
       {"extras", {{"category", "artery"}, {"fma", "FMA7"}}}},
      {{"name", "b"}, {"mesh", 0}, {"scale", {-1, 1, 1}}},
      {{"name", "elsewhere"}, {"mesh", 0}},
  });
  file.document["scenes"] = {{{"nodes", {0}}}};
  const auto elements = elementsOf(file);
  REQUIRE(elements.size() == 2);
  CHECK(elements[0].name == "a");
  CHECK(elements[0].category == "artery");
  CHECK(elements[0].ontologyId == "FMA7");
  CHECK(elements[0].mesh.positions == std::vector<vec3>{{0, 0, 2}, {2, 0, 2}, {0, 2, 2}});
  CHECK(elements[0].mesh.triangles == Triangles{{0, 1, 2}});
  CHECK(elements[1].category.empty());
  CHECK(elements[1].mesh.positions == std::vector<vec3>{{0, 0, 2}, {-1, 0, 2}, {0, 1, 2}});
  CHECK(elements[1].mesh.triangles == Triangles{{0, 2, 1}});
}

TEST_CASE("an ontology's number is found under whatever key it stands") {
  const auto idWith = [](const json& extras) {
    GltfBuilder file = triangleFile();
    file.document["nodes"] = json::array({{{"mesh", 0}, {"extras", extras}}});
    return elementsOf(file)[0].ontologyId;
  };
  CHECK(idWith({{"FMA", 3734}}) == "FMA3734");
  CHECK(idWith({{"fma_id", "FMA:10951"}}) == "FMA10951");
  CHECK(idWith({{"uberon", "0000947"}}) == "UBERON:0000947");
  CHECK(idWith({{"note", 7}, {"id", "http://purl.obolibrary.org/obo/UBERON_0001585"}}) == "UBERON:0001585");
  CHECK(idWith({{"id", "VHMLeftRenalArtery"}, {"fma", nullptr}, {"size", -3}}).empty());
}

TEST_CASE("colours of vertices are those of what is drawn, a run each; shading is its mean") {
  GltfBuilder file = triangleFile();
  const auto colours = [&](const std::vector<float>& values) {
    file.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = file.floats(values, "VEC3");
    return elementsOf(file)[0];
  };
  const MeshElement red = colours({0.8f, 0.1f, 0.1f, 0.8f, 0.1f, 0.1f, 0.8f, 0.1f, 0.1f});
  REQUIRE(red.colour);
  CHECK(glm::distance(*red.colour, vec3(0.8f, 0.1f, 0.1f)) < 1e-6f);
  REQUIRE(red.materials.size() == 1);
  file.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 1, 1}}}}}};
  file.document["meshes"][0]["primitives"][0]["material"] = 0;
  CHECK(glm::distance(*elementsOf(file)[0].colour, vec3(0.4f, 0.1f, 0.1f)) < 1e-6f);
  file.document["materials"][0]["name"] = std::string(1000, 'x');  // says nothing
  CHECK(elementsOf(file)[0].materials[0].name.empty());
  GltfBuilder two = triangleFile();
  auto& primitive = two.document["meshes"][0]["primitives"][0];
  primitive["attributes"]["POSITION"] =
      two.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}, "VEC3");
  primitive["attributes"]["COLOR_0"] =
      two.floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  primitive.erase("indices");
  const MeshElement both = elementsOf(two)[0];
  REQUIRE(both.materials.size() == 2);
  CHECK(both.materials[1].firstTriangle == 1);
  CHECK(both.materials[1].colour == vec3(0, 0, 1));
}

TEST_CASE("primitives are merged in an element and parted by material in a body") {
  GltfBuilder file = bodyFile();
  auto& primitives = file.document["meshes"][0]["primitives"];
  primitives.push_back(json(primitives[0]));
  file.document["materials"] = {
      {{"name", "red"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 0.5}}}}},
      {{"name", "glass"},
       {"alphaMode", "BLEND"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0, 1, 0, 0.5}}}}}};
  primitives[0]["material"] = 0;
  primitives[1]["material"] = 0;
  CHECK(elementsOf(file)[0].mesh.triangles == Triangles{{0, 1, 2}, {3, 4, 5}});
  Body body = bodyOf(file);
  REQUIRE(body.meshes.size() == 1);
  CHECK(body.meshes[0].name == "skin");
  CHECK(body.meshes[0].colour == vec4(1, 0, 0, 1));  // opaque: the alpha counts for nothing
  CHECK(body.meshes[0].mesh.triangles == Triangles{{0, 1, 2}, {3, 4, 5}});
  file.document["meshes"][0]["primitives"][1]["material"] = 1;
  body = bodyOf(file);
  REQUIRE(body.meshes.size() == 2);
  CHECK(body.meshes[0].name == "skin/red");
  CHECK(body.meshes[1].name == "skin/glass");
  CHECK(body.meshes[1].colour == vec4(0, 1, 0, 0.5f));
}

TEST_CASE("missing normals are computed, given ones are made unit") {
  GltfBuilder file = bodyFile();
  CHECK(bodyOf(file).meshes[0].normals[0] == vec3(0, 0, -1));
  const int normals = file.floats({0, 1.005f, 0, 0, 0, 0, 1, 0, 0}, "VEC3");
  file.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
  CHECK(bodyOf(file).meshes[0].normals == std::vector<vec3>{{0, 1, 0}, {0, 0, -1}, {1, 0, 0}});
}

TEST_CASE("weights are mended: not summing to 1, all zero, normalised integers, more than four") {
  const LogLevel before = logLevel();
  setLogLevel(LogLevel::quiet);
  GltfBuilder file = bodyFile();
  auto& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = file.accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0}, "VEC4",
                                                       GltfBuilder::kUnsignedByte, 3);
  attributes["WEIGHTS_0"] = file.floats({0.5f, 1.5f, 0, 0, 0, 0, 0, 0, 0.25f, 0.25f, 0.5f, 0}, "VEC4");
  Body body = bodyOf(file);
  const auto& mended = body.meshes[0].influences;
  CHECK(mended[0].joints[0] == 1);
  CHECK(mended[0].weights == vec4(0.75f, 0.25f, 0, 0));
  CHECK(mended[1].joints[0] == 1);
  CHECK(mended[1].weights == vec4(1, 0, 0, 0));
  CHECK(mended[2].weights == vec4(0.5f, 0.5f, 0, 0));  // joint 1 named twice
  attributes["WEIGHTS_0"] = file.accessor<std::uint8_t>({51, 204, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, "VEC4",
                                                        GltfBuilder::kUnsignedByte, 3);
  file.document["accessors"].back()["normalized"] = true;
  body = bodyOf(file);
  CHECK(body.meshes[0].influences[0].weights.x == doctest::Approx(0.8));
  CHECK(body.meshes[0].influences[0].weights.y == doctest::Approx(0.2));
  attributes["JOINTS_1"] = attributes["JOINTS_0"];
  attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
  body = bodyOf(file);
  CHECK(body.meshes[0].influences[0].weights.x == doctest::Approx(0.8));
  setLogLevel(before);
}
