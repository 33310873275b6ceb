#include "man_page.h"

#include <fmt/format.h>

#include <cctype>
#include <sstream>

namespace vasa::cli {
namespace {

// Backslashes and hyphens mean something to troff, and so does a line that begins with a dot or a quote.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  if (out.starts_with('.') || out.starts_with('\'')) out.insert(0, "\\&");
  return out;
}

std::string header(const std::string& name, int section, const std::string& about) {
  std::string title = name;
  for (char& c : title) c = char(std::toupper(static_cast<unsigned char>(c)));
  return fmt::format(".TH {} {} \"\" \"vasa {}\" \"vasa\"\n.SH NAME\n{} \\- {}\n", roff(title), section,
                     VASA_VERSION, roff(name), roff(about));
}

std::string listing(const std::vector<std::string>& lines) {
  std::string out = ".PP\n.nf\n.RS 4\n";
  for (const auto& line : lines) out += roff(line) + "\n";
  return out + ".RE\n.fi\n";
}

std::string optionEntry(const OptionText& option) {
  std::vector<std::string> names;
  for (const auto& name : option.names) names.push_back(fmt::format("\\fB{}\\fR", roff(name)));
  std::string out = fmt::format(".TP\n{}", joined(names, ", "));
  if (!option.positional && !option.value.empty()) out += fmt::format(" \\fI{}\\fR", roff(option.value));
  out += fmt::format("\n{}", roff(option.description));
  if (!option.choices.empty()) out += fmt::format(". One of {}", roff(joined(option.choices, ", ")));
  if (!option.standard.empty()) out += fmt::format(". Default: {}", roff(option.standard));
  if (option.required) out += ". Required";
  return out + ".\n";
}

std::string options(const CommandText& command, const char* heading, bool positional) {
  std::string out;
  for (const OptionText& option : command.options)
    if (option.positional == positional) out += optionEntry(option);
  return out.empty() ? out : fmt::format(".SH {}\n", heading) + out;
}

std::string synopsis(const CommandText& command) {
  std::string out = fmt::format(".SH SYNOPSIS\n.B {}\n", roff(joined(command.path, " ")));
  if (!command.commands.empty()) out += ".I COMMAND\n";
  out += "[\\fIOPTION\\fR]...";
  for (const OptionText& option : command.options)
    if (option.positional)
      out += fmt::format(" {}\\fI{}\\fR{}{}", option.required ? "" : "[", roff(option.names.front()),
                         option.repeated ? "..." : "", option.required ? "" : "]");
  return out + "\n";
}

std::string lowerFirst(std::string text) {
  if (text.size() > 1 && !std::isupper(static_cast<unsigned char>(text[1])))
    text[0] = char(std::tolower(static_cast<unsigned char>(text[0])));
  while (text.ends_with('.')) text.pop_back();
  return text;
}

std::string seeAlso(const CommandText& program, const std::string& self) {
  std::vector<std::string> pages{"vasa(1)"};
  for (const auto& command : program.commands) pages.push_back(manName(command) + "(1)");
  for (const auto& topic : topics()) pages.push_back(manName(topic) + "(7)");
  std::string out = ".SH SEE ALSO\n";
  for (std::size_t i = 0, written = 0; i < pages.size(); ++i)
    if (!pages[i].starts_with(self + "("))
      out += (written++ ? ", " : "") + fmt::format("\\fB{}\\fR", roff(pages[i]));
  return out + "\n";
}

}  // namespace

std::string Topic::title() const {
  const auto colon = text.find(": ");
  return text.substr(colon + 2, text.find('\n') - colon - 2);
}

std::string manName(const CommandText& command) { return joined(command.path, "-"); }

std::string manName(const Topic& topic) { return fmt::format("vasa-{}", topic.name); }

std::string manPage(const CommandText& command, const CommandText& program) {
  std::string out = header(manName(command), 1, lowerFirst(command.description)) + synopsis(command);
  out += fmt::format(".SH DESCRIPTION\n{}.\n", roff(command.description));
  for (const auto& note : command.notes) out += fmt::format("{}\n", roff(note));
  out += options(command, "ARGUMENTS", true) + options(command, "OPTIONS", false);
  if (!command.commands.empty()) {
    out += ".SH COMMANDS\n";
    for (const auto& below : command.commands)
      out += fmt::format(".TP\n\\fB{}\\fR\n{}.\n", roff(below.path.back()), roff(below.description));
  }
  if (command.path.size() > 1) out += ".PP\nThe options of \\fBvasa\\fR(1) may be given, too.\n";
  if (!command.examples.empty()) out += fmt::format(".SH EXAMPLES\n{}", listing(command.examples));
  return out + seeAlso(program, manName(command));
}

std::string manPage(const Topic& topic) {
  std::string out = header(manName(topic), 7, topic.title()) + ".SH DESCRIPTION\n";
  std::istringstream lines(topic.text);
  std::string line;
  std::getline(lines, line);  // the title
  std::vector<std::string> block;
  bool gap = false;
  const auto endBlock = [&] {
    if (!block.empty()) out += listing(block);
    block.clear();
  };
  for (; std::getline(lines, line); gap = line.empty()) {
    if (line.starts_with("    ")) {
      block.push_back(line.substr(4));
      continue;
    }
    endBlock();
    if (line.empty()) continue;
    if (line.starts_with("## "))
      out += fmt::format(".SH {}\n", roff(line.substr(3)));
    else if (line.starts_with("* "))
      out += fmt::format(".IP \\(bu 2\n{}\n", roff(line.substr(2)));
    else
      out += (gap ? ".PP\n" : "") + roff(line.substr(line.find_first_not_of(' '))) + "\n";
  }
  endBlock();
  return out;
}

}  // namespace vasa::cli
