#include "growth/rule_text.h"

#include <charconv>
#include <cmath>

namespace vasa {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool standsAlone(char c) { return c == '[' || c == ']'; }

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < line.size();) {
    if (isBlank(line[i])) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    if (!standsAlone(line[i]))
      while (end < line.size() && !isBlank(line[end]) && !standsAlone(line[end])) ++end;
    words.push_back(line.substr(i, end - i));
    i = end;
  }
  return words;
}

}  // namespace

std::vector<RuleLine> ruleLines(std::string_view text) {
  std::vector<RuleLine> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    line = line.substr(0, line.find('#'));
    if (auto words = wordsOf(line); !words.empty()) lines.push_back({number, std::move(words)});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::optional<float> numberIn(std::string_view word) {
  float value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return {};
  return value;
}

Error ruleFault(const std::string& file, std::size_t line, const std::string& what) {
  return badInput(file + ":" + std::to_string(line) + ": " + what);
}

}  // namespace vasa
