#pragma once
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "math/types.h"

namespace vasa::test {

/// Builds small glTF files by hand: a document and one binary buffer.
struct GltfBuilder {
  nlohmann::json document = {{"asset", {{"version", "2.0"}}}};
  std::vector<unsigned char> binary;

  static constexpr int kByte = 5120, kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125,
                       kFloat = 5126;

  /// Appends an element to a top-level array and returns its index.
  int add(const char* array, nlohmann::json element) {
    document[array].push_back(std::move(element));
    return int(document[array].size()) - 1;
  }

  template <class T>
  int view(const std::vector<T>& values) {
    binary.resize((binary.size() + 3) / 4 * 4);
    const std::size_t offset = binary.size();
    binary.resize(offset + values.size() * sizeof(T));
    std::memcpy(binary.data() + offset, values.data(), values.size() * sizeof(T));
    return add("bufferViews",
               {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
  }

  template <class T>
  int accessor(const std::vector<T>& values, const char* type, int componentType, std::size_t count) {
    return add(
        "accessors",
        {{"bufferView", view(values)}, {"type", type}, {"componentType", componentType}, {"count", count}});
  }
  int floats(const std::vector<float>& values, const char* type) {
    const std::size_t size = std::string(type) == "SCALAR" ? 1
                             : std::string(type) == "MAT4" ? 16
                                                           : type[3] - '0';
    return accessor(values, type, kFloat, values.size() / size);
  }

  std::string text() {
    if (!binary.empty()) document["buffers"][0]["byteLength"] = binary.size();
    return document.dump();
  }

  static void append(std::string& out, std::uint32_t word) {
    for (int i = 0; i < 4; ++i) out += char(word >> (8 * i));
  }

  /// The whole .glb.
  std::string glb() {
    std::string json = text();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bin(binary.begin(), binary.end());
    bin.resize((bin.size() + 3) / 4 * 4);
    std::string out = "glTF";
    append(out, 2);
    append(out, std::uint32_t(20 + json.size() + (bin.empty() ? 0 : 8 + bin.size())));
    append(out, std::uint32_t(json.size()));
    out += "JSON" + json;
    if (bin.empty()) return out;
    append(out, std::uint32_t(bin.size()));
    return out + std::string("BIN\0", 4) + bin;
  }

  std::string dataUri() const {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out = "data:application/octet-stream;base64,";
    for (std::size_t i = 0; i < binary.size(); i += 3) {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < binary.size() ? binary[i + k] : 0u);
      for (std::size_t k = 0; k < 4; ++k)
        out += i + k > binary.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return out;
  }
};

inline std::filesystem::path writeBytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// One triangle on a node "triangle": (0,0,0) (1,0,0) (0,1,0).
inline GltfBuilder triangleFile() {
  GltfBuilder file;
  const int positions = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  file.add("meshes", {{"name", "mesh"}, {"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
  file.add("nodes", {{"name", "triangle"}, {"mesh", 0}});
  return file;
}

inline std::vector<float> matrixAt(vec3 t) { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, t.x, t.y, t.z, 1}; }

/// A triangle on two joints, "hip" at (0,1,0) and its child "knee" at (0,0.5,0); vertices 0 and 1 on the hip,
/// 2 on the knee; a clip "bend" of three keys, 0.1 s apart, that turns the knee about z by 0, 45 and 90
/// degrees. Accessors: 0 positions, 1 joints, 2 weights, 3 inverse binds, 4 times, 5 rotations, 6 indices.
inline GltfBuilder bodyFile() {
  GltfBuilder file;
  const int positions = file.floats({0, 1, 0, 1, 1, 0, 0, 0, 0}, "VEC3");
  file.document["accessors"][0]["min"] = {0, 0, 0};
  file.document["accessors"][0]["max"] = {1, 1, 0};
  const int joints = file.accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4",
                                                 GltfBuilder::kUnsignedByte, 3);
  const int weights = file.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  std::vector<float> binds = matrixAt({0, -1, 0});
  const auto knee = matrixAt({0, -0.5f, 0});
  binds.insert(binds.end(), knee.begin(), knee.end());
  const int inverse = file.floats(binds, "MAT4");
  const int times = file.floats({0, 0.1f, 0.2f}, "SCALAR");
  const float s = std::sqrt(0.5f);
  const int turns = file.floats({0, 0, 0, 1, 0, 0, std::sin(kPi / 8), std::cos(kPi / 8), 0, 0, s, s}, "VEC4");
  const int indices = file.accessor<std::uint16_t>({0, 1, 2}, "SCALAR", GltfBuilder::kUnsignedShort, 3);
  file.add("meshes",
           {{"name", "skin"},
            {"primitives",
             {{{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
               {"indices", indices}}}}});
  file.add("nodes", {{"name", "hip"}, {"translation", {0, 1, 0}}, {"children", {1}}});
  file.add("nodes", {{"name", "knee"}, {"translation", {0, -0.5, 0}}});
  file.add("nodes", {{"name", "figure"}, {"mesh", 0}, {"skin", 0}});
  file.add("skins", {{"joints", {0, 1}}, {"inverseBindMatrices", inverse}});
  file.add("animations", {{"name", "bend"},
                          {"samplers", {{{"input", times}, {"output", turns}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}}}}});
  return file;
}

}  // namespace vasa::test
