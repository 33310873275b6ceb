#include "io/gltf_unpack.h"

#include <meshoptimizer.h>

#include <nlohmann/json.hpp>

#include "io/gltf_container.h"
#include "io/read_limits.h"

namespace vasa::gltf {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::byte>;

constexpr const char* kWithout = "export without compression, or unpack it (gltfpack, gltf-transform)";
constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// A compressed part of a file, and how large it may become.
class Quota {
 public:
  explicit Quota(const Buffers& buffers) {
    for (const auto& bytes : buffers.bytes) packed_ += bytes.size();
  }
  void take(const JsonView& place, std::size_t bytes) {
    unpacked_ += bytes;
    const std::size_t most = partOfMemory(packed_, kUnpackedTimes, kUnpackedFreeMiB);
    if (unpacked_ > most)
      place.fail("unpacks to more than the " + std::to_string(most / 1'000'000) +
                     " MB accepted of a file of this size",
                 "split or reduce the asset");
  }
  std::size_t unpacked() const { return unpacked_; }

 private:
  std::size_t packed_ = 0, unpacked_ = 0;
};

std::span<const std::byte> part(const JsonView& place, const Buffers& buffers, std::size_t buffer,
                                std::size_t offset, std::size_t length) {
  if (buffer >= buffers.bytes.size() || buffers.bytes[buffer].empty())
    place.fail("names a buffer that has no data", kWithout);
  const auto bytes = buffers.bytes[buffer];
  if (offset > bytes.size() || length > bytes.size() - offset)
    place.fail("needs bytes up to " + std::to_string(offset + length) + " of a buffer of " +
               std::to_string(bytes.size()));
  return bytes.subspan(offset, length);
}

std::size_t numberIn(const JsonView& object, const char* key, std::size_t low, std::size_t high) {
  return std::size_t(object.at(key).integer(std::int64_t(low), std::int64_t(high)));
}

std::span<const std::byte> meshoptData(const JsonView& place, const Buffers& buffers) {
  const auto offset = place.find("byteOffset");
  return part(place, buffers, numberIn(place, "buffer", 0, buffers.bytes.size()),
              offset ? std::size_t(offset->integer(0, std::int64_t(kMaximumFileBytes))) : 0,
              numberIn(place, "byteLength", 1, kMaximumFileBytes));
}

void unfilter(const JsonView& place, const std::string& filter, Bytes& bytes, std::size_t count,
              std::size_t stride) {
  if (filter == "NONE") return;
  const bool fits = filter == "OCTAHEDRAL"    ? stride == 4 || stride == 8
                    : filter == "QUATERNION"  ? stride == 8
                    : filter == "EXPONENTIAL" ? stride % 4 == 0
                                              : false;
  if (!fits)
    place.fail("has the filter \"" + filter + "\", which does not go with a stride of " +
               std::to_string(stride));
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
}

Bytes decodeMeshopt(const JsonView& place, std::span<const std::byte> data, std::size_t count,
                    std::size_t stride) {
  const std::string mode = place.at("mode").text();
  const std::string filter = place.has("filter") ? place.at("filter").text() : "NONE";
  const bool attributes = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES";
  if (!attributes && !triangles && mode != "INDICES") place.at("mode").fail("\"" + mode + "\" is not known");
  if (attributes ? stride % 4 != 0 || stride > 256 : stride != 2 && stride != 4)
    place.at("byteStride").fail(std::to_string(stride) + " does not go with " + mode);
  if (triangles && count % 3 != 0)
    place.at("count").fail(std::to_string(count) + " is no whole number of triangles");
  if (!attributes && filter != "NONE") place.at("filter").fail("only attributes may have one");
  Bytes bytes(count * stride);
  const auto* from = reinterpret_cast<const unsigned char*>(data.data());
  const int fault = attributes  ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, data.size())
                    : triangles ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, data.size())
                                : meshopt_decodeIndexSequence(bytes.data(), count, stride, from, data.size());
  if (fault != 0) place.fail("the compressed data are damaged", kDamaged);
  unfilter(place, filter, bytes, count, stride);
  return bytes;
}

std::size_t addBuffer(json& document, Buffers& buffers, Bytes bytes) {
  document["buffers"].push_back({{"byteLength", bytes.size()}});
  buffers.bytes.push_back(buffers.read.emplace_back(std::move(bytes)));
  return buffers.bytes.size() - 1;
}

void unpackViews(json& document, Buffers& buffers, Quota& quota) {
  const JsonView root(document);
  const auto views = root.items("bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto extensions = views[i].find("extensions");
    if (!extensions || !extensions->isObject() || !extensions->has(kMeshopt)) continue;
    const JsonView place = extensions->at(kMeshopt);
    place.mustBeObject();
    const std::size_t count = numberIn(place, "count", 1, kMaximumFileBytes);
    const std::size_t stride = numberIn(place, "byteStride", 2, 256);
    if (count * stride != numberIn(views[i], "byteLength", 1, kMaximumFileBytes))
      place.fail("unpacks to " + std::to_string(count * stride) +
                 " bytes, but the buffer view has another length");
    quota.take(place, count * stride);
    Bytes bytes = decodeMeshopt(place, meshoptData(place, buffers), count, stride);
    json& view = document["bufferViews"][i];
    view["buffer"] = addBuffer(document, buffers, std::move(bytes));
    view["byteOffset"] = 0;
    view["extensions"].erase(kMeshopt);
  }
}

struct Packed {
  JsonView place;
  std::span<const std::byte> data;
  json* primitive;
  std::size_t unpacked;  // bytes, each component at its largest
};

class PackedPrimitives {
 public:
  PackedPrimitives(json& document, const Buffers& buffers)
      : root_(document),
        buffers_(buffers),
        views_(root_.items("bufferViews")),
        accessors_(root_.items("accessors")) {
    const auto meshes = root_.items("meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      json& list = document["meshes"][m]["primitives"];
      const auto primitives = meshes[m].items("primitives");
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        const auto extensions = primitives[p].find("extensions");
        if (extensions && extensions->isObject() && extensions->has(kDraco))
          all.push_back(
              {extensions->at(kDraco), dataOf(extensions->at(kDraco)), &list[p], bytesOf(primitives[p])});
      }
    }
  }
  std::vector<Packed> all;

 private:
  std::span<const std::byte> dataOf(const JsonView& place) const {
    place.mustBeObject();
    const JsonView& view = views_[place.at("bufferView").index(views_.size(), "bufferViews")];
    const auto offset = view.find("byteOffset");
    return part(place, buffers_, numberIn(view, "buffer", 0, buffers_.bytes.size()),
                offset ? std::size_t(offset->integer(0, std::int64_t(kMaximumFileBytes))) : 0,
                numberIn(view, "byteLength", 1, kMaximumFileBytes));
  }
  std::size_t countOf(const JsonView& index) const {
    return numberIn(accessors_[index.index(accessors_.size(), "accessors")], "count", 1, kMaximumFileBytes);
  }
  std::size_t bytesOf(const JsonView& primitive) const {
    std::size_t numbers = 0;
    for (const auto& [name, index] : primitive.at("attributes").members()) numbers += 4 * countOf(index);
    if (const auto indices = primitive.find("indices")) numbers += countOf(*indices);
    return 4 * numbers;
  }

  JsonView root_;
  const Buffers& buffers_;
  std::vector<JsonView> views_, accessors_;
};

void unpackPrimitives(json& document, Buffers& buffers, Quota& quota) {
  // All are found before the first is unpacked, which adds buffer views.
  const PackedPrimitives packed(document, buffers);
  for (const Packed& each : packed.all) {
    quota.take(each.place, each.unpacked);
    unpackDraco(each.place, each.data, document, *each.primitive, buffers);
  }
  for (const Packed& each : packed.all) (*each.primitive)["extensions"].erase(kDraco);
}

}  // namespace

std::size_t addView(json& document, Buffers& buffers, Bytes bytes) {
  const std::size_t length = bytes.size();
  document["bufferViews"].push_back(
      {{"buffer", addBuffer(document, buffers, std::move(bytes))}, {"byteLength", length}});
  return document["bufferViews"].size() - 1;
}

std::size_t unpack(json& document, Buffers& buffers) {
  Quota quota(buffers);
  if (uses(JsonView(document), kMeshopt)) unpackViews(document, buffers, quota);
  if (uses(JsonView(document), kDraco)) unpackPrimitives(document, buffers, quota);
  return quota.unpacked();
}

}  // namespace vasa::gltf
