#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace vasa {

/// Values one after the other as they lie in this machine's memory: for files that only this program reads.
class ByteWriter {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto own = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), own.begin(), own.end());
  }
  /// Their number, then the values.
  template <class T>
  void addAll(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(std::uint64_t(values.size()));
    addRaw(std::as_bytes(values));
  }
  void addRaw(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Takes them out again. What it cannot take, since too few bytes are left, it leaves and says false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  bool take(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_.size() < sizeof(T)) return false;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return true;
  }
  template <class T>
  bool takeAll(std::vector<T>& values) {
    std::uint64_t count = 0;
    if (!take(count) || count > bytes_.size() / sizeof(T)) return false;
    values.resize(count);
    if (count) std::memcpy(values.data(), bytes_.data(), count * sizeof(T));
    bytes_ = bytes_.subspan(count * sizeof(T));
    return true;
  }
  std::span<const std::byte> rest() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace vasa
