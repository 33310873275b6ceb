#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace vasa::viewer {

/// A file's name for the end of a line of a script: as it is where that is read back the same, else in double
/// quotes with
/// \\, \" and \xHH for backslashes, quotes and control characters. So no name ends its line and goes on as
/// another.
std::string quotedName(const std::string& name);

/// What quotedName() was given, from a line's end without the blanks around it; nothing where quotes are not
/// closed or a backslash is followed by something else.
std::optional<std::string> unquotedName(std::string_view text);

}  // namespace vasa::viewer
