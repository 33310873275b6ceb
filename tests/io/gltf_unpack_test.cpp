// Files packed by the coders' own libraries are read as the bodies they were.
#include <doctest/doctest.h>
#include <draco/compression/encode.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstring>

#include "core/log.h"
#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;
using nlohmann::json;

namespace {

constexpr std::uint32_t kSide = 30;  // vertices of a sheet's side

struct Sheet {
  std::vector<float> positions, normals, weights;
  std::vector<std::uint8_t> joints;
  std::vector<std::uint16_t> corners;
};

Sheet sheet() {
  Sheet out;
  for (std::uint32_t i = 0; i < kSide; ++i)
    for (std::uint32_t k = 0; k < kSide; ++k) {
      const float u = float(i) / float(kSide - 1), v = float(k) / float(kSide - 1), slope = std::cos(6 * u);
      const vec3 normal = glm::normalize(vec3(-slope, 0, 1));
      out.positions.insert(out.positions.end(), {u, v, std::sin(6 * u) / 6});
      out.normals.insert(out.normals.end(), {normal.x, normal.y, normal.z});
      out.weights.insert(out.weights.end(), {v, 1 - v, 0, 0});
      out.joints.insert(out.joints.end(), {0, 1, 0, 0});
      if (i + 1 == kSide || k + 1 == kSide) continue;
      const auto a = std::uint16_t(i * kSide + k), b = std::uint16_t(a + kSide);
      for (const std::uint16_t corner :
           {a, b, std::uint16_t(b + 1), a, std::uint16_t(b + 1), std::uint16_t(a + 1)})
        out.corners.push_back(corner);
    }
  return out;
}

/// The body of bodyFile with a sheet for a skin. The sheet's accessors: 7 to 11.
GltfBuilder sheetFile() {
  GltfBuilder file = bodyFile();
  const Sheet skin = sheet();
  const int positions = file.floats(skin.positions, "VEC3");
  file.document["accessors"][positions]["min"] = {0, 0, -1};
  file.document["accessors"][positions]["max"] = {1, 1, 1};
  const int normals = file.floats(skin.normals, "VEC3");
  const int joints = file.accessor(skin.joints, "VEC4", GltfBuilder::kUnsignedByte, kSide * kSide);
  const int weights = file.floats(skin.weights, "VEC4");
  const int corners = file.accessor(skin.corners, "SCALAR", GltfBuilder::kUnsignedShort, skin.corners.size());
  json& primitive = file.document["meshes"][0]["primitives"][0];
  primitive["attributes"] = {
      {"POSITION", positions}, {"NORMAL", normals}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}};
  primitive["indices"] = corners;
  return file;
}

std::string refusal(GltfBuilder file) {
  const TemporaryFolder folder;
  const auto result = readBody(writeBytes(folder.path() / "a.glb", file.glb()));
  REQUIRE(!result.ok());
  CHECK(result.error().fault == Fault::badInput);
  return result.error().message;
}

void require(GltfBuilder& file, const char* extension) {
  file.document["extensionsUsed"] = {extension};
  file.document["extensionsRequired"] = {extension};
}

/// Every view of what has a stride of whole words, by itself: what it holds is the builder's one accessor.
GltfBuilder meshoptPacked(GltfBuilder file) {
  const std::vector<unsigned char> plain = std::exchange(file.binary, {});
  const std::map<std::string, std::size_t> numbers = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const std::map<int, std::size_t> sizes = {
      {GltfBuilder::kFloat, 4}, {GltfBuilder::kUnsignedByte, 1}, {GltfBuilder::kUnsignedShort, 2}};
  for (const json& accessor : file.document["accessors"]) {
    json& view = file.document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t stride = numbers.at(accessor["type"]) * sizes.at(accessor["componentType"]);
    const auto count = accessor["count"].get<std::size_t>();
    const unsigned char* data = plain.data() + view["byteOffset"].get<std::size_t>();
    std::vector<unsigned char> packed;
    const char* mode = stride % 4 == 0 ? "ATTRIBUTES" : "TRIANGLES";
    if (stride % 4 == 0) {
      packed.resize(meshopt_encodeVertexBufferBound(count, stride));
      packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), data, count, stride));
    } else {
      std::vector<unsigned> corners(count);
      for (std::size_t i = 0; i < count; ++i) {
        std::uint16_t corner;
        std::memcpy(&corner, data + 2 * i, 2);
        corners[i] = corner;
      }
      packed.resize(meshopt_encodeIndexBufferBound(count, kSide * kSide));
      packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), corners.data(), count));
    }
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", file.binary.size()},
                                                     {"byteLength", packed.size()},
                                                     {"byteStride", stride},
                                                     {"count", count},
                                                     {"mode", mode}};
    view["buffer"] = 1;
    file.binary.insert(file.binary.end(), packed.begin(), packed.end());
    file.binary.resize((file.binary.size() + 3) / 4 * 4);
  }
  file.document["buffers"] = {
      json::object(),
      {{"byteLength", plain.size()}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  require(file, "EXT_meshopt_compression");
  return file;
}

template <class T>
int attributeOf(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType data, int numbers,
                const std::vector<T>& values) {
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, std::int8_t(numbers), data, false,
                 std::int64_t(numbers) * std::int64_t(sizeof(T)), 0);
  const std::uint32_t count = std::uint32_t(values.size()) / std::uint32_t(numbers);
  const int id = mesh.AddAttribute(attribute, true, count);
  for (std::uint32_t i = 0; i < count; ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i * std::uint32_t(numbers)]);
  return int(mesh.attribute(id)->unique_id());
}

GltfBuilder dracoPacked(GltfBuilder file, draco::MeshEncoderMethod method, int bits) {
  const Sheet skin = sheet();
  draco::Mesh mesh;
  mesh.set_num_points(kSide * kSide);
  using Attribute = draco::GeometryAttribute;
  const json ids = {
      {"POSITION", attributeOf(mesh, Attribute::POSITION, draco::DT_FLOAT32, 3, skin.positions)},
      {"NORMAL", attributeOf(mesh, Attribute::NORMAL, draco::DT_FLOAT32, 3, skin.normals)},
      {"JOINTS_0", attributeOf(mesh, Attribute::GENERIC, draco::DT_UINT8, 4, skin.joints)},
      {"WEIGHTS_0", attributeOf(mesh, Attribute::GENERIC, draco::DT_FLOAT32, 4, skin.weights)}};
  for (std::size_t i = 0; i < skin.corners.size(); i += 3)
    mesh.AddFace({draco::PointIndex(skin.corners[i]), draco::PointIndex(skin.corners[i + 1]),
                  draco::PointIndex(skin.corners[i + 2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  if (bits) encoder.SetAttributeQuantization(Attribute::POSITION, bits);
  draco::EncoderBuffer packed;
  REQUIRE(encoder.EncodeMeshToBuffer(mesh, &packed).ok());
  json& primitive = file.document["meshes"][0]["primitives"][0];
  const int view = file.view(std::vector<char>(packed.data(), packed.data() + packed.size()));
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view}, {"attributes", ids}};
  for (const auto& [name, accessor] : primitive["attributes"].items())
    file.document["accessors"][accessor.get<std::size_t>()].erase("bufferView");
  file.document["accessors"][primitive["indices"].get<std::size_t>()].erase("bufferView");
  require(file, "KHR_draco_mesh_compression");
  return file;
}

void checkSame(const Body& body, const Body& expected) {
  REQUIRE(body.meshes.size() == 1);
  const SkinnedMesh &mesh = body.meshes[0], &wanted = expected.meshes[0];
  CHECK(mesh.mesh.positions == wanted.mesh.positions);
  CHECK(mesh.mesh.triangles == wanted.mesh.triangles);
  CHECK(mesh.normals == wanted.normals);
  CHECK(body.skeleton.joints.size() == expected.skeleton.joints.size());
  CHECK(body.clips.size() == expected.clips.size());
}

/// The corners' places, triangle by triangle, in an order of their own.
std::vector<std::array<float, 9>> soupOf(const SkinnedMesh& mesh, float step) {
  std::vector<std::array<float, 9>> soup;
  for (const uvec3& triangle : mesh.mesh.triangles) {
    std::array<vec3, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[std::size_t(k)] = glm::round(mesh.mesh.positions[triangle[k]] / step) * step;
    const auto less = [](vec3 a, vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
    std::array<float, 9> flat;
    std::memcpy(flat.data(), corners.data(), sizeof flat);
    soup.push_back(flat);
  }
  std::sort(soup.begin(), soup.end());
  return soup;
}

}  // namespace

TEST_CASE("a body packed by meshoptimizer is the body, its motion too") {
  const Body plain = bodyOf(sheetFile()), packed = bodyOf(meshoptPacked(sheetFile()));
  checkSame(packed, plain);
  CHECK(packed.clips[0].name == plain.clips[0].name);
}

TEST_CASE("filters of meshoptimizer are undone") {
  GltfBuilder file = sheetFile();
  const Sheet skin = sheet();
  constexpr std::size_t count = kSide * kSide;
  std::vector<float> directions(4 * count, 0.0f);
  for (std::size_t i = 0; i < count; ++i) std::copy_n(&skin.normals[3 * i], 3, &directions[4 * i]);
  std::vector<std::int16_t> filtered(4 * count);
  meshopt_encodeFilterOct(filtered.data(), count, 8, 16, directions.data());
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, 8));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), filtered.data(), count, 8));
  const int from = file.view(packed);
  const int fallback = file.add("buffers", {{"byteLength", 8}});
  CHECK(fallback == 0);
  file.document["buffers"].push_back({{"byteLength", 8 * count}});
  const int view =
      file.add("bufferViews", {{"buffer", 1},
                               {"byteLength", 8 * count},
                               {"byteStride", 8},
                               {"extensions",
                                {{"EXT_meshopt_compression",
                                  {{"buffer", 0},
                                   {"byteOffset", file.document["bufferViews"][from]["byteOffset"]},
                                   {"byteLength", packed.size()},
                                   {"byteStride", 8},
                                   {"count", count},
                                   {"mode", "ATTRIBUTES"},
                                   {"filter", "OCTAHEDRAL"}}}}}});
  const int normals = file.add("accessors", {{"bufferView", view},
                                             {"type", "VEC3"},
                                             {"componentType", 5122},
                                             {"normalized", true},
                                             {"count", count}});
  file.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
  file.document["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  const Body body = bodyOf(file);
  for (std::size_t i = 0; i < count; ++i)
    CHECK(glm::distance(body.meshes[0].normals[i],
                        vec3(skin.normals[3 * i], skin.normals[3 * i + 1], skin.normals[3 * i + 2])) < 1e-3f);
}

TEST_CASE("a body packed by Draco is the body") {
  const Body plain = bodyOf(sheetFile());
  SUBCASE("in order and without loss") {
    checkSame(bodyOf(dracoPacked(sheetFile(), draco::MESH_SEQUENTIAL_ENCODING, 0)), plain);
  }
  SUBCASE("in the coder's order, on a grid of positions") {
    const Body packed = bodyOf(dracoPacked(sheetFile(), draco::MESH_EDGEBREAKER_ENCODING, 14));
    REQUIRE(packed.meshes.size() == 1);
    CHECK(soupOf(packed.meshes[0], 0.01f) == soupOf(plain.meshes[0], 0.01f));
    CHECK(packed.meshes[0].mesh.positions != plain.meshes[0].mesh.positions);
  }
}

TEST_CASE(
    "packed parts that are damaged, tell of other amounts or grow without bound are refused by their place") {
  GltfBuilder meshopt = meshoptPacked(sheetFile());
  json& view = meshopt.document["bufferViews"][7];
  json& coded = view["extensions"]["EXT_meshopt_compression"];
  GltfBuilder draco = dracoPacked(sheetFile(), draco::MESH_EDGEBREAKER_ENCODING, 14);
  SUBCASE("meshopt: bytes") {
    meshopt.binary[coded["byteOffset"].get<std::size_t>()] ^= 0xff;
    CHECK(refusal(meshopt).find(
              "/bufferViews/7/extensions/EXT_meshopt_compression: the compressed data are damaged") !=
          std::string::npos);
  }
  SUBCASE("meshopt: amounts") {
    coded["count"] = kSide;
    CHECK(refusal(meshopt).find("but the buffer view has another length") != std::string::npos);
  }
  SUBCASE("meshopt: past the end") {
    coded["byteOffset"] = 1 << 20;
    CHECK(refusal(meshopt).find("of a buffer of") != std::string::npos);
  }
  SUBCASE("meshopt: mode and filter") {
    coded["mode"] = "POINTS";
    CHECK(refusal(meshopt).find("\"POINTS\" is not known") != std::string::npos);
    coded["mode"] = "ATTRIBUTES";
    coded["filter"] = "QUATERNION";
    CHECK(refusal(meshopt).find("does not go with a stride of 12") != std::string::npos);
  }
  SUBCASE("meshopt: a bomb") {
    coded["count"] = std::size_t(1) << 26;
    view["byteLength"] = std::size_t(12) << 26;
    meshopt.document["buffers"][1]["byteLength"] = std::size_t(1) << 30;
    CHECK(refusal(meshopt).find("unpacks to more than the") != std::string::npos);
  }
  const auto number =
      draco.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"]
          .get<std::size_t>();
  const auto offset = draco.document["bufferViews"][number]["byteOffset"].get<std::size_t>();
  SUBCASE("Draco: a head of another kind") {
    draco.binary[offset] = 'd';
    CHECK(refusal(draco).find(
              "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: holds no Draco data") !=
          std::string::npos);
    draco.binary[offset] = 'D';
    draco.binary[offset + 6] = 1;
    CHECK(refusal(draco).find("is Draco 2.1, only 2.2 is read") != std::string::npos);
  }
  SUBCASE("Draco: amounts") {
    for (int accessor = 7; accessor <= 10; ++accessor)
      draco.document["accessors"][accessor]["count"] = kSide * kSide - 1;
    CHECK(refusal(draco).find("vertices, but its accessor tells of 899") != std::string::npos);
  }
  SUBCASE("Draco: an attribute that is not there") {
    draco.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
                  ["NORMAL"] = 17;
    CHECK(refusal(draco).find("is no attribute of the compressed data") != std::string::npos);
  }
  SUBCASE("Draco: cut short") {
    draco.document["bufferViews"][number]["byteLength"] = 14;
    CHECK(refusal(draco).find("compressed data") != std::string::npos);
  }
}

TEST_CASE("whatever becomes of a packed byte, a body or a reason comes of it") {
  const LogLevel before = logLevel();
  setLogLevel(LogLevel::quiet);
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.glb";
  std::uint32_t state = 1;
  const auto random = [&](std::size_t below) {
    state = state * 1664525u + 1013904223u;
    return std::size_t(state >> 8) % below;
  };
  for (const GltfBuilder& whole :
       {meshoptPacked(sheetFile()), dracoPacked(sheetFile(), draco::MESH_EDGEBREAKER_ENCODING, 12),
        dracoPacked(sheetFile(), draco::MESH_SEQUENTIAL_ENCODING, 12)})
    for (int run = 0; run < 300; ++run) {
      GltfBuilder file = whole;
      for (std::size_t changes = 1 + random(3); changes > 0; --changes)
        file.binary[random(file.binary.size())] = static_cast<unsigned char>(random(256));
      const auto result = readBody(writeBytes(path, file.glb()));
      if (!result) CHECK(result.error().fault == Fault::badInput);
    }
  setLogLevel(before);
}
