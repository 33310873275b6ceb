#include "core/name_words.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/letters.h"

namespace vasa {
namespace {

enum class Kind { other, digit, small, capital };
Kind kindOf(char c) {
  if (c >= '0' && c <= '9') return Kind::digit;
  if (c >= 'a' && c <= 'z') return Kind::small;
  return c >= 'A' && c <= 'Z' ? Kind::capital : Kind::other;
}

// What stands for the character that begins a text, and how many bytes that is: 0 for a mark over the letter
// before, a space for what is no letter.
struct Plain {
  char letter;
  std::size_t bytes;
};
Plain plainStart(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : std::uint8_t(0);
  };
  if (byte(0) < 0x80) return {kindOf(text[0]) == Kind::other ? ' ' : text[0], 1};
  if (byte(1) < 0x80 || byte(1) >= 0xc0) return {' ', 1};
  if (byte(0) == 0xc3) {  // U+00C0 to U+00FF
    static constexpr std::string_view kLetters =
        "AAAAAAACEEEEIIIIDNOOOOO OUUUUYTsaaaaaaaceeeeiiiidnooooo ouuuuyty";
    return {kLetters[byte(1) - 0x80u], 2};
  }
  if (byte(0) == 0xc5 && (byte(1) & 0xfeu) == 0x92) return {byte(1) == 0x92 ? 'E' : 'e', 2};  // OE: celiaque
  if ((byte(0) == 0xc2 && byte(1) == 0xb5) || (byte(0) == 0xce && byte(1) == 0xbc)) return {'u', 2};
  if (byte(0) == 0xcc || (byte(0) == 0xcd && byte(1) < 0xb0)) return {'\0', 2};  // U+0300 to U+036F
  return {' ', 1};
}

}  // namespace

std::vector<std::string> nameWords(std::string_view name) {
  std::string letters;
  while (!name.empty()) {
    const Plain plain = plainStart(name);
    if (plain.letter != '\0') letters += plain.letter;
    name.remove_prefix(plain.bytes);
  }
  std::vector<std::string> words;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const auto kind = [&](std::size_t k) { return k < letters.size() ? kindOf(letters[k]) : Kind::other; };
    const Kind own = kind(i), before = i > 0 ? kind(i - 1) : Kind::other;
    if (own == Kind::other) continue;
    const bool begins = own != before && !(before == Kind::capital && own == Kind::small);
    const bool lastCapital = own == Kind::capital && before == Kind::capital && kind(i + 1) == Kind::small;
    if (begins || lastCapital) words.emplace_back();
    words.back() += lowerCase(letters[i]);
  }
  return words;
}

NamedSide sideNamed(std::string_view name) {
  static constexpr std::array<std::string_view, 9> kLeft{"left",   "sinist",  "links", "linke", "gauche",
                                                         "izquie", "esquerd", "lft",   "lt"},
      kRight{"right", "dext", "rechts", "rechte", "droit", "derech", "direit", "destr", "rt"};
  // Last in a name alone: "sin contraste" is without any, and Dx a diagnosis.
  static constexpr std::array<std::string_view, 3> kLastLeft{"l", "sin", "sx"}, kLastRight{"r", "dex", "dx"};
  bool left = name.find("左") != name.npos, right = name.find("右") != name.npos;
  std::vector<std::string> words = nameWords(name);
  // Those of up to three letters are words, the others begin some.
  const auto begins = [&](const std::string& word, const auto& signs) {
    return std::ranges::any_of(signs, [&](std::string_view sign) {
      return sign.size() > 3 ? word.starts_with(sign) : word == sign;
    });
  };
  for (const std::string& word : words) left |= begins(word, kLeft), right |= begins(word, kRight);
  while (!words.empty() && words.back()[0] >= '0' && words.back()[0] <= '9') words.pop_back();
  if (!words.empty() && !left && !right)
    left = begins(words.back(), kLastLeft), right = begins(words.back(), kLastRight);
  if (left == right) return NamedSide::none;
  return left ? NamedSide::left : NamedSide::right;
}

}  // namespace vasa
