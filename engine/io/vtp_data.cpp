#include "io/vtp_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace vasa::vtp {
namespace {

constexpr std::size_t kMaximumContent = std::size_t(1) << 30;
constexpr std::size_t kMostDeflated = 1100;  // zlib cannot make anything smaller than one part in 1032

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<signed char, 256> kDigits = [] {
  std::array<signed char, 256> digits{};
  digits.fill(-1);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i) digits[std::size_t(kAlphabet[i])] = static_cast<signed char>(i);
  return digits;
}();

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

std::optional<std::vector<std::byte>> inflateBlocks(Header header, std::string& fault) {
  const auto count = header.next(), size = header.next(), lastSize = header.next();
  if (!count || !size || !lastSize) return fault = "is cut short", std::nullopt;
  if (*count > header.rest().size()) return fault = "promises more compressed pieces than it holds", std::nullopt;
  std::vector<std::uint64_t> packed;
  for (std::uint64_t i = 0; i < *count; ++i) {
    const auto length = header.next();
    if (!length) return fault = "is cut short", std::nullopt;
    packed.push_back(*length);
  }
  std::vector<std::byte> content;
  std::span<const std::byte> data = header.rest();
  for (std::uint64_t i = 0; i < *count; ++i) {
    const std::uint64_t whole = i + 1 == *count && *lastSize > 0 ? *lastSize : *size;
    if (packed[i] > data.size()) return fault = "is cut short", std::nullopt;
    if (whole > packed[i] * kMostDeflated || whole > kMaximumContent - content.size())
      return fault = "promises more data than it can hold", std::nullopt;
    const std::size_t before = content.size();
    content.resize(before + whole);
    uLongf written = uLongf(whole);
    // zlib refuses a null target even for nothing.
    Bytef nothing = 0;
    Bytef* target = whole > 0 ? reinterpret_cast<Bytef*>(content.data() + before) : &nothing;
    if (uncompress(target, &written, reinterpret_cast<const Bytef*>(data.data()), uLong(packed[i])) != Z_OK || written != whole)
      return fault = "does not decompress", std::nullopt;
    data = data.subspan(packed[i]);
  }
  return content;
}

template <class T>
std::vector<double> convert(std::span<const std::byte> content, bool bigEndian) {
  std::vector<double> numbers(content.size() / sizeof(T));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = double(load<T>(content.data() + i * sizeof(T), bigEndian));
  return numbers;
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

std::optional<std::vector<std::byte>> decodeBase64(std::string_view text) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0, padding = 0;
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const int digit = c == '=' ? 0 : kDigits[static_cast<unsigned char>(c)];
    if (digit < 0 || (padding > 0 && c != '=')) return std::nullopt;
    padding += c == '=';
    bits = bits << 6 | std::uint32_t(digit);
    if (++count < 4) continue;
    if (padding > 2) return std::nullopt;
    for (int i = 0; i < 3 - padding; ++i) bytes.push_back(std::byte(bits >> (16 - 8 * i)));
    bits = 0, count = 0, padding = 0;
  }
  if (count != 0) return std::nullopt;
  return bytes;
}

std::string encodeBase64(std::span<const std::byte> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < have ? std::uint32_t(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= have ? kAlphabet[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::optional<std::vector<std::byte>> unpack(std::span<const std::byte> block, const Encoding& encoding,
                                             std::string& fault) {
  Header header(block, encoding);
  if (encoding.zlib) return inflateBlocks(header, fault);
  const auto length = header.next();
  if (!length || *length > header.rest().size()) return fault = "is cut short", std::nullopt;
  const auto content = header.rest().first(*length);
  return std::vector<std::byte>(content.begin(), content.end());
}

std::vector<double> numbersOf(std::span<const std::byte> content, Scalar scalar, bool bigEndian) {
  switch (scalar) {
    case Scalar::int8: return convert<std::int8_t>(content, bigEndian);
    case Scalar::uint8: return convert<std::uint8_t>(content, bigEndian);
    case Scalar::int16: return convert<std::int16_t>(content, bigEndian);
    case Scalar::uint16: return convert<std::uint16_t>(content, bigEndian);
    case Scalar::int32: return convert<std::int32_t>(content, bigEndian);
    case Scalar::uint32: return convert<std::uint32_t>(content, bigEndian);
    case Scalar::int64: return convert<std::int64_t>(content, bigEndian);
    case Scalar::uint64: return convert<std::uint64_t>(content, bigEndian);
    case Scalar::float32: return convert<float>(content, bigEndian);
    case Scalar::float64: break;
  }
  return convert<double>(content, bigEndian);
}

}  // namespace vasa::vtp
