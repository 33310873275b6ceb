#pragma once
#include <nlohmann/json.hpp>

#include "core/result.h"

namespace vasa::cli {

using Report = nlohmann::ordered_json;

/// Prints a report on standard output, indented, with a line end; fails with io when it cannot be written.
Result<void> printJson(const Report& report);

/// The same for text.
Result<void> printText(const std::string& text);

/// A value for people: text as it is, numbers to six digits.
std::string plainText(const Report& value);

}  // namespace vasa::cli
