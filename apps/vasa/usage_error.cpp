#include "usage_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>

#include "core/nearest_names.h"

namespace vasa::cli {
namespace {

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

void addOptionsOf(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
}

/// The innermost command that was understood, and its name with those above it.
std::pair<const CLI::App*, std::string> understood(const CLI::App& app) {
  const CLI::App* command = &app;
  std::string name = app.get_name();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += " " + command->get_name();
  }
  return {command, name};
}

}  // namespace

std::string usageMessage(const CLI::App& app, const CLI::ParseError& error) {
  std::vector<std::string> unknown = app.remaining(true);
  std::erase(unknown, "--");  // what only divides options from files
  const auto [command, name] = understood(app);
  if (unknown.empty()) {
    const auto commands = commandsOf(*command);
    if (!commands.empty() && dynamic_cast<const CLI::RequiredError*>(&error))
      return command == &app ? "give a command; vasa help lists commands and topics"
                             : fmt::format("{} needs a command: {}", name, fmt::join(commands, ", "));
    return std::string(error.what()) + "; " + name + " --help lists what there is";
  }
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  std::vector<std::string> names;
  if (word.starts_with("-")) {
    addOptionsOf(*command, names);
    if (command != &app) addOptionsOf(app, names);
    return fmt::format("{} has no option {}; {}", name, word,
                       didYouMean(word, names, name + " --help lists them"));
  }
  names = commandsOf(*command);
  if (!names.empty())
    return fmt::format(
        "'{}' is no command of {}; {}", word, name,
        didYouMean(word, names, name == "vasa" ? "vasa help lists them" : name + " --help lists them"));
  return fmt::format("{} does not know what to do with '{}'; {} --help lists what it takes", name, word,
                     name);
}

std::string overwritingMessage(const CLI::App& app) {
  const CLI::App* const command = understood(app).first;
  // A joint map that is read and written is carried on.
  const auto holds = [](const CLI::Option* option, std::initializer_list<const char*> names) {
    return std::ranges::any_of(names, [&](const char* name) { return option->check_lname(name); });
  };
  const auto isOutput = [&](const CLI::Option* option) {
    return holds(option, {"output", "pairs", "video"});
  };
  const auto isInput = [&](const CLI::Option* option) {
    return !isOutput(option) && !holds(option, {"title", "joint-map", "track"});
  };
  std::error_code ignored;
  for (const CLI::Option* to : command->get_options(isOutput))
    for (const std::string& output : to->results()) {
      if (!std::filesystem::is_regular_file(output, ignored)) continue;
      for (const CLI::Option* from : command->get_options(isInput))
        for (const std::string& input : from->results())
          if (std::filesystem::equivalent(input, output, ignored))
            return output + ": is read, too, and would be written over; give the result another name";
    }
  return {};
}

}  // namespace vasa::cli
