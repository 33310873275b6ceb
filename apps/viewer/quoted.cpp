#include "viewer/quoted.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace vasa::viewer {
namespace {

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

bool isPlain(const std::string& name) {
  return !name.empty() && name.front() != '"' && name.front() != ' ' && name.back() != ' ' &&
         std::ranges::none_of(name, isControl);
}

}  // namespace

std::string quotedName(const std::string& name) {
  if (isPlain(name)) return name;
  std::string out = "\"";
  for (const char c : name) {
    char hex[8];
    std::snprintf(hex, sizeof hex, "\\x%02x", unsigned(static_cast<unsigned char>(c)));
    if (isControl(c))
      out += hex;
    else if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out + "\"";
}

std::optional<std::string> unquotedName(std::string_view text) {
  if (!text.starts_with('"')) return std::string(text);
  if (text.size() < 2 || !text.ends_with('"')) return std::nullopt;
  text = text.substr(1, text.size() - 2);
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') return std::nullopt;
    if (text[i] != '\\') {
      out += text[i];
      continue;
    }
    const std::string_view after = text.substr(i + 1);
    unsigned byte = 0;
    if (after.starts_with('"') || after.starts_with('\\')) {
      out += after[0];
      i += 1;
    } else if (after.size() >= 3 && after[0] == 'x' &&
               std::from_chars(after.data() + 1, after.data() + 3, byte, 16).ptr == after.data() + 3) {
      out += char(byte);
      i += 3;
    } else {
      return std::nullopt;
    }
  }
  return out;
}

}  // namespace vasa::viewer
