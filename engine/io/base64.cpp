#include "io/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace vasa {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<signed char, 256> kDigits = [] {
  std::array<signed char, 256> digits{};
  digits.fill(-1);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    digits[static_cast<unsigned char>(kAlphabet[i])] = static_cast<signed char>(i);
  return digits;
}();

}  // namespace

std::optional<std::vector<std::byte>> decodeBase64(std::string_view text, std::size_t atMost) {
  std::vector<std::byte> bytes;
  bytes.reserve(std::min(text.size() / 4 * 3, atMost) + 2);
  std::uint32_t bits = 0;
  int count = 0, padding = 0;
  for (const char c : text) {
    if (bytes.size() >= atMost) return bytes;
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

}  // namespace vasa
