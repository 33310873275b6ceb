#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"

// What all readers of text ask of a file before they look at its words: UTF-8 (or ASCII), in lines.
namespace vasa {

/// Whether a text is UTF-16: by its byte order mark, or by zeros in every other one of its first bytes.
bool isUtf16(std::string_view text);

/// What a file holds in place of what its name promises, and what to do.
struct OtherContent {
  std::string_view what, remedy;
  std::string text() const { return std::string(what).append("; ").append(remedy); }
};
/// UTF-16, what gzip packed, a pointer of Git LFS, a web page that was saved for the file; nothing where it
/// seems to be itself.
std::optional<OtherContent> otherContent(std::string_view bytes);

/// The text behind a byte order mark, without marks of an end (Ctrl-Z, zeros) where it has no other bytes of
/// numbers. Where no line feed ends a line, carriage returns do (as on old Macs):
/// then line feeds stand in their places, and each line has its number as elsewhere. Lines that are no
/// UTF-8 are taken for those of Windows in the west (code page 1252, Latin-1), unless the text holds numbers
/// as bytes. Fails with badInput where otherContent() tells.
/// @param text  outlives what is returned
/// @param name  for messages
/// @param kept  what is returned lies in it, or in `text`
Result<std::string_view> plainText(std::string_view text, const std::string& name, std::string& kept);

/// A file's text, as plainText() has it. Fails as readFile() (core/atomic_file.h) does and where
/// otherContent() tells. @param most  [bytes]
Result<std::string> readText(const std::filesystem::path& path, std::size_t most = std::size_t(1) << 31);

}  // namespace vasa
