#include "core/visible.h"

#include <cstdint>
#include <cstdio>

namespace vasa {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  // 0: these are no UTF-8
};

// UTF-8 as RFC 3629 has it: no longer than needed, no surrogates, nothing past U+10FFFF.
Character characterAt(std::string_view text) {
  const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  const bool tooLong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  if (tooLong || (code >= 0xd800 && code < 0xe000) || code > 0x10ffff) return {};
  return {code, bytes};
}

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
    const Character next = characterAt(text);
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
