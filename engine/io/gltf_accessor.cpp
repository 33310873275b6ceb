#include "io/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/cancellation.h"
#include "io/gltf_rule.h"

namespace vasa::gltf {
namespace {

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

// c / 255, max(c / 127, -1) and so on, as glTF 2.0, 3.11 defines.
template <class Stored>
float toFloat(const std::byte* from, bool normalised) {
  const auto value = float(load<Stored>(from));
  if (!normalised) return value;
  return std::max(value / float(std::numeric_limits<Stored>::max()), -1.0f);
}

float component(const std::byte* from, int type, bool normalised, float) {
  switch (type) {
    case kByte:
      return toFloat<std::int8_t>(from, normalised);
    case kUnsignedByte:
      return toFloat<std::uint8_t>(from, normalised);
    case kShort:
      return toFloat<std::int16_t>(from, normalised);
    case kUnsignedShort:
      return toFloat<std::uint16_t>(from, normalised);
    case kUnsignedInt:
      return float(load<std::uint32_t>(from));
    default:
      return load<float>(from);
  }
}

std::uint32_t component(const std::byte* from, int type, bool, std::uint32_t) {
  switch (type) {
    case kUnsignedByte:
      return load<std::uint8_t>(from);
    case kUnsignedShort:
      return load<std::uint16_t>(from);
    default:
      return load<std::uint32_t>(from);
  }
}

const std::byte* bytesOf(const Asset& asset, int view, std::size_t offset) {
  const auto& bufferView = asset.model.bufferViews[std::size_t(view)];
  const auto bytes = asset.buffers.bytes[std::size_t(bufferView.buffer)];
  if (bytes.empty())
    breaks("/buffers/" + std::to_string(bufferView.buffer),
           "its data is needed, but it is not in the file or beside it", "export with embedded data");
  return bytes.data() + bufferView.byteOffset + offset;
}

template <class T>
void readElement(const std::byte* from, const ElementLayout& layout, int type, bool normalised, T* to) {
  for (std::uint32_t column = 0; column < layout.columns; ++column)
    for (std::uint32_t row = 0; row < layout.rows; ++row)
      *to++ = component(from + column * layout.columnBytes() + row * layout.componentBytes, type, normalised,
                        T{});
}

template <class T>
void readSparse(const Asset& asset, int index, const ElementLayout& layout, std::vector<T>& out) {
  const auto& accessor = asset.model.accessors[std::size_t(index)];
  const auto places = readSparseIndices(asset, index);
  if (places.empty()) return;
  const auto& values = accessor.sparse;
  const std::byte* from = bytesOf(asset, values.valuesView, values.valuesOffset);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] >= out.size() / layout.components()) continue;  // beyond what was asked for
    readElement(from + i * layout.packedBytes(), layout, accessor.componentType, accessor.normalised,
                out.data() + std::size_t(places[i]) * layout.components());
  }
}

template <class T>
std::vector<T> readElements(const Asset& asset, int index, std::size_t atMost) {
  const auto& accessor = asset.model.accessors[std::size_t(index)];
  const std::size_t count = std::min(accessor.count, atMost);
  const ElementLayout layout = elementLayout(accessor);
  std::vector<T> out(count * layout.components());
  if (accessor.bufferView >= 0) {
    const std::size_t given = asset.model.bufferViews[std::size_t(accessor.bufferView)].byteStride;
    const std::size_t stride = given ? given : layout.packedBytes();
    const std::byte* from = bytesOf(asset, accessor.bufferView, accessor.byteOffset);
    Checkpoints checkpoints;
    for (std::size_t i = 0; i < count; ++i, checkpoints.pass())
      readElement(from + i * stride, layout, accessor.componentType, accessor.normalised,
                  out.data() + i * layout.components());
  }
  readSparse(asset, index, layout, out);
  return out;
}

}  // namespace

std::uint32_t componentBytes(std::int64_t componentType) {
  switch (componentType) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

bool isFloatComponent(std::int64_t componentType) { return componentType == kFloat; }

ElementLayout elementLayout(std::int64_t componentType, const std::string& type) {
  ElementLayout layout{componentBytes(componentType), 0, 1};
  if (type == "SCALAR")
    layout.rows = 1;
  else if (type == "VEC2")
    layout.rows = 2;
  else if (type == "VEC3")
    layout.rows = 3;
  else if (type == "VEC4")
    layout.rows = 4;
  else if (type == "MAT2")
    layout.rows = layout.columns = 2;
  else if (type == "MAT3")
    layout.rows = layout.columns = 3;
  else if (type == "MAT4")
    layout.rows = layout.columns = 4;
  return layout;
}

ElementLayout elementLayout(const Model::Accessor& accessor) {
  return elementLayout(accessor.componentType, accessor.type);
}

bool hasData(const Asset& asset, int index) {
  const auto& accessor = asset.model.accessors[std::size_t(index)];
  const auto present = [&](int view) {
    return !asset.buffers.bytes[std::size_t(asset.model.bufferViews[std::size_t(view)].buffer)].empty();
  };
  if (accessor.bufferView >= 0 && !present(accessor.bufferView)) return false;
  return accessor.sparse.count == 0 ||
         (present(accessor.sparse.indicesView) && present(accessor.sparse.valuesView));
}

bool isStored(const Asset& asset, int index) {
  const auto& accessor = asset.model.accessors[std::size_t(index)];
  return accessor.bufferView >= 0 || accessor.sparse.count > 0;
}

std::vector<float> readFloats(const Asset& asset, int accessor, std::size_t atMost) {
  return readElements<float>(asset, accessor, atMost);
}

std::vector<std::uint32_t> readIntegers(const Asset& asset, int accessor) {
  return readElements<std::uint32_t>(asset, accessor, kAll);
}

std::vector<std::uint32_t> readSparseIndices(const Asset& asset, int index) {
  const auto& sparse = asset.model.accessors[std::size_t(index)].sparse;
  if (sparse.count == 0) return {};
  const std::byte* from = bytesOf(asset, sparse.indicesView, sparse.indicesOffset);
  const std::uint32_t bytes = componentBytes(sparse.indicesType);
  std::vector<std::uint32_t> places(sparse.count);
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = component(from + i * bytes, sparse.indicesType, false, std::uint32_t{});
  return places;
}

}  // namespace vasa::gltf
