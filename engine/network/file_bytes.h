#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

// What .vasa files are written and read with.
namespace vasa {

static_assert(std::endian::native == std::endian::little);
/// That a name may share with the one before: bounds what a file expands to.
constexpr std::size_t kMaximumText = 4096;
/// Steps of a quantised coordinate, on 16 bits.
constexpr float kGridSteps = 65535;

/// Little-endian; counts as LEB128, texts as their length and bytes.
class PortableWriter {
 public:
  template <class T>
  void raw(T value) {
    append(std::as_bytes(std::span(&value, 1)));
  }
  void number(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) raw(std::uint8_t(value | 0x80));
    raw(std::uint8_t(value));
  }
  void text(const std::string& value) {
    number(value.size());
    append(std::as_bytes(std::span(value)));
  }
  /// The length of what is shared with the text before, and the rest: branches of one vessel have names
  /// alike.
  void text(const std::string& value, const std::string& before) {
    const auto ends = std::mismatch(value.begin(), value.end(), before.begin(), before.end());
    const auto shared = std::min(std::size_t(ends.first - value.begin()), kMaximumText);
    number(shared);
    text(value.substr(shared));
  }
  void chunk(const char (&tag)[5], const PortableWriter& payload) {
    for (int i = 0; i < 4; ++i) raw(tag[i]);
    raw(std::uint32_t(payload.bytes.size()));
    append(payload.bytes);
  }
  void append(std::span<const std::byte> more) {
    if (more.empty()) return;
    const std::size_t at = bytes.size();
    bytes.resize(at + more.size());
    std::memcpy(bytes.data() + at, more.data(), more.size());
  }
  std::vector<std::byte> bytes;
};

/// Every read is checked; after a fault everything reads as zero and ok() is false.
class PortableReader {
 public:
  explicit PortableReader(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <class T>
  T raw() {
    T value{};
    const auto from = take(sizeof(T));
    if (ok_) std::memcpy(&value, from.data(), sizeof(T));
    return value;
  }
  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      const auto byte = raw<std::uint8_t>();
      value |= std::uint64_t(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    ok_ = false;
    return 0;
  }
  /// A count of things that take at least minimumBytes each: more than can follow is a fault.
  std::size_t count(std::size_t minimumBytes) {
    const std::uint64_t value = number();
    if (value > rest_.size() / minimumBytes) ok_ = false;
    return ok_ ? std::size_t(value) : 0;
  }
  std::string text() {
    const auto from = take(number());
    return {reinterpret_cast<const char*>(from.data()), from.size()};
  }
  std::string text(const std::string& before) {
    const std::uint64_t shared = number();
    if (shared > before.size() || shared > kMaximumText) ok_ = false;
    if (!ok_) return {};
    return before.substr(0, std::size_t(shared)) + text();
  }
  std::span<const std::byte> take(std::uint64_t size) {
    if (size > rest_.size()) ok_ = false;
    if (!ok_) return {};
    const auto part = rest_.first(std::size_t(size));
    rest_ = rest_.subspan(std::size_t(size));
    return part;
  }
  bool ok() const { return ok_; }
  bool empty() const { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

}  // namespace vasa
