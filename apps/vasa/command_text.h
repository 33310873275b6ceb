#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace vasa::cli {

std::string joined(const std::vector<std::string>& parts, std::string_view between = " ");

/// An option or positional argument as manuals and shells want it.
struct OptionText {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional its one name, "MESH"
  std::string value;                 ///< what it takes: "TEXT", "UINT"; empty: nothing
  std::vector<std::string> choices;  ///< the values it takes, where they are few
  bool files = false;                ///< beside these it takes files
  std::string standard;              ///< the default; empty: none
  std::string description;
  bool positional = false, required = false, repeated = false;
};

/// A command with all that is known of it.
struct CommandText {
  std::vector<std::string> path;  ///< "vasa", "bench", "collide"
  std::string description;
  std::vector<std::string> examples;  ///< command lines
  std::vector<std::string> notes;     ///< lines
  std::vector<OptionText> options;
  std::vector<CommandText> commands;  ///< below it
};

/// What the declarations say, so that manuals and completions are never older than the program. A command's
/// footer is "Examples:", lines indented by two, then notes; of the program itself the indented lines are in
/// its description.
CommandText describe(const CLI::App& app);

}  // namespace vasa::cli
