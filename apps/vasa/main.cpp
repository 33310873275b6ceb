#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>

#include "commands.h"
#include "core/cancellation.h"
#include "core/kept.h"
#include "core/log.h"
#include "core/parallel.h"
#include "core/unawaited.h"
#include "endings.h"
#include "help_command.h"
#include "kept_folders.h"
#include "report.h"
#include "scene_options.h"
#include "usage_error.h"

namespace vasa::cli {
namespace {

void addGlobals(CLI::App& app, Globals& globals) {
  app.add_flag("--json", globals.json, "Print a machine-readable report on standard output, nothing else");
  app.add_flag("--quiet", globals.quiet,
               "Leave out notes, warnings and progress: the report and errors alone");
  app.add_flag("--verbose", globals.verbose, "Say more");
  app.add_flag_callback(
      "--no-color", [] { setenv("NO_COLOR", "1", 1); },
      "Print messages without colours, as with NO_COLOR set");
  app.add_flag("--no-cache", globals.noCache, "Compute everything anew and keep nothing (see vasa prepare)");
  app.add_option("--threads", globals.threads, "Threads to use (default: one a core)")
      ->check(CLI::Range(1u, 1024u));
  app.add_option("--device", globals.device,
                 "Vulkan device: its index or part of its name (see vasa devices)");
  app.add_option("--seed", globals.seed, "Seed of everything random")
      ->check(CLI::Range(0u, 4294967295u))
      ->capture_default_str();
}

// Work leaves at a checkpoint once a signal has asked.
Result<void> runStoppable(const Command& command) {
  const CancellationScope scope(stopWish());
  try {
    return command.run();
  } catch (const Cancelled&) {
    return stopError();
  }
}

int runCommand(Command& command) {
  setLogLevel(command.globals.quiet     ? LogLevel::quiet
              : command.globals.verbose ? LogLevel::verbose
                                        : LogLevel::normal);
  setThreadCount(command.globals.threads);
  if (!command.globals.noCache) setKeptFolders(keptFolders(cacheFolder()));
  const Result<void> result = [&] {
    try {
      return runStoppable(command);
    } catch (const ReaderGone&) {
      // Who read has seen enough, as head does: no fault of anyone's.
      std::_Exit(128 + SIGPIPE);
    }
  }();
  if (result.ok() && std::fflush(stdout) != 0) {
    logError("cannot write to standard output");
    return int(Fault::io);
  }
  if (result.ok()) return 0;
  logError(result.error().message);
  return int(result.error().fault);
}

// "nan" and "inf" can be read as numbers, and would pass a range; no option means anything by them. A word
// that is empty is a script's variable that was never set: to take it for an option that was not given would
// draw all frames for one shard.
void refuseEmptyValues(CLI::App& app) {
  const auto noNumber = [](const std::string& text) {
    double value = 0;
    return CLI::detail::lexical_cast(text, value) && !std::isfinite(value)
               ? text + ": must be a finite number"
               : std::string();
  };
  const auto noWord = [](const std::string& text) {
    return text.empty() ? std::string("is empty; leave it out, or give it a value") : std::string();
  };
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_name().starts_with("FLOAT")) option->check(CLI::Validator(noNumber, ""));
    if (option->get_type_name().starts_with("TEXT") && option->get_name() != "--title")
      option->check(CLI::Validator(noWord, ""));
  }
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    refuseEmptyValues(*command);
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app{
      "Moves a body's blood vessels with its skeleton.\n"
      "  vasa convert arteries.glb veins.glb -o body.vasa\n"
      "  vasa render --body body.glb --network body.vasa --clip walk -o 'out/{frame:04}.png'\n",
      "vasa"};
  app.set_version_flag("-V,--version", "vasa " VASA_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  Command command;
  addGlobals(app, command.globals);
  addView(app, command);
  addRealism(app, command);
  addRender(app, command);
  addPlate(app, command);
  addConvert(app, command);
  addFit(app, command);
  addPlace(app, command);
  addPoses(app, command);
  addEdit(app, command);
  addExport(app, command);
  addPrepare(app, command);
  addInfo(app, command);
  addMap(app, command);
  addCheck(app, command);
  addCompare(app, command);
  addProfile(app, command);
  addPaper(app, command);
  addBench(app, command);
  addDevices(app, command);
  addHelp(app, command);
  refuseEmptyValues(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // help, version
      std::ostringstream told;
      app.exit(error, told, told);
      if (const auto printed = printText(told.str()); !printed) {
        logError(printed.error().message);
        return int(printed.error().fault);
      }
      return 0;
    }
    logError(usageMessage(app, error));
    return int(Fault::usage);
  }
  if (const std::string reason = overwritingMessage(app); !reason.empty()) {
    logError(reason);
    return int(Fault::usage);
  }
  return runCommand(command);
}

}  // namespace vasa::cli

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // the write fails and says so
  vasa::cli::catchStopSignals();
  vasa::cli::endWhereMemoryEnds();
  vasa::cli::tellWhatTerminates();
  int code = int(vasa::Fault::failed);
  try {
    code = vasa::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    vasa::logError("out of memory; use smaller inputs or fewer threads");
  } catch (const std::exception& error) {
    vasa::logError(error.what());
  }
  if (!vasa::hasUnawaited()) return code;
  std::fflush(nullptr);
  std::_Exit(code);
}
