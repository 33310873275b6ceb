#pragma once
#include <string>
#include <string_view>

namespace vasa {

/// Text that others wrote (names in files, names of files) for a line on a terminal: what would steer the
/// terminal, end the line or turn its direction stands there in words, as \n, \x1b or \u202e; so do bytes
/// that are no UTF-8. JSON stays JSON.
std::string visible(std::string_view text);

/// The same for text of several lines: line ends and tabs stay.
std::string visibleLines(std::string_view text);

}  // namespace vasa
