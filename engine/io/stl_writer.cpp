#include <bit>
#include <cstdint>
#include <cstring>

#include "io/animated_mesh.h"

// Binary STL: 80 bytes, a count, then 50 bytes a triangle; little endian, as every machine is that we build
// for.
namespace vasa {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class Value>
void put(std::vector<std::byte>& bytes, const Value& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

std::vector<std::byte> encodeStl(const AnimatedMesh& mesh, double unit) {
  std::size_t count = 0;
  for (const AnimatedMesh::Part& part : mesh.parts) count += part.triangles.size();
  std::vector<std::byte> bytes;
  bytes.reserve(84 + 50 * count);
  bytes.resize(80);
  constexpr char kHead[] = "binary STL by vasa";  // must not begin with "solid"
  std::memcpy(bytes.data(), kHead, sizeof kHead - 1);
  put(bytes, std::uint32_t(count));
  for (const AnimatedMesh::Part& part : mesh.parts)
    for (const uvec3& t : part.triangles) {
      const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
      const vec3 across = glm::cross(b - a, c - a);
      const float size = glm::length(across);
      put(bytes, size > 0 ? across / size : vec3(0));
      for (const vec3& corner : {a, b, c}) put(bytes, vec3(glm::dvec3(corner) / unit));
      put(bytes, std::uint16_t(0));
    }
  return bytes;
}

}  // namespace vasa
