#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace vasa {

/// A character of a text.
struct Utf8Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: these are no UTF-8
};

/// The first character of a text that is not empty, by RFC 3629: no longer than needed, no surrogates,
/// nothing past U+10FFFF.
Utf8Character utf8At(std::string_view text);

/// Whether all of it is UTF-8; ASCII is.
bool isUtf8(std::string_view text);

/// The UTF-8 of a text in Windows' code page 1252, of which Latin-1 is a part.
std::string utf8FromWindows(std::string_view text);

}  // namespace vasa
