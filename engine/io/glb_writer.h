#pragma once
#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa::gltf {

/// Collects a glTF file in memory: JSON that the caller fills, and data that accessors name. For our own
/// programs; not installed.
class GlbWriter {
 public:
  using Json = nlohmann::ordered_json;
  enum Component { unsignedByte = 5121, unsignedShort = 5123, unsignedInt = 5125, floating = 5126 };
  enum Use { data = 0, vertices = 34962, indices = 34963 };

  GlbWriter();

  Json root;  ///< lists that stay empty are left out

  /// Values of one number each, or of a glm vector. @return the accessor
  std::size_t add(std::span<const float> values, Use use, bool withRange = false);
  std::size_t add(std::span<const vec3> values, Use use, bool withRange = false);
  std::size_t add(std::span<const vec4> values, Use use);
  std::size_t add(std::span<const glm::u8vec4> values, Use use);
  std::size_t add(std::span<const mat4> values);
  /// Up to so many vertices indices take 16 bits each, of which the highest number has another meaning.
  static constexpr std::uint32_t kShortIndices = 0xffff;
  std::size_t add(std::span<const uvec3> triangles);
  /// One 16-bit number a vertex, on four bytes as glTF asks of vertices.
  std::size_t addNumbers(std::span<const std::uint16_t> values);

  /// The whole file. Everything is taken out.
  std::vector<std::byte> finish();

 private:
  std::size_t addView(const void* from, std::size_t size, Use use, std::size_t stride = 0);
  std::size_t addAccessor(std::size_t view, Component component, std::size_t count, const char* type);

  std::vector<std::byte> bytes_;
};

}  // namespace vasa::gltf
