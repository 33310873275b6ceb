#pragma once
#include <CLI/CLI.hpp>

namespace vasa::cli {

/// For check() of an option: CLI11's own PositiveNumber tells the largest number that there is, in 309
/// digits.
inline CLI::Validator aboveZero() {
  const auto refusal = [](const std::string& text) {
    double value = 0;
    return CLI::detail::lexical_cast(text, value) && value > 0 ? std::string() : text + ": must be above 0";
  };
  return {refusal, "POSITIVE"};
}

}  // namespace vasa::cli
