#include "core/utf8.h"

#include <algorithm>
#include <array>

namespace vasa {
namespace {

unsigned byteOf(char character) { return static_cast<unsigned char>(character); }

bool isAscii(char character) { return byteOf(character) < 0x80; }

// Of bytes 0x80 to 0x9f; those that mean nothing keep their number.
constexpr std::array<char16_t, 32> kWindows{0x20ac, 0x81,   0x201a, 0x192,  0x201e, 0x2026, 0x2020, 0x2021,
                                            0x2c6,  0x2030, 0x160,  0x2039, 0x152,  0x8d,   0x17d,  0x8f,
                                            0x90,   0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
                                            0x2dc,  0x2122, 0x161,  0x203a, 0x153,  0x9d,   0x17e,  0x178};

}  // namespace

Utf8Character utf8At(std::string_view text) {
  const std::uint32_t lead = byteOf(text[0]);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byteOf(text[i]) & 0xc0) != 0x80) return {};
    code = code << 6 | (byteOf(text[i]) & 0x3f);
  }
  const bool tooLong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  if (tooLong || (code >= 0xd800 && code < 0xe000) || code > 0x10ffff) return {};
  return {code, bytes};
}

bool isUtf8(std::string_view text) {
  for (auto at = text.begin(); (at = std::find_if_not(at, text.end(), isAscii)) != text.end();) {
    const std::size_t bytes = utf8At({at, text.end()}).bytes;
    if (bytes == 0) return false;
    at += std::ptrdiff_t(bytes);
  }
  return true;
}

std::string utf8FromWindows(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  for (const char character : text) {
    const unsigned byte = byteOf(character),
                   code = byte >= 0x80 && byte < 0xa0 ? kWindows[byte - 0x80] : byte;
    if (code < 0x80) {
      out += character;
    } else if (code < 0x800) {
      out += char(0xc0 | code >> 6);
      out += char(0x80 | (code & 0x3f));
    } else {
      out += char(0xe0 | code >> 12);
      out += char(0x80 | (code >> 6 & 0x3f));
      out += char(0x80 | (code & 0x3f));
    }
  }
  return out;
}

}  // namespace vasa
