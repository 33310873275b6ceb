#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>

#include "core/result.h"

namespace vasa::cli {

using Report = nlohmann::ordered_json;

/// Thrown where the reader of a pipe on standard output has gone: what is left to print nobody wants.
struct ReaderGone {};

/// Prints a report on standard output, indented, with a line end; fails with io when it cannot be written.
Result<void> printJson(const Report& report);

/// The same for lines of text. What could steer a terminal is shown in words (core/visible.h); names go
/// through visible() or plainText() before, so that they end no line.
Result<void> printText(const std::string& text);

/// The same for bytes as they are.
Result<void> printBytes(std::span<const std::byte> bytes);

/// A path as a shell takes it for one argument: in quotes where it has more than letters, digits and
/// ./_-+,:@%=.
std::string asArgument(const std::string& path);

/// A value for people: text made visible, numbers to six digits.
std::string plainText(const Report& value);

}  // namespace vasa::cli
