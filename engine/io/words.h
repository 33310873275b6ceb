#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

// Plain text taken apart without copying.
namespace vasa {

/// Takes the first word off a line; empty when there is none left.
inline std::string_view nextWord(std::string_view& line, std::string_view blanks = " \t\r") {
  const std::size_t start = line.find_first_not_of(blanks);
  if (start == line.npos) return line = {}, std::string_view{};
  const std::size_t stop = std::min(line.find_first_of(blanks, start), line.size());
  const std::string_view word = line.substr(start, stop - start);
  line.remove_prefix(stop);
  return word;
}

/// Takes the first line off a text, without its line end.
inline std::string_view nextLine(std::string_view& text) {
  const std::size_t stop = text.find('\n');
  const std::string_view line = text.substr(0, stop);
  text.remove_prefix(stop == text.npos ? text.size() : stop + 1);
  return line;
}

/// A whole word as a finite number.
inline bool parseNumber(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  return fault == std::errc{} && stop == word.data() + word.size() && std::isfinite(value);
}

inline bool parseInteger(std::string_view word, std::int64_t& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  return fault == std::errc{} && stop == word.data() + word.size();
}

/// The shortest text that reads as the same number.
inline std::string numberText(double value) {
  char buffer[32];
  const auto written = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, written.ptr};
}

}  // namespace vasa
