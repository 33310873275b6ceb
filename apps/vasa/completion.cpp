#include "completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

// The three shells want the same facts in three shapes. A command is known by its path: "/convert",
// "/bench/collide".
namespace vasa::cli {
namespace {

std::string pathOf(const CommandText& command) {
  std::string path;
  for (std::size_t i = 1; i < command.path.size(); ++i) path.append("/").append(command.path[i]);
  return path;
}

void visit(const CommandText& command, const std::function<void(const CommandText&)>& look) {
  look(command);
  for (const auto& below : command.commands) visit(below, look);
}

std::vector<std::string> wordsOf(const CommandText& command, const CommandText& program) {
  std::vector<std::string> words;
  for (const auto& below : command.commands) words.push_back(below.path.back());
  const auto add = [&](const CommandText& from) {
    for (const auto& option : from.options)
      if (!option.positional) words.insert(words.end(), option.names.begin(), option.names.end());
  };
  for (const auto& option : command.options)
    if (option.positional) words.insert(words.end(), option.choices.begin(), option.choices.end());
  add(command);
  if (&command != &program) add(program);
  return words;
}

// Whether the next word may be one of few, not only an option or a file.
bool takesWords(const CommandText& command) {
  const auto few = [](const OptionText& option) { return option.positional && !option.choices.empty(); };
  return !command.commands.empty() || std::ranges::any_of(command.options, few);
}

// Within '...' of any of the three shells.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

// zsh reads [ ] and : in a description.
std::string zshText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':') out += '\\';
    out += c;
  }
  return out;
}

std::vector<std::string> zshArguments(const CommandText& command) {
  std::vector<std::string> out;
  for (const auto& option : command.options) {
    if (option.positional) continue;
    const std::string action =
        option.choices.empty() ? "_files" : fmt::format("({})", joined(option.choices));
    for (const auto& name : option.names)
      out.push_back(
          quoted(fmt::format("{}[{}]{}", name, zshText(option.description),
                             option.value.empty() ? "" : fmt::format(":{}:{}", option.value, action))));
  }
  return out;
}

}  // namespace

std::string bashCompletion(const CommandText& program) {
  std::string paths, values, words, worded = "''";
  visit(program, [&](const CommandText& command) {
    const std::string path = pathOf(command);
    if (!path.empty() && takesWords(command)) worded += " | " + path;
    if (!path.empty()) paths += (paths.empty() ? "" : " | ") + path;
    words += fmt::format("    {}) words={} ;;\n", path.empty() ? "''" : path,
                         quoted(joined(wordsOf(command, program))));
    for (const auto& option : command.options) {
      if (option.positional || option.value.empty()) continue;
      std::string names;
      // An option of the program itself is one of every command.
      for (const auto& name : option.names)
        names += (names.empty() ? "" : " | ") + (path.empty() ? "*" : path) + ":" + name;
      values +=
          option.choices.empty()
              ? fmt::format("    {}) return ;;\n", names)
              : fmt::format("    {}) COMPREPLY=($(compgen -W {} -- \"$cur\"){}); return ;;\n", names,
                            quoted(joined(option.choices)), option.files ? " $(compgen -f -- \"$cur\")" : "");
    }
  });
  return "# bash completion of vasa; written by the program itself (vasa help --write)\n"
         "_vasa() {\n"
         "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command= words= i\n"
         "  COMPREPLY=()\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case $command/${COMP_WORDS[i]} in " +
         paths +
         ") command+=/${COMP_WORDS[i]} ;; esac\n"
         "  done\n"
         "  case $command:$prev in\n" +
         values +
         "  esac\n"
         "  case $command in\n" +
         words +
         "  esac\n"
         "  case $command in\n    " +
         worded +
         ") ;;\n    *) [[ $cur == -* ]] || return ;;\n  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
         "}\n"
         "complete -o default -F _vasa vasa\n";
}

std::string zshCompletion(const CommandText& program) {
  std::string out =
      "#compdef vasa\n# zsh completion of vasa; written by the program itself (vasa help --write)\n"
      "_vasa_commands() {\n  local -a commands=(\n";
  for (const auto& command : program.commands)
    out += "    " + quoted(fmt::format("{}:{}", command.path.back(), zshText(command.description))) + "\n";
  out += "  )\n  _describe command commands\n}\n";
  out += "_vasa() {\n  local state line\n  local -a everywhere=(\n    " +
         joined(zshArguments(program), "\n    ") + "\n  )\n";
  out +=
      "  _arguments -C $everywhere '1: :_vasa_commands' '*:: :->rest'\n  [[ $state == rest ]] || return\n  case $words[1] in\n";
  for (const auto& command : program.commands) {
    std::vector<std::string> own = zshArguments(command);
    std::vector<std::string> names;
    for (const auto& below : command.commands) {
      names.push_back(below.path.back());
      for (auto& argument : zshArguments(below)) own.push_back(argument);
    }
    for (const auto& option : command.options)
      if (option.positional) names.insert(names.end(), option.choices.begin(), option.choices.end());
    own.push_back(names.empty() ? "'*: :_files'" : quoted(fmt::format("1: :({})", joined(names))));
    out += "    " + command.path.back() + ") _arguments $everywhere \\\n      " + joined(own, " \\\n      ") +
           " ;;\n";
  }
  return out + "  esac\n}\n_vasa \"$@\"\n";
}

std::string fishCompletion(const CommandText& program) {
  std::string out = "# fish completion of vasa; written by the program itself (vasa help --write)\n";
  visit(program, [&](const CommandText& command) {
    const bool root = command.path.size() == 1;
    const std::string here =
        root ? "__fish_use_subcommand" : fmt::format("__fish_seen_subcommand_from {}", command.path.back());
    for (const auto& below : command.commands)
      out += fmt::format("complete -c vasa -n {} -f -a {} -d {}\n", quoted(here), below.path.back(),
                         quoted(below.description));
    for (const auto& option : command.options) {
      if (option.positional) {
        if (!option.choices.empty())
          out +=
              fmt::format("complete -c vasa -n {} -f -a {}\n", quoted(here), quoted(joined(option.choices)));
        continue;
      }
      out += root ? std::string("complete -c vasa") : fmt::format("complete -c vasa -n {}", quoted(here));
      for (const auto& name : option.names)
        out += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                      : fmt::format(" -s {}", name.substr(1));
      if (!option.choices.empty())
        out += fmt::format(" {} -a {}", option.files ? "-r" : "-x", quoted(joined(option.choices)));
      else if (!option.value.empty())
        out += " -r";
      out += " -d " + quoted(option.description) + "\n";
    }
  });
  return out;
}

}  // namespace vasa::cli
