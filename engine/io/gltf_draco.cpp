#include <draco/compression/decode.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "io/gltf_accessor.h"
#include "io/gltf_rule.h"
#include "io/gltf_unpack.h"

namespace vasa::gltf {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::byte>;

/// The head of a Draco bitstream 2.2, as far as the amounts: the library takes memory for them before it
/// knows that the data go on so long.
class Head {
 public:
  explicit Head(std::span<const std::byte> data, const JsonView& place) : data_(data), place_(place) {
    if (data.size() < 11 || std::memcmp(data.data(), "DRACO", 5) != 0)
      place.fail("holds no Draco data", kDamaged);
    if (at(5) != 2 || at(6) != 2)
      place.fail("is Draco " + std::to_string(at(5)) + "." + std::to_string(at(6)) + ", only 2.2 is read",
                 "export it again");
    if (at(7) != 1) place.fail("holds points, not triangles", "export the surface");
    if (at(10) & 0x80) place.fail("carries Draco metadata, which are not read", "export without");
    next_ = 11;
    const bool edgebreaker = at(8) == 1;
    if (edgebreaker) {
      ++next_;  // way of travelling
      vertices = number();
      faces = number();
    } else {
      faces = number();
      vertices = number();
    }
  }
  std::uint64_t vertices = 0, faces = 0;

 private:
  unsigned at(std::size_t i) const { return unsigned(data_[i]); }
  std::uint64_t number() {  // LEB128
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      if (next_ == data_.size()) place_.fail("the compressed data end too early", kDamaged);
      const unsigned byte = at(next_++);
      value |= std::uint64_t(byte & 0x7f) << shift;
      if (!(byte & 0x80)) return value;
    }
    place_.fail("the compressed data are damaged", kDamaged);
  }

  std::span<const std::byte> data_;
  JsonView place_;
  std::size_t next_ = 0;
};

/// Every element of a decoded attribute as an accessor has it, elements at multiples of 4 bytes.
template <class T>
Bytes elements(const draco::PointAttribute& attribute, std::size_t points, std::size_t components,
               std::size_t stride) {
  Bytes bytes(points * stride);
  T values[4] = {};
  for (std::size_t i = 0; i < points; ++i) {
    const auto index = attribute.mapped_index(draco::PointIndex(std::uint32_t(i)));
    if (!attribute.ConvertValue<T>(index, std::int8_t(components), values)) return {};
    std::memcpy(&bytes[i * stride], values, components * sizeof(T));
  }
  return bytes;
}

Bytes elementsAs(std::int64_t type, const draco::PointAttribute& attribute, std::size_t points,
                 std::size_t components, std::size_t stride) {
  switch (type) {
    case kByte:
      return elements<std::int8_t>(attribute, points, components, stride);
    case kUnsignedByte:
      return elements<std::uint8_t>(attribute, points, components, stride);
    case kShort:
      return elements<std::int16_t>(attribute, points, components, stride);
    case kUnsignedShort:
      return elements<std::uint16_t>(attribute, points, components, stride);
    case kUnsignedInt:
      return elements<std::uint32_t>(attribute, points, components, stride);
    default:
      return elements<float>(attribute, points, components, stride);
  }
}

template <class T>
Bytes corners(const draco::Mesh& mesh) {
  Bytes bytes(std::size_t(mesh.num_faces()) * 3 * sizeof(T));
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const T corner = T(mesh.face(draco::FaceIndex(f))[std::size_t(k)].value());
      std::memcpy(&bytes[(std::size_t(f) * 3 + std::size_t(k)) * sizeof(T)], &corner, sizeof(T));
    }
  return bytes;
}

Bytes cornersAs(std::int64_t type, const draco::Mesh& mesh) {
  if (type == kUnsignedByte) return corners<std::uint8_t>(mesh);
  return type == kUnsignedShort ? corners<std::uint16_t>(mesh) : corners<std::uint32_t>(mesh);
}

std::unique_ptr<draco::Mesh> decode(const JsonView& place, std::span<const std::byte> data) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok())
    place.fail("the compressed data are damaged (" + mesh.status().error_msg_string() + ")", kDamaged);
  return std::move(mesh).value();
}

void mustBe(const JsonView& place, const char* what, std::uint64_t found, std::uint64_t told) {
  if (found != told)
    place.fail("has " + std::to_string(found) + " " + what + ", but its accessor tells of " +
               std::to_string(told));
}

}  // namespace

void unpackDraco(const JsonView& place, std::span<const std::byte> data, json& document, json& primitive,
                 Buffers& buffers) {
  if (primitive.value("mode", int(kTriangles)) != kTriangles || !primitive.contains("indices"))
    place.fail("only triangles with indices are compressed so", kExportAgain);
  // Checked before: indices of accessors are in range, their types and counts known.
  const auto accessorOf = [&](const json& index) -> json& {
    return document["accessors"][index.get<std::size_t>()];
  };
  const auto countOf = [&](const json& accessor) { return accessor.at("count").get<std::uint64_t>(); };
  json& indices = accessorOf(primitive["indices"]);
  const Head head(data, place);
  mustBe(place, "corners", 3 * head.faces, countOf(indices));
  if (head.vertices > 3 * head.faces) place.fail("has more vertices than corners", kDamaged);
  const auto mesh = decode(place, data);
  mustBe(place, "corners", 3 * std::uint64_t(mesh->num_faces()), countOf(indices));
  const auto store = [&](json& accessor, Bytes bytes) {
    accessor["bufferView"] = addView(document, buffers, std::move(bytes));
    accessor["byteOffset"] = 0;
    // Those of the mesh before it was packed, which moves its vertices.
    accessor.erase("min");
    accessor.erase("max");
  };
  store(indices, cornersAs(indices.at("componentType").get<std::int64_t>(), *mesh));

  for (const auto& [name, id] : place.at("attributes").members()) {
    if (!primitive["attributes"].contains(std::string(name))) id.fail("is no attribute of the primitive");
    json& accessor = accessorOf(primitive["attributes"][std::string(name)]);
    mustBe(place, "vertices", mesh->num_points(), countOf(accessor));
    const auto* attribute = mesh->GetAttributeByUniqueId(std::uint32_t(id.integer(0, 0xffffffff)));
    if (!attribute) id.fail("is no attribute of the compressed data", kDamaged);
    const ElementLayout layout = elementLayout(accessor.at("componentType").get<std::int64_t>(),
                                               accessor.at("type").get<std::string>());
    if (layout.columns > 1 || attribute->num_components() != int(layout.components()))
      id.fail("has " + std::to_string(attribute->num_components()) +
                  " numbers a vertex, its accessor another type",
              kDamaged);
    const std::size_t stride = (layout.packedBytes() + 3) / 4 * 4;
    Bytes bytes = elementsAs(accessor.at("componentType").get<std::int64_t>(), *attribute, mesh->num_points(),
                             layout.components(), stride);
    if (bytes.empty()) id.fail("does not fit its accessor's type", kExportAgain);
    store(accessor, std::move(bytes));
    document["bufferViews"].back()["byteStride"] = stride;
  }
}

}  // namespace vasa::gltf
