#pragma once
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

namespace vasa::test {

/// Damages files at random, the same way for the same seed.
class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  /// One to four changes: a bit, a byte, a digit, a word of extreme value, a cut, or a copied stretch.
  std::string mutated(std::string bytes) {
    for (std::size_t changes = 1 + pick(4); changes > 0; --changes) mutate(bytes);
    return bytes;
  }

 private:
  std::size_t pick(std::size_t below) { return below ? random_() % below : 0; }

  void mutate(std::string& bytes) {
    if (bytes.size() < 32) return;
    const std::size_t at = pick(bytes.size() - 4);
    constexpr std::uint32_t extremes[] = {0,          1,          0x7f800000, 0x7fc00000,
                                          0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffc};
    switch (pick(8)) {
      case 0:
        bytes[at] = char(bytes[at] ^ (1 << pick(8)));
        break;
      case 1:
        bytes[at] = char(random_());
        break;
      case 2:
      case 3:
      case 4:
        changeDigit(bytes, at);
        break;
      case 5:
        std::memcpy(bytes.data() + at, &extremes[pick(8)], 4);
        break;
      case 6:
        bytes.resize(at);
        break;
      default:
        bytes.replace(at, std::min<std::size_t>(8, bytes.size() - at), bytes, pick(bytes.size() - 8), 8);
    }
  }

  // Changes a number of the JSON, which bare byte flips rarely leave valid.
  void changeDigit(std::string& bytes, std::size_t from) {
    const std::size_t digit = bytes.find_first_of("0123456789", from);
    if (digit == std::string::npos) return;
    constexpr const char* values[] = {"0", "1", "2", "3", "7", "9", "-", "."};
    bytes.replace(digit, 1, values[pick(8)]);
  }

  std::mt19937 random_;
};

}  // namespace vasa::test
