#include "io/vtp_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace vasa::vtp {
namespace {

constexpr std::size_t kMostDeflated = 1100;  // zlib cannot make anything smaller than one part in 1032

template <class T>
T load(const std::byte* at, bool bigEndian) {
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (bigEndian) std::ranges::reverse(bytes);
  return std::bit_cast<T>(bytes);
}

// Lengths in front of a block.
class Header {
 public:
  Header(std::span<const std::byte> block, const Encoding& encoding) : rest_(block), encoding_(encoding) {}
  std::optional<std::uint64_t> next() {
    const std::size_t size = encoding_.wideHeader ? 8 : 4;
    if (rest_.size() < size) return std::nullopt;
    const std::uint64_t value = encoding_.wideHeader ? load<std::uint64_t>(rest_.data(), encoding_.bigEndian)
                                                     : load<std::uint32_t>(rest_.data(), encoding_.bigEndian);
    rest_ = rest_.subspan(size);
    return value;
  }
  std::span<const std::byte> rest() const { return rest_; }

 private:
  std::span<const std::byte> rest_;
  Encoding encoding_;
};

// What stands in front of compressed pieces.
struct Pieces {
  std::vector<std::uint64_t> packed;  // bytes of each
  std::uint64_t size = 0, lastSize = 0, total = 0;
  std::span<const std::byte> data;
};

std::optional<Pieces> piecesOf(Header header, std::string& fault) {
  Pieces pieces;
  const auto count = header.next(), size = header.next(), lastSize = header.next();
  if (!count || !size || !lastSize) return fault = "is cut short", std::nullopt;
  if (*count > header.rest().size())
    return fault = "promises more compressed pieces than it holds", std::nullopt;
  pieces.size = *size, pieces.lastSize = *lastSize;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const auto length = header.next();
    if (!length) return fault = "is cut short", std::nullopt;
    pieces.packed.push_back(*length);
  }
  pieces.data = header.rest();
  std::uint64_t before = 0;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const std::uint64_t whole = i + 1 == *count && *lastSize > 0 ? *lastSize : *size;
    if (pieces.packed[i] > pieces.data.size() - before) return fault = "is cut short", std::nullopt;
    if (whole > pieces.packed[i] * kMostDeflated)
      return fault = "promises more data than it can hold", std::nullopt;
    before += pieces.packed[i];
    pieces.total += whole;
  }
  return pieces;
}

std::optional<std::vector<std::byte>> inflate(const Pieces& pieces, std::string& fault) {
  std::vector<std::byte> content(pieces.total);
  std::span<const std::byte> data = pieces.data;
  std::size_t at = 0;
  for (std::size_t i = 0; i < pieces.packed.size(); ++i) {
    const std::uint64_t whole =
        i + 1 == pieces.packed.size() && pieces.lastSize > 0 ? pieces.lastSize : pieces.size;
    uLongf written = uLongf(whole);
    // zlib refuses a null target even for nothing.
    Bytef nothing = 0;
    Bytef* target = whole > 0 ? reinterpret_cast<Bytef*>(content.data() + at) : &nothing;
    if (uncompress(target, &written, reinterpret_cast<const Bytef*>(data.data()), uLong(pieces.packed[i])) !=
            Z_OK ||
        written != whole)
      return fault = "does not decompress", std::nullopt;
    data = data.subspan(pieces.packed[i]);
    at += whole;
  }
  return content;
}

}  // namespace

std::optional<Scalar> scalarNamed(std::string_view name) {
  static constexpr std::array<std::string_view, 10> kNames{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                           "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return Scalar(found - kNames.begin());
}

std::size_t sizeOf(Scalar scalar) {
  static constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[std::size_t(scalar)];
}

std::optional<std::uint64_t> contentBytes(std::span<const std::byte> block, const Encoding& encoding,
                                          std::string& fault) {
  Header header(block, encoding);
  if (encoding.zlib) {
    const auto pieces = piecesOf(header, fault);
    return pieces ? std::optional(pieces->total) : std::nullopt;
  }
  const auto length = header.next();
  if (!length || *length > header.rest().size()) return fault = "is cut short", std::nullopt;
  return length;
}

std::optional<std::vector<std::byte>> unpack(std::span<const std::byte> block, const Encoding& encoding,
                                             std::string& fault) {
  Header header(block, encoding);
  if (encoding.zlib) {
    const auto pieces = piecesOf(header, fault);
    return pieces ? inflate(*pieces, fault) : std::nullopt;
  }
  const auto length = header.next();
  if (!length || *length > header.rest().size()) return fault = "is cut short", std::nullopt;
  const auto content = header.rest().first(*length);
  return std::vector<std::byte>(content.begin(), content.end());
}

double numberAt(const std::byte* at, Scalar scalar, bool bigEndian) {
  switch (scalar) {
    case Scalar::int8:
      return load<std::int8_t>(at, bigEndian);
    case Scalar::uint8:
      return load<std::uint8_t>(at, bigEndian);
    case Scalar::int16:
      return load<std::int16_t>(at, bigEndian);
    case Scalar::uint16:
      return load<std::uint16_t>(at, bigEndian);
    case Scalar::int32:
      return load<std::int32_t>(at, bigEndian);
    case Scalar::uint32:
      return load<std::uint32_t>(at, bigEndian);
    case Scalar::int64:
      return double(load<std::int64_t>(at, bigEndian));
    case Scalar::uint64:
      return double(load<std::uint64_t>(at, bigEndian));
    case Scalar::float32:
      return double(load<float>(at, bigEndian));
    case Scalar::float64:
      break;
  }
  return load<double>(at, bigEndian);
}

}  // namespace vasa::vtp
