#pragma once
#include <string>
#include <string_view>

namespace vasa::cli {

/// The style sheet of the pages that commands write: tables, figures, print.
extern const char* const kPageStyle;

/// A text as HTML shows it.
std::string escaped(std::string_view text);

}  // namespace vasa::cli
