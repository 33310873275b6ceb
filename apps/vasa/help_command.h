#pragma once
#include "commands.h"

namespace vasa::cli {

/// `vasa help`. Comes after all other commands, for it explains what they declare.
void addHelp(CLI::App& app, Command& command);

}  // namespace vasa::cli
