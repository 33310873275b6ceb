#include "core/visible.h"

#include <cstdint>
#include <cstdio>

#include "core/utf8.h"

namespace vasa {
namespace {

bool steers(std::uint32_t code) {
  const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool lineEnd = code == 0x2028 || code == 0x2029;
  const bool direction = code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) ||
                         (code >= 0x2066 && code <= 0x2069);
  return control || lineEnd || direction;
}

std::string inWords(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  if (code == '\t') return "\\t";
  char words[8];
  std::snprintf(words, sizeof words, code < 0x20 ? "\\x%02x" : "\\u%04x", unsigned(code));
  return words;
}

std::string shown(std::string_view text, std::string_view kept) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character next = utf8At(text);
    if (next.bytes == 0) {
      char words[8];
      std::snprintf(words, sizeof words, "\\x%02x", unsigned(static_cast<unsigned char>(text[0])));
      out += words;
    } else if (steers(next.code) && kept.find(text[0]) == std::string_view::npos) {
      out += inWords(next.code);
    } else {
      out += text.substr(0, next.bytes);
    }
    text.remove_prefix(next.bytes ? next.bytes : 1);
  }
  return out;
}

}  // namespace

std::string visible(std::string_view text) { return shown(text, ""); }

std::string visibleLines(std::string_view text) { return shown(text, "\n\t"); }

}  // namespace vasa
