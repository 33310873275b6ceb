#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include "core/result.h"
#include "endings.h"

// The command line: one file a subcommand. add...() declares a subcommand's options on the app and stores
// in `run` what is to be done once parsing has succeeded.
namespace vasa::cli {

/// Options every subcommand takes.
struct Globals {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool noCache = false;
  unsigned threads = 0;  ///< 0: one a core
  std::string device;    ///< name or index; empty: the best
  std::uint64_t seed = 1;
};

struct Command {
  Globals globals;
  std::function<Result<void>()> run;
};

void addBench(CLI::App& app, Command& command);
void addCheck(CLI::App& app, Command& command);
void addCompare(CLI::App& app, Command& command);
void addConvert(CLI::App& app, Command& command);
void addDevices(CLI::App& app, Command& command);
void addEdit(CLI::App& app, Command& command);
void addExport(CLI::App& app, Command& command);
void addFit(CLI::App& app, Command& command);
void addInfo(CLI::App& app, Command& command);
void addMap(CLI::App& app, Command& command);
void addPaper(CLI::App& app, Command& command);
void addPlace(CLI::App& app, Command& command);
void addPlate(CLI::App& app, Command& command);
void addPoses(CLI::App& app, Command& command);
void addPrepare(CLI::App& app, Command& command);
void addProfile(CLI::App& app, Command& command);
void addRealism(CLI::App& app, Command& command);
void addRender(CLI::App& app, Command& command);
void addView(CLI::App& app, Command& command);

}  // namespace vasa::cli
