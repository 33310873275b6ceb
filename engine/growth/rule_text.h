#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace vasa {

/// One line of a rule file, cut into words at blanks; a bracket is a word of its own. `#` starts a comment.
struct RuleLine {
  std::size_t number = 0;  ///< from 1
  std::vector<std::string_view> words;
};

/// The lines that hold words. The text must outlive them.
std::vector<RuleLine> ruleLines(std::string_view text);

std::optional<float> numberIn(std::string_view word);

/// A message about a place in a file.
Error ruleFault(const std::string& file, std::size_t line, const std::string& what);

}  // namespace vasa
