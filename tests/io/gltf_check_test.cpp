#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/log.h"
#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;
using nlohmann::json;

namespace {

struct Break {
  const char* place;  ///< JSON pointer that the message must name
  const char* rule;   ///< a part of the message
  std::function<void(GltfBuilder&)> apply;
};

/// Each change makes the valid body break one rule.
void checkAll(const std::vector<Break>& breaks) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.glb";
  for (const Break& broken : breaks) {
    CAPTURE(std::string(broken.place));
    CAPTURE(std::string(broken.rule));
    GltfBuilder file = bodyFile();
    broken.apply(file);
    const auto result = checkGltf(writeBytes(path, file.glb()));
    CHECK(!result.ok());
    if (result.ok()) continue;
    const std::string& message = result.error().message;
    CAPTURE(message);
    CHECK(result.error().fault == Fault::badInput);
    CHECK(message.starts_with(path.string() + ": " + broken.place + ": "));
    CHECK(message.find(broken.rule) != std::string::npos);
    CHECK(message.find("; ") != std::string::npos);  // a remedy
    CHECK(readBody(path).ok() == false);
    CHECK(readGltfElements(path).ok() == false);
  }
}

/// Sets what a JSON pointer names.
std::function<void(GltfBuilder&)> set(const char* pointer, json value) {
  return [=](GltfBuilder& file) { file.document[json::json_pointer(pointer)] = value; };
}
std::function<void(GltfBuilder&)> erase(const char* parent, const char* key) {
  return [=](GltfBuilder& file) { file.document[json::json_pointer(parent)].erase(key); };
}
/// Overwrites one float of an accessor's data.
std::function<void(GltfBuilder&)> number(int accessor, int index, float value) {
  return [=](GltfBuilder& file) {
    const auto view = file.document["accessors"][accessor]["bufferView"].get<std::size_t>();
    const auto offset = file.document["bufferViews"][view]["byteOffset"].get<std::size_t>();
    std::memcpy(file.binary.data() + offset + std::size_t(index) * 4, &value, 4);
  };
}
std::function<void(GltfBuilder&)> both(std::function<void(GltfBuilder&)> a,
                                       std::function<void(GltfBuilder&)> b) {
  return [=](GltfBuilder& file) {
    a(file);
    b(file);
  };
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("the body that the broken ones are made from is valid") {
  const TemporaryFolder folder;
  const auto path = writeBytes(folder.path() / "a.glb", bodyFile().glb());
  const auto summary = checkGltf(path);
  REQUIRE_MESSAGE(summary.ok(), (summary ? "" : summary.error().message));
  CHECK(summary->nodes == 3);
  CHECK(summary->skins == 1);
  CHECK(summary->animations == 1);
  CHECK(readBody(path).ok());
}

TEST_CASE("broken head") {
  checkAll({
      {"/asset/version", "must be 2.x", set("/asset/version", "1.0")},
      {"/asset/version", "must be a string, is number", set("/asset/version", 2.0)},
      {"/asset/minVersion", "newer than the 2.0", set("/asset/minVersion", "2.1")},
      {"/nodes", "must be an array, is object", set("/nodes", json::object())},
      {"/meshes/0", "must be an object, is null", set("/meshes/0", nullptr)},
      {"/nodes/0/name", "must be a string", set("/nodes/0/name", 3)},
      {"/extensionsRequired/0", "needs the extension EXT_mesh_gpu_instancing, which is not supported",
       both(set("/extensionsUsed", {"EXT_mesh_gpu_instancing"}),
            set("/extensionsRequired", {"EXT_mesh_gpu_instancing"}))},
      {"/extensionsRequired/0", "must also be listed in extensionsUsed",
       set("/extensionsRequired", {"KHR_materials_unlit"})},
      {"/extensionsUsed/1", "listed twice", set("/extensionsUsed", {"A", "A"})},
  });
}

TEST_CASE("broken buffers and views") {
  checkAll({
      {"/bufferViews/0/buffer", "refers to element 1 of buffers, which has 1",
       set("/bufferViews/0/buffer", 1)},
      {"/bufferViews/0/buffer", "refers to element -1", set("/bufferViews/0/buffer", -1)},
      {"/bufferViews/0/buffer", "must be an index, is 0.5", set("/bufferViews/0/buffer", 0.5)},
      {"/bufferViews/0", "must have the property byteLength", erase("/bufferViews/0", "byteLength")},
      {"/bufferViews/0/byteLength", "must be between 1", set("/bufferViews/0/byteLength", 0)},
      {"/bufferViews/0/byteLength", "must be between 1",
       set("/bufferViews/0/byteLength", 18446744073709551615u)},
      {"/bufferViews/0/byteOffset", "must be between 0", set("/bufferViews/0/byteOffset", -4)},
      {"/bufferViews/0", "reach past its buffer", set("/bufferViews/0/byteOffset", 100000)},
      {"/bufferViews/0/byteStride", "must be a multiple of 4", set("/bufferViews/0/byteStride", 14)},
      {"/bufferViews/0/byteStride", "must be between 4 and 252", set("/bufferViews/0/byteStride", 256)},
      {"/bufferViews/0/byteStride", "is more than the buffer view's 36 bytes",
       set("/bufferViews/0/byteStride", 40)},
  });
}

TEST_CASE("broken accessors") {
  const json sparse = {{"count", 1},
                       {"indices", {{"bufferView", 6}, {"componentType", 5123}}},
                       {"values", {{"bufferView", 0}}}};
  const auto with = [&](const char* pointer, json value) {
    return both(set("/accessors/0/sparse", sparse), set(pointer, std::move(value)));
  };
  checkAll({
      {"/accessors/0/componentType", "must be 5120", set("/accessors/0/componentType", 5124)},
      {"/accessors/0/type", "must be SCALAR", set("/accessors/0/type", "VEC5")},
      {"/accessors/0/count", "must be between 1", set("/accessors/0/count", 0)},
      {"/accessors/0/count", "must be between 1", set("/accessors/0/count", 1e15)},
      {"/accessors/0", "needs 48 bytes of a buffer view that has 36", set("/accessors/0/count", 4)},
      {"/accessors/0", "needs 12884901876 bytes", set("/accessors/0/count", 1073741823)},
      {"/accessors/0", "byteOffset 2 must be a multiple of 4", set("/accessors/0/byteOffset", 2)},
      {"/accessors/0", "begins at byte 1 of the buffer",
       both(set("/bufferViews/0/byteOffset", 1), set("/bufferViews/0/byteLength", 36))},
      {"/accessors/0", "is longer than the byteStride 8", set("/bufferViews/0/byteStride", 8)},
      {"/accessors/0", "needs 44 bytes", set("/bufferViews/0/byteStride", 16)},
      {"/accessors/0/bufferView", "refers to element 99", set("/accessors/0/bufferView", 99)},
      {"/accessors/0/byteOffset", "without a bufferView",
       both(erase("/accessors/0", "bufferView"), set("/accessors/0/byteOffset", 0))},
      {"/accessors/7", "3000000000 numbers are more than the",
       [](GltfBuilder& f) {
         f.add("accessors", {{"type", "VEC3"}, {"componentType", 5126}, {"count", 1000000000}});
       }},
      {"/accessors/0/normalized", "can be normalised", set("/accessors/0/normalized", true)},
      {"/accessors/0/min", "must hold 3 numbers, holds 2", set("/accessors/0/min", {0, 0})},
      {"/accessors/0/min/1", "must be a number", set("/accessors/0/min", {0, "x", 0})},
      {"/accessors/0/max", "element 1 is 1.000000, outside the bound 0.500000",
       set("/accessors/0/max", {0.5, 1, 0})},
      {"/accessors/0/sparse/count", "must be between 1 and 3", with("/accessors/0/sparse/count", 4)},
      {"/accessors/0/sparse/indices", "refers to element 9 of 3",
       both(with("/accessors/0/sparse/count", 3), [](GltfBuilder& f) { f.binary[f.binary.size() - 2] = 9; })},
      {"/accessors/0/sparse/indices/componentType", "must be 5121, 5123 or 5125",
       with("/accessors/0/sparse/indices/componentType", 5126)},
      {"/accessors/0/sparse/values", "needs 48 bytes",
       both(with("/accessors/0/sparse/count", 3), set("/accessors/0/sparse/values/byteOffset", 12))},
      {"/accessors/0/sparse/indices", "must increase strictly",
       both(with("/accessors/0/sparse/count", 3), [](GltfBuilder& f) { f.binary[f.binary.size() - 2] = 1; })},
      {"/accessors/0", "element 1 is not a finite number", number(0, 4, kNan)},
      {"/accessors/0", "element 0 is not a finite number", number(0, 0, kInfinity)},
  });
}

TEST_CASE("broken meshes") {
  checkAll({
      {"/meshes/0", "must have the property primitives", erase("/meshes/0", "primitives")},
      {"/meshes/0/primitives", "must not be empty", set("/meshes/0/primitives", json::array())},
      {"/meshes/0/primitives/0/attributes", "must not be empty",
       set("/meshes/0/primitives/0/attributes", json::object())},
      {"/meshes/0/primitives/0/attributes/POSITION", "refers to element 70",
       set("/meshes/0/primitives/0/attributes/POSITION", 70)},
      {"/meshes/0/primitives/0/attributes/POSITION", "must be VEC3, is VEC4",
       set("/meshes/0/primitives/0/attributes/POSITION", 2)},
      {"/meshes/0/primitives/0/attributes/NORMAL", "must be VEC3",
       set("/meshes/0/primitives/0/attributes/NORMAL", 4)},
      {"/meshes/0/primitives/0/attributes/JOINTS_0", "joints must be unsigned",
       set("/meshes/0/primitives/0/attributes/JOINTS_0", 2)},
      {"/meshes/0/primitives/0/attributes/WEIGHTS_0", "weights must be floats",
       set("/meshes/0/primitives/0/attributes/WEIGHTS_0", 1)},
      {"/meshes/0/primitives/0/attributes", "1 sets of joints do not go with 0",
       erase("/meshes/0/primitives/0/attributes", "WEIGHTS_0")},
      {"/meshes/0/primitives/0/attributes/POSITION", "has 2 elements where the others have 3",
       both(set("/accessors/0/count", 2), set("/accessors/0/max", {1, 1, 0}))},
      {"/meshes/0/primitives/0/indices", "indices must be scalars of unsigned",
       set("/meshes/0/primitives/0/indices", 4)},
      {"/meshes/0/primitives/0/mode", "must be between 0 and 6", set("/meshes/0/primitives/0/mode", 7)},
      {"/meshes/0/primitives/0/material", "which has 0", set("/meshes/0/primitives/0/material", 0)},
      {"/meshes/0/primitives/0/targets/0/POSITION", "has 2 elements where the mesh has 3",
       set("/meshes/0/primitives/0/targets", {{{"POSITION", 3}}})},
      {"/accessors/6", "index 2 is 3, but /meshes/0/primitives/0 has 3 vertices",
       [](GltfBuilder& f) { f.binary[f.binary.size() - 2] = 3; }},
      {"/accessors/1", "vertex 2 is bound to joint 1, but /skins/0 has 1", set("/skins/0/joints", {0})},
      {"/accessors/2", "a weight of vertex 1 is negative", number(2, 4, -1)},
      {"/accessors/2", "not a finite number", number(2, 4, kNan)},
      {"/meshes/0/primitives/0/indices", "without a byteStride",
       both(set("/bufferViews/6/byteStride", 4), set("/accessors/6/count", 1))},
      {"/accessors/6", "index 0 is 65535, which asks drivers to begin a new strip",
       [](GltfBuilder& f) { f.binary[f.binary.size() - 6] = f.binary[f.binary.size() - 5] = 255; }},
      {"/meshes/0/primitives/0/attributes/WEIGHTS_0",
       "its buffer view holds another attribute, too, and has no byteStride",
       both(set("/accessors/1/bufferView", 2), set("/accessors/1/count", 3))},
  });
}

TEST_CASE("broken nodes") {
  const auto children = [](std::vector<std::vector<int>> all) {
    return [=](GltfBuilder& file) {
      for (std::size_t i = 0; i < all.size(); ++i) file.document["nodes"][i]["children"] = all[i];
    };
  };
  checkAll({
      {"/nodes/0", "cycle", children({{1}, {0}})},
      {"/nodes/0", "cycle", children({{1}, {2}, {0}})},
      {"/nodes/0/children/0", "is its own child", children({{0}})},
      {"/nodes/2/children/0", "node 1 is already a child of node 0", children({{1}, {}, {1}})},
      {"/nodes/0/children/1", "already a child", children({{1, 1}})},
      {"/nodes/0/children/0", "refers to element 9", children({{9}})},
      {"/nodes/2/mesh", "refers to element 5", set("/nodes/2/mesh", 5)},
      {"/nodes/2/skin", "refers to element 5", set("/nodes/2/skin", 5)},
      {"/nodes/0/skin", "without a mesh", set("/nodes/0/skin", 0)},
      {"/nodes/0/camera", "refers to element 0 of cameras", set("/nodes/0/camera", 0)},
      {"/nodes/0/translation", "must hold 3 numbers", set("/nodes/0/translation", {0, 1})},
      {"/nodes/0/translation/0", "must be a finite number", set("/nodes/0/translation", {1e300, 0, 0})},
      {"/nodes/0/rotation", "must be a unit quaternion, has length 2",
       set("/nodes/0/rotation", {1, 1, 1, 1})},
      {"/nodes/0/rotation", "unit quaternion, has length 0", set("/nodes/0/rotation", {0, 0, 0, 0})},
      {"/nodes/0/matrix", "beside translation", set("/nodes/0/matrix", matrixAt({0, 0, 0}))},
      {"/nodes/2/matrix", "must be affine", set("/nodes/2/matrix", std::vector<float>(16, 1.0f))},
      {"/scene", "refers to element 0 of scenes", set("/scene", 0)},
      {"/scenes/0/nodes/0", "is not a root", set("/scenes", {{{"nodes", {1}}}})},
      {"/scenes/0/nodes/1", "is listed twice", set("/scenes", {{{"nodes", {0, 0}}}})},
  });
}

TEST_CASE("broken skins") {
  checkAll({
      {"/skins/0/joints", "must hold between 1 and", set("/skins/0/joints", json::array())},
      {"/skins/0/joints/1", "refers to element 3", set("/skins/0/joints", {0, 3})},
      {"/skins/0/joints/1", "is listed twice", set("/skins/0/joints", {0, 0})},
      {"/skins/0/skeleton", "refers to element 3", set("/skins/0/skeleton", 3)},
      {"/skins/0/inverseBindMatrices", "must be MAT4", set("/skins/0/inverseBindMatrices", 2)},
      {"/skins/0/inverseBindMatrices", "without a byteStride", set("/bufferViews/3/byteStride", 64)},
      {"/skins/0/joints/1", "node 1 and the first joint have no common root", erase("/nodes/0", "children")},
      {"/skins/0/inverseBindMatrices", "1 matrices are too few for 2 joints", set("/accessors/3/count", 1)},
      {"/accessors/3", "matrix 1 must be affine", number(3, 31, 2)},
      {"/accessors/3", "matrix 0 flattens what it carries", number(3, 0, 0)},
      {"/accessors/3", "matrix 1 flattens what it carries", both(number(3, 21, 0), number(3, 26, 0))},
      {"/nodes/2/skin", "no joints and weights", set("/meshes/0/primitives/0/attributes", {{"POSITION", 0}})},
  });
}

TEST_CASE("broken animations") {
  checkAll({
      {"/animations/0/samplers/0/input", "key times must be scalar floats",
       set("/animations/0/samplers/0/input", 0)},
      {"/animations/0/samplers/0/input", "without a byteStride", set("/bufferViews/4/byteStride", 4)},
      {"/animations/0/samplers/0/interpolation", "must be LINEAR",
       set("/animations/0/samplers/0/interpolation", "BEZIER")},
      {"/animations/0/samplers/0/output", "must be VEC4 for rotation",
       set("/animations/0/samplers/0/output", 0)},
      {"/animations/0/samplers/0/output", "must have 9 values for 3 keys, has 3",
       set("/animations/0/samplers/0/interpolation", "CUBICSPLINE")},
      {"/animations/0/samplers/0/output", "must have 2 values for 2 keys, has 3",
       set("/accessors/4/count", 2)},
      {"/animations/0/channels/0/sampler", "refers to element 1", set("/animations/0/channels/0/sampler", 1)},
      {"/animations/0/channels/0/target/node", "refers to element 7",
       set("/animations/0/channels/0/target/node", 7)},
      {"/animations/0/channels/1/target", "driven by two channels",
       [](GltfBuilder& f) {
         auto& channels = f.document["animations"][0]["channels"];
         channels.push_back(json(channels[0]));
       }},
      {"/animations/0/channels/0/target/node", "must not have a matrix",
       both(erase("/nodes/1", "translation"), set("/nodes/1/matrix", matrixAt({0, -0.5f, 0})))},
      {"/accessors/4", "not a finite number", number(4, 1, kNan)},
  });
}

TEST_CASE("an animation whose keys break a rule is left out; body and other clips are read") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.glb";
  for (const auto& each :
       {std::pair("/accessors/4: key times must increase strictly, do not at key 2", number(4, 2, 0.1f)),
        std::pair("/accessors/4: key time 0 is negative", number(4, 0, -1)),
        std::pair("/accessors/5: element 0 must be a unit quaternion, has length 0", number(5, 3, 0)),
        std::pair("lasts a year", number(4, 2, 31557600)),
        std::pair("needs data", erase("/accessors/4", "bufferView"))}) {
    const std::string why = each.first;
    CAPTURE(why);
    GltfBuilder file = bodyFile();
    const int times = file.floats({0, 1}, "SCALAR"), places = file.floats({0, 0, 0, 0, 0, 1}, "VEC3");
    file.add("animations",
             {{"name", "rise"},
              {"samplers", {{{"input", times}, {"output", places}}}},
              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    each.second(file);
    writeBytes(path, file.glb());
    const auto body = readBody(path);
    REQUIRE(body.ok());
    REQUIRE(body->clips.size() == 1);
    CHECK(body->clips[0].name == "rise");
    if (const auto checked = checkGltf(path); !checked)
      CHECK(checked.error().message.find(why) != std::string::npos);
    CHECK(readGltfElements(path).ok());
    CHECK(countGltf(path).ok());
  }
}

TEST_CASE("keys of what moves no joint are not looked at") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.glb";
  GltfBuilder file = bodyFile();
  const int node = file.add("nodes", {{"name", "camera"}});
  const int times = file.floats({0, 1}, "SCALAR"), places = file.floats({0, 0, 0, 0, 0, 1}, "VEC3"),
            unsorted = file.floats({1, 0}, "SCALAR");
  const auto moves = [](int sampler, int target) {
    return json{{"sampler", sampler}, {"target", {{"node", target}, {"path", "translation"}}}};
  };
  file.add("animations",
           {{"name", "rise"},
            {"samplers", {{{"input", times}, {"output", places}}, {{"input", unsorted}, {"output", places}}}},
            {"channels", {moves(0, 0), moves(1, node)}}});
  const auto body = readBody(writeBytes(path, file.glb()));
  REQUIRE(body.ok());
  CHECK(std::ranges::any_of(body->clips, [](const Clip& clip) { return clip.name == "rise"; }));
  CHECK_FALSE(checkGltf(path).ok());
}

TEST_CASE("broken materials and pictures") {
  const auto material = [](json value) { return set("/materials", json::array({std::move(value)})); };
  checkAll({
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", "must hold 4 numbers",
       material({{"pbrMetallicRoughness", {{"baseColorFactor", {2, 0, 0}}}}})},
      {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "refers to element 0 of textures",
       material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}})},
      {"/materials/0/normalTexture/index", "refers to", material({{"normalTexture", {{"index", 0}}}})},
      {"/textures/0/source", "refers to element 0 of images", set("/textures", {{{"source", 0}}})},
      {"/images/0", "must have either uri or bufferView", set("/images", json::array({json::object()}))},
      {"/images/0/bufferView", "refers to element 50", set("/images", {{{"bufferView", 50}}})},
  });
}

TEST_CASE("oddities that are valid are accepted") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.glb";
  const std::vector<std::function<void(GltfBuilder&)>> oddities = {
      set("/nodes/0/translation", {0.0, 1.0, 0.0}),
      set("/skins/0/inverseBindMatrices", 3.0),
      set("/meshes/0/primitives/0/indices", 6.0),
      set("/accessors/0/extras", {{"deep", {{"er", {1, 2, 3}}}}}),
      set("/images", {{{"uri", "../../absent.png"}}}),  // never opened
      both(set("/extensionsUsed", {"KHR_materials_unlit"}),
           set("/extensionsRequired", {"KHR_materials_unlit"})),
      [](GltfBuilder& f) { f.document["animations"][0]["channels"][0]["target"].erase("node"); },
      set("/asset/version", "2.1"),
      // Not valid, but nothing that is read depends on it: normals of any length and none, colours brighter
      // than white, matrices as 32-bit numbers round them, extensions of other programs.
      [](GltfBuilder& f) {
        f.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
            f.floats({0, 0, 1, 2, 0, 0, kNan, 0, 0}, "VEC3");
      },
      set("/materials", {{{"pbrMetallicRoughness", {{"baseColorFactor", {2, 0, 0, 1}}}}}}),
      [](GltfBuilder& f) {
        std::vector<float> matrix = matrixAt({0, 0, 0});
        matrix[15] = 1.0000001f;
        f.document["nodes"][0].erase("translation");
        f.document["nodes"][0]["matrix"] = matrix;
      },
      both(set("/extensionsUsed", {"MSFT_lod", "VRM"}), set("/extensionsRequired", {"MSFT_lod", "VRM"})),
  };
  for (std::size_t i = 0; i < oddities.size(); ++i) {
    CAPTURE(i);
    GltfBuilder file = bodyFile();
    oddities[i](file);
    const auto body = readBody(writeBytes(path, file.glb()));
    CHECK_MESSAGE(body.ok(), (body ? "" : body.error().message));
  }
}

TEST_CASE("a file that repeats a mesh beyond measure is refused, not expanded") {
  const TemporaryFolder folder;
  GltfBuilder file;
  file.add("accessors", {{"type", "VEC3"}, {"componentType", 5126}, {"count", 1000000}});
  file.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", 4}}}}});
  for (int i = 0; i < 100; ++i) file.add("nodes", {{"mesh", 0}});
  const auto elements = readGltfElements(writeBytes(folder.path() / "a.gltf", file.text()));
  REQUIRE(!elements.ok());
  CHECK(elements.error().message.find("repeated as often as nodes name them, are too large") !=
        std::string::npos);
}
