#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace vasa::cli {

/// What a command line that cannot be parsed says: a word that is no command, or no option of its command,
/// with what was likely meant; anything else in the parser's own words.
/// @param app  after parse() has thrown
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error);

/// Why a command must not be run as it was given: a file that it reads is also the one that it would write.
/// Empty where none is. What a scene file names is not looked at here.
/// @param app  parsed
std::string overwritingMessage(const CLI::App& app);

}  // namespace vasa::cli
