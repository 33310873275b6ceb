#pragma once
#include <algorithm>
#include <string>
#include <string_view>

namespace vasa {

/// A letter of ASCII without its capital; all other bytes stay, those of UTF-8 too, whatever the locale.
constexpr char lowerCase(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = lowerCase(c);
  return lower;
}

/// Whether two words are the same but for capitals.
inline bool sameLetters(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lowerCase(x) == lowerCase(y); });
}

}  // namespace vasa
