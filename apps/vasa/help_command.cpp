#include "help_command.h"

#include <fmt/format.h>

#include <filesystem>

#include "completion.h"
#include "core/atomic_file.h"
#include "core/nearest_names.h"
#include "io/gltf.h"
#include "man_page.h"
#include "output_folder.h"
#include "report.h"
#include "scene_options.h"

// vasa help: the commands' own help, topics beside them, and both as manual pages.
namespace vasa::cli {
namespace help_command {

struct Options {
  std::vector<std::string> subject;
  std::string folder;
};

std::string overview(const CommandText& program) {
  std::string text = "vasa help COMMAND explains a command, vasa help TOPIC one of these:\n";
  for (const Topic& topic : topics()) text += fmt::format("  {:<14} {}\n", topic.name, topic.title());
  text += "Commands:\n";
  for (const CommandText& command : program.commands)
    text += fmt::format("  {:<14} {}\n", command.path.back(), command.description);
  return text;
}

Result<std::string> about(const CLI::App& app, const std::vector<std::string>& subject) {
  if (subject.empty()) return overview(describe(app));
  for (const Topic& topic : topics())
    if (subject.size() == 1 && topic.name == subject[0]) return topic.text;
  const CLI::App* command = &app;
  std::string above;
  for (const std::string& name : subject) {
    const auto below =
        command->get_subcommands([&](const CLI::App* candidate) { return candidate->get_name() == name; });
    if (below.empty()) {
      std::vector<std::string> names;
      for (const Topic& topic : topics()) names.push_back(topic.name);
      for (const CLI::App* each : command->get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(each->get_name());
      return Error{Fault::usage, "there is no help on " + name + "; " +
                                     didYouMean(name, names, "vasa help lists commands and topics")};
    }
    above += (above.empty() ? "" : " ") + command->get_name();
    command = below.front();
  }
  return command->help(above);
}

Result<void> writeManuals(const CommandText& command, const CommandText& program,
                          const std::filesystem::path& folder) {
  if (auto written = writeFileAtomically(folder / (manName(command) + ".1"), manPage(command, program));
      !written)
    return written;
  for (const CommandText& below : command.commands)
    if (auto written = writeManuals(below, program, folder); !written) return written;
  return {};
}

// Values that no declaration lists: topics of help, the built-in human's clips where it is there.
void addKnownValues(CommandText& command, const std::vector<std::string>& words,
                    const std::vector<std::string>& clips) {
  for (OptionText& option : command.options) {
    if (option.names.front() == "TOPIC") option.choices = words;
    if (option.names.front() == "--clip") option.choices = clips, option.files = true;
  }
  for (CommandText& below : command.commands) addKnownValues(below, words, clips);
}

CommandText withKnownValues(CommandText program) {
  std::vector<std::string> words, clips;
  for (const Topic& topic : topics()) words.push_back(topic.name);
  for (const CommandText& command : program.commands) words.push_back(command.path.back());
  if (const auto folder = dataFolder())
    if (const auto human = readBody(*folder / "human.glb"))
      for (const Clip& clip : human->clips) clips.push_back(clip.name);
  addKnownValues(program, words, clips);
  return program;
}

Result<void> writeAll(const CommandText& program, const std::filesystem::path& folder) {
  if (auto made = makeOutputFolder(folder); !made) return made;
  if (auto written = writeManuals(program, program, folder); !written) return written;
  for (const Topic& topic : topics())
    if (auto written = writeFileAtomically(folder / (manName(topic) + ".7"), manPage(topic)); !written)
      return written;
  const std::pair<const char*, std::string> completions[] = {{"vasa.bash", bashCompletion(program)},
                                                             {"_vasa", zshCompletion(program)},
                                                             {"vasa.fish", fishCompletion(program)}};
  for (const auto& [name, text] : completions)
    if (auto written = writeFileAtomically(folder / name, text); !written) return written;
  return {};
}

}  // namespace help_command

void addHelp(CLI::App& app, Command& command) {
  using namespace help_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("help", "Explain a command or a topic");
  sub->footer(
      "Examples:\n"
      "  vasa help\n"
      "  vasa help export\n"
      "  vasa help formats\n"
      "  vasa help --write out    (manual pages, and completions for bash, zsh and fish)");
  sub->add_option("TOPIC", options->subject, "A command or a topic; nothing: lists them");
  sub->add_option("--write", options->folder,
                  "Write all manual pages and shell completions into this folder");
  sub->callback([options, &app, &command] {
    command.run = [options, &app]() -> Result<void> {
      if (!options->folder.empty()) return writeAll(withKnownValues(describe(app)), options->folder);
      const auto text = about(app, options->subject);
      if (!text) return text.error();
      return printText(*text);
    };
  });
}

}  // namespace vasa::cli
