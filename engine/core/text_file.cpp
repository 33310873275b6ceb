#include "core/text_file.h"

#include <algorithm>

#include "core/atomic_file.h"
#include "core/letters.h"
#include "core/utf8.h"

namespace vasa {
namespace {

// No text holds it, and numbers among the words (VTK) cannot do without: each count has a zero byte.
bool isBinary(char character) {
  const auto byte = static_cast<unsigned char>(character);
  return byte < 0x20 && !(byte >= '\t' && byte <= '\r') && byte != 0x1a;
}

// Of DOS, and of programs that pad files.
constexpr std::string_view kEndMarks("\0\x1a", 2);

// Line by line: a file that several programs wrote may have both.
std::string utf8ByLines(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
    out += isUtf8(line) ? std::string(line) : utf8FromWindows(line);
    text.remove_prefix(line.size());
  }
  return out;
}

}  // namespace

bool isUtf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
  if (text.size() < 4) return false;
  const auto zeros = [text](std::size_t first) {
    return text[first] == 0 && text[first + 2] == 0 && text[1 - first] != 0 && text[3 - first] != 0;
  };
  return zeros(0) || zeros(1);
}

std::optional<OtherContent> otherContent(std::string_view bytes) {
  if (isUtf16(bytes))
    return OtherContent{"the text is UTF-16", "save it as UTF-8 (in an editor: Save as, encoding UTF-8)"};
  if (bytes.starts_with("\x1f\x8b")) return OtherContent{"it is packed by gzip", "unpack it first"};
  if (bytes.starts_with("version https://git-lfs"))
    return OtherContent{"it is a pointer of Git LFS", "fetch the file that it stands for (git lfs pull)"};
  constexpr std::string_view kPages[] = {"<!doctype html", "<html"};
  const std::string head = lowerCase(bytes.substr(0, 256));
  const std::size_t first = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  for (const std::string_view page : kPages)
    if (std::string_view(head).substr(first).starts_with(page))
      return OtherContent{"it is a web page, saved in place of the file", "download the file itself"};
  return {};
}

Result<std::string_view> plainText(std::string_view text, const std::string& name, std::string& kept) {
  if (const auto other = otherContent(text)) return badInput(name + ": " + other->text());
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (const std::string_view shorter = text.substr(0, text.find_last_not_of(kEndMarks) + 1);
      shorter.size() < text.size() && std::ranges::none_of(shorter, isBinary))
    text = shorter;
  const bool windows = !isUtf8(text) && std::ranges::none_of(text, isBinary),
             oldMac = text.find('\r') != text.npos && text.find('\n') == text.npos;
  if (!windows && !oldMac) return text;
  std::string lines(text);
  if (oldMac) std::ranges::replace(lines, '\r', '\n');
  kept = windows ? utf8ByLines(lines) : std::move(lines);
  return std::string_view(kept);
}

Result<std::string> readText(const std::filesystem::path& path, std::size_t most) {
  const auto bytes = readFile(path, most);
  if (!bytes) return bytes.error();
  std::string kept;
  const auto text =
      plainText({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string(), kept);
  if (!text) return text.error();
  return std::string(*text);
}

}  // namespace vasa
