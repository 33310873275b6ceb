#include "command_text.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <sstream>

namespace vasa::cli {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void readProse(const std::string& text, CommandText& out, std::string* description) {
  for (const std::string& line : linesOf(text)) {
    if (line == "Examples:" || line.empty()) continue;
    if (line.starts_with("  "))
      out.examples.push_back(line.substr(2));
    else if (description && description->empty())
      *description = line;
    else
      out.notes.push_back(line);
  }
}

// CLI11 writes a type as TEXT, TEXT:{a,b} or FLOAT:FLOAT in [0 - 1].
void readType(const std::string& type, OptionText& out) {
  const auto colon = type.find(':');
  out.value = type.substr(0, colon);
  if (colon == std::string::npos || type.compare(colon + 1, 1, "{") != 0) return;
  std::istringstream list(type.substr(colon + 2, type.find('}') - colon - 2));
  for (std::string choice; std::getline(list, choice, ',');) out.choices.push_back(choice);
}

OptionText describeOption(const CLI::Option& option) {
  OptionText out;
  out.positional = option.get_positional();
  if (out.positional) {
    out.names = {option.get_name(true, false)};
  } else {
    for (const auto& name : option.get_snames()) out.names.push_back("-" + name);
    for (const auto& name : option.get_lnames()) out.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) readType(option.get_type_name(), out);
  out.standard = option.get_default_str();
  out.description = option.get_description();
  out.required = option.get_required();
  out.repeated = option.get_expected_max() > 1;
  return out;
}

CommandText describeBelow(const CLI::App& app, std::vector<std::string> path) {
  CommandText out;
  path.push_back(app.get_name());
  out.path = std::move(path);
  readProse(app.get_description(), out, &out.description);
  readProse(app.get_footer(), out, nullptr);
  for (const CLI::Option* option : app.get_options()) out.options.push_back(describeOption(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    out.commands.push_back(describeBelow(*command, out.path));
  return out;
}

}  // namespace

std::string joined(const std::vector<std::string>& parts, std::string_view between) {
  return fmt::format("{}", fmt::join(parts, between));
}

CommandText describe(const CLI::App& app) { return describeBelow(app, {}); }

}  // namespace vasa::cli
