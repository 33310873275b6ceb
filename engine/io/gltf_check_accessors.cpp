#include <limits>
#include <nlohmann/json.hpp>

#include "io/gltf_accessor.h"
#include "io/gltf_check.h"
#include "io/gltf_container.h"

// Bounds are computed in 64 bits from values that are limited first: offsets and lengths by
// kMaximumFileBytes, counts by 2^32, strides by 252. So nothing here can wrap.
namespace vasa::gltf {
namespace {

constexpr std::int64_t kMaximumOffset = std::int64_t(kMaximumFileBytes);
constexpr std::int64_t kMaximumCount = std::int64_t(1) << 30;

std::uint64_t offsetOf(const JsonView& object) {
  const auto offset = object.find("byteOffset");
  return offset ? std::uint64_t(offset->integer(0, kMaximumOffset)) : 0;
}

struct View {
  std::uint64_t offset, length, stride;  // stride 0: none given
};

class Views {
 public:
  explicit Views(const JsonView& root) : all_(root.items("bufferViews")) {}
  View referredBy(const JsonView& index) const {
    const JsonView& view = all_[index.index(all_.size(), "bufferViews")];
    const auto stride = view.find("byteStride");
    return {offsetOf(view), std::uint64_t(view.at("byteLength").integer(1, kMaximumOffset)),
            stride ? std::uint64_t(stride->integer(4, 252)) : 0};
  }

 private:
  std::vector<JsonView> all_;
};

void checkAlignment(const JsonView& place, std::uint64_t offset, std::uint64_t inBuffer,
                    std::uint32_t bytes) {
  if (offset % bytes != 0)
    place.fail("byteOffset " + std::to_string(offset) + " must be a multiple of " + std::to_string(bytes) +
               ", the size of a component");
  if ((offset + inBuffer) % bytes != 0)
    place.fail("begins at byte " + std::to_string(offset + inBuffer) +
               " of the buffer, which is no multiple of " + std::to_string(bytes) +
               ", the size of a component");
}

void checkEnd(const JsonView& place, std::uint64_t end, const View& view) {
  if (end > view.length)
    place.fail("needs " + std::to_string(end) + " bytes of a buffer view that has " +
               std::to_string(view.length));
}

void checkSparse(const JsonView& sparse, const Views& views, const ElementLayout& layout,
                 std::int64_t count) {
  const auto overrides = std::uint64_t(sparse.at("count").integer(1, count));
  const JsonView indices = sparse.at("indices");
  const std::int64_t type = indices.at("componentType").integer(0, 65535);
  if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt)
    indices.at("componentType").fail("must be 5121, 5123 or 5125, is " + std::to_string(type));
  const auto check = [&](const JsonView& part, std::uint32_t componentSize, std::uint64_t elementSize) {
    const View view = views.referredBy(part.at("bufferView"));
    if (view.stride) part.at("bufferView").fail("sparse data must not be in a buffer view with a byteStride");
    const std::uint64_t offset = offsetOf(part);
    checkAlignment(part, offset, view.offset, componentSize);
    checkEnd(part, offset + overrides * elementSize, view);
  };
  check(indices, componentBytes(type), componentBytes(type));
  check(sparse.at("values"), layout.componentBytes, layout.packedBytes());
}

void checkMatrixAlignment(const JsonView& accessor, const ElementLayout& layout, std::uint64_t offset) {
  if (layout.columns > 1 && offset % 4 != 0)
    accessor.fail("matrix columns must begin at multiples of 4 bytes, byteOffset is " +
                  std::to_string(offset));
}

void checkAccessor(const JsonView& accessor, const Views& views) {
  const JsonView typeOfComponent = accessor.at("componentType");
  const std::int64_t type = typeOfComponent.integer(0, 65535);
  if (componentBytes(type) == 0)
    typeOfComponent.fail("must be 5120, 5121, 5122, 5123, 5125 or 5126, is " + std::to_string(type));
  const JsonView shape = accessor.at("type");
  const ElementLayout layout = elementLayout(type, shape.text());
  if (layout.rows == 0) shape.fail("\"" + shape.text() + "\" must be SCALAR, VEC2 ... VEC4 or MAT2 ... MAT4");
  const std::int64_t count = accessor.at("count").integer(1, kMaximumCount);
  if (const auto normalised = accessor.find("normalized"); normalised && normalised->boolean())
    if (isFloatComponent(type) || type == kUnsignedInt)
      normalised->fail("only 8-bit and 16-bit integers can be normalised");
  for (const char* bound : {"min", "max"})
    if (const auto values = accessor.find(bound)) values->numbers(layout.components());
  if (const auto sparse = accessor.find("sparse")) checkSparse(*sparse, views, layout, count);
  const auto index = accessor.find("bufferView");
  if (!index) {
    if (accessor.has("byteOffset")) accessor.at("byteOffset").fail("must not be given without a bufferView");
    return;
  }
  const View view = views.referredBy(*index);
  const std::uint64_t offset = offsetOf(accessor);
  checkAlignment(accessor, offset, view.offset, layout.componentBytes);
  checkMatrixAlignment(accessor, layout, offset);
  if (view.stride && view.stride < layout.bytes())
    accessor.fail("an element of " + std::to_string(layout.bytes()) +
                  " bytes is longer than the byteStride " + std::to_string(view.stride) +
                  " of its buffer view");
  if (view.stride % layout.componentBytes != 0)
    accessor.fail("the byteStride " + std::to_string(view.stride) +
                  " of its buffer view must be a multiple of " + std::to_string(layout.componentBytes));
  const std::uint64_t stride = view.stride ? view.stride : layout.packedBytes();
  checkEnd(accessor, offset + stride * std::uint64_t(count - 1) + layout.bytes(), view);
}

void checkBufferView(const JsonView& view, const std::vector<std::uint64_t>& bufferLengths) {
  const std::uint64_t bufferLength = bufferLengths[view.at("buffer").index(bufferLengths.size(), "buffers")];
  const std::uint64_t offset = offsetOf(view);
  const auto length = std::uint64_t(view.at("byteLength").integer(1, kMaximumOffset));
  if (offset + length > bufferLength)
    view.fail("bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
              " reach past its buffer of " + std::to_string(bufferLength) + " bytes");
  if (const auto stride = view.find("byteStride")) {
    const std::int64_t bytes = stride->integer(4, 252);
    if (bytes % 4 != 0) stride->fail("must be a multiple of 4, is " + std::to_string(bytes));
    if (std::uint64_t(bytes) > length)
      stride->fail(std::to_string(bytes) + " is more than the buffer view's " + std::to_string(length) +
                   " bytes");
  }
  if (const auto target = view.find("target")) target->integer(34962, 34963);
}

}  // namespace

bool hasStride(const JsonView& accessor, const std::vector<JsonView>& views) {
  const auto view = accessor.find("bufferView");
  return view && views[view->index(views.size(), "bufferViews")].has("byteStride");
}

void checkBuffers(const JsonView& root) {
  std::vector<std::uint64_t> lengths;
  for (const JsonView& buffer : root.items("buffers")) {
    lengths.push_back(std::uint64_t(buffer.at("byteLength").integer(1, kMaximumOffset)));
    if (const auto uri = buffer.find("uri")) uri->text();
  }
  for (const JsonView& view : root.items("bufferViews")) checkBufferView(view, lengths);
}

void checkAccessors(const JsonView& root) {
  const Views views(root);
  for (const JsonView& accessor : root.items("accessors")) checkAccessor(accessor, views);
}

}  // namespace vasa::gltf
