#include "io/glb_writer.h"

namespace vasa::gltf {
namespace {

constexpr const char* kLists[] = {"scenes", "nodes",      "meshes",    "materials",
                                  "skins",  "animations", "accessors", "bufferViews"};

void append(std::vector<std::byte>& to, const void* from, std::size_t size) {
  const std::byte* first = static_cast<const std::byte*>(from);
  to.insert(to.end(), first, first + size);
}

}  // namespace

GlbWriter::GlbWriter() {
  root["asset"] = {{"version", "2.0"}, {"generator", "vasa"}};
  for (const char* list : kLists) root[list] = Json::array();
}

std::size_t GlbWriter::addView(const void* from, std::size_t size, Use use, std::size_t stride) {
  Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
  if (stride > 0) view["byteStride"] = stride;
  if (use != data) view["target"] = int(use);
  append(bytes_, from, size);
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  root["bufferViews"].push_back(std::move(view));
  return root["bufferViews"].size() - 1;
}

std::size_t GlbWriter::addAccessor(std::size_t view, Component component, std::size_t count,
                                   const char* type) {
  root["accessors"].push_back(
      {{"bufferView", view}, {"componentType", int(component)}, {"count", count}, {"type", type}});
  return root["accessors"].size() - 1;
}

std::size_t GlbWriter::add(std::span<const float> values, Use use, bool withRange) {
  const std::size_t accessor =
      addAccessor(addView(values.data(), values.size_bytes(), use), floating, values.size(), "SCALAR");
  if (!withRange) return accessor;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  root["accessors"][accessor]["min"] = {*low};
  root["accessors"][accessor]["max"] = {*high};
  return accessor;
}

std::size_t GlbWriter::add(std::span<const vec3> values, Use use, bool withRange) {
  const std::size_t accessor =
      addAccessor(addView(values.data(), values.size_bytes(), use), floating, values.size(), "VEC3");
  if (!withRange) return accessor;
  vec3 low = values[0], high = values[0];
  for (const vec3& p : values) low = glm::min(low, p), high = glm::max(high, p);
  root["accessors"][accessor]["min"] = {low.x, low.y, low.z};
  root["accessors"][accessor]["max"] = {high.x, high.y, high.z};
  return accessor;
}

std::size_t GlbWriter::add(std::span<const vec4> values, Use use) {
  return addAccessor(addView(values.data(), values.size_bytes(), use), floating, values.size(), "VEC4");
}

std::size_t GlbWriter::add(std::span<const glm::u8vec4> values, Use use) {
  return addAccessor(addView(values.data(), values.size_bytes(), use), unsignedByte, values.size(), "VEC4");
}

std::size_t GlbWriter::add(std::span<const mat4> values) {
  return addAccessor(addView(values.data(), values.size_bytes(), data), floating, values.size(), "MAT4");
}

std::size_t GlbWriter::add(std::span<const uvec3> triangles) {
  const std::size_t count = 3 * triangles.size();
  const bool areShort = std::ranges::all_of(triangles, [](uvec3 t) {
    return std::max({t.x, t.y, t.z}) < kShortIndices;
  });
  if (!areShort)
    return addAccessor(addView(triangles.data(), triangles.size_bytes(), indices), unsignedInt, count,
                       "SCALAR");
  const std::vector<glm::u16vec3> small(triangles.begin(), triangles.end());
  return addAccessor(addView(small.data(), 2 * count, indices), unsignedShort, count, "SCALAR");
}

std::size_t GlbWriter::addNumbers(std::span<const std::uint16_t> values) {
  std::vector<std::uint32_t> padded(values.begin(), values.end());  // little-endian: the number comes first
  return addAccessor(addView(padded.data(), padded.size() * 4, vertices, 4), unsignedShort, values.size(),
                     "SCALAR");
}

std::vector<std::byte> GlbWriter::finish() {
  root["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  for (const char* list : kLists)
    if (root[list].empty()) root.erase(list);
  // Names come from files: bytes that are no UTF-8 are replaced.
  std::string text = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<std::byte> file;
  const auto word = [&file](std::uint32_t value) { append(file, &value, 4); };
  word(0x46546c67u);  // "glTF"
  word(2);
  word(std::uint32_t(12 + 8 + text.size() + 8 + bytes_.size()));
  word(std::uint32_t(text.size()));
  word(0x4e4f534au);  // "JSON"
  append(file, text.data(), text.size());
  word(std::uint32_t(bytes_.size()));
  word(0x004e4942u);  // "BIN"
  append(file, bytes_.data(), bytes_.size());
  bytes_.clear();
  return file;
}

}  // namespace vasa::gltf
