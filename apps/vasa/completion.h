#pragma once
#include <string>

#include "command_text.h"

namespace vasa::cli {

/// Scripts that complete commands, options and the few values of an option; where a value is none of a few, a
/// file's name is completed.
std::string bashCompletion(const CommandText& program);
std::string zshCompletion(const CommandText& program);
std::string fishCompletion(const CommandText& program);

}  // namespace vasa::cli
