// Vulkan calls that fail (fault_layer.cpp), one a run of the program. A run must end in time with the right
// exit code and message, and leave only files that an undisturbed run leaves, byte for byte.
//   VASA_FAULTS=N  every N-th of all: each function at its first, second, middle and last call, each of its
//   results, once and
//                  for good; without it a few
#include <doctest/doctest.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/program.h"
#include "gpu/error.h"
#include "io/gltf_builder.h"
#include "support/shared_data.h"
#include "view/virtual_display.h"

using namespace vasa;
using namespace vasa::test;

namespace {

struct Site {
  std::string function;
  unsigned call = 1;
  VkResult result = VK_SUCCESS;
  bool always = false;
  bool last = false;  // of the function's calls in a run

  std::string text() const {
    return function + ":" + std::to_string(call) + ":" + std::to_string(int(result)) +
           (always ? ":always" : ":once");
  }
};

struct Called {
  unsigned calls = 0;
  std::vector<VkResult> results;
};

std::map<std::string, std::string> filesOf(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const std::string& name : listOf(folder)) files[name] = contentOf(folder / name);
  return files;
}

std::map<std::string, Called> calledOf(const std::string& log) {
  std::map<std::string, Called> called;
  std::istringstream lines(log);
  for (std::string line, name; std::getline(lines, line);) {
    std::istringstream words(line);
    Called entry;
    if (!(words >> name >> entry.calls)) continue;
    for (int result; words >> result;) entry.results.push_back(VkResult(result));
    called[name] = entry;
  }
  return called;
}

// Few, for they take a second each, mostly for the driver's shaders: every twelfth function at its last call,
// and each result of a wait.
std::vector<Site> fewSites(const std::map<std::string, Called>& called, std::size_t phase) {
  std::vector<Site> sites;
  for (const auto& [name, entry] : called) {
    if (phase++ % 12 == 0) sites.push_back({name, entry.calls, entry.results.front(), true, true});
    if (name != "vkWaitSemaphores") continue;
    for (const VkResult result : entry.results) sites.push_back({name, (entry.calls + 1) / 2, result, false});
  }
  return sites;
}

std::vector<Site> manySites(const std::map<std::string, Called>& called, std::size_t every) {
  std::vector<Site> sites, chosen;
  for (const auto& [name, entry] : called)
    for (const unsigned call :
         std::set<unsigned>{1, std::min(2u, entry.calls), (entry.calls + 1) / 2, entry.calls})
      for (const VkResult result : entry.results)
        for (const bool always : {false, true})
          sites.push_back({name, call, result, always, call == entry.calls});
  for (std::size_t i = 0; i < sites.size(); i += every) chosen.push_back(sites[i]);
  return chosen;
}

std::vector<Site> sitesOf(const std::map<std::string, Called>& called, std::size_t phase) {
  const char* every = std::getenv("VASA_FAULTS");
  return every ? manySites(called, std::max(1ul, std::strtoul(every, nullptr, 10))) : fewSites(called, phase);
}

// What a run goes on after: the window system's and the clock's moods, memory of another type, pipelines that
// were kept and are of no use, ends that only clean up.
bool goesOn(const Site& site) {
  static const std::set<std::string> cleaning{"vkQueueWaitIdle", "vkDeviceWaitIdle"};
  if (site.last && (site.function == "vkWaitSemaphores" || site.function == "vkGetSemaphoreCounterValue"))
    return true;
  return site.result >= 0 || site.result == VK_ERROR_OUT_OF_DATE_KHR || cleaning.contains(site.function) ||
         (site.function == "vkCreatePipelineCache" && site.call == 1 && !site.always) ||
         (site.function == "vkAllocateMemory" && site.result == VK_ERROR_OUT_OF_DEVICE_MEMORY &&
          !site.always);
}

// Of the driver: a first run compiles its shaders for 20 s of processor time, later ones of all commands find
// them there.
std::filesystem::path cacheFolder() {
  static const TemporaryFolder folder;
  return folder.path();
}

struct Bench {
  TemporaryFolder folder;
  std::filesystem::path body = writeBytes(folder.path() / "body.glb", bodyFile().glb());
  std::filesystem::path vessels = folder.path() / "vessels.vasa";
  std::vector<std::string> environment;
  double seconds = 0;
  std::size_t runs = 0, struck = 0;

  Bench() {
    const auto centres = writeBytes(
        folder.path() / "fork.swc",
        "1 2 0 0.95 0 0.012 -1\n2 2 0 0.8 0 0.011 1\n3 2 0 0.7 0 0.01 2\n"
        "4 2 0.05 0.6 0 0.008 3\n5 2 0.06 0.5 0 0.007 4\n6 2 -0.05 0.6 0 0.008 3\n7 2 -0.06 0.5 0 0.007 6\n");
    REQUIRE(runProgram({"convert", centres.string(), "--kind", "artery", "-o", vessels.string()}).exit == 0);
    environment = {"VK_LAYER_PATH=" VASA_FAULT_LAYER, "VK_INSTANCE_LAYERS=VK_LAYER_VASA_faults",
                   "VK_LOADER_LAYERS_ENABLE=", "XDG_CACHE_HOME=" + cacheFolder().string(),
                   "XDG_CONFIG_HOME=" + folder.path().string()};
  }

  // In a folder of its own, called "out".
  Outcome run(std::vector<std::string> arguments, const std::string& fault, std::string& log) {
    const auto out = folder.path() / "out", file = folder.path() / "log";
    std::filesystem::remove_all(out);
    std::filesystem::create_directory(out);
    std::filesystem::remove(file);
    ProgramOptions options{.environment = environment, .folder = out.string()};
    options.environment.push_back("VASA_FAULT_LOG=" + file.string());
    options.environment.push_back("VASA_FAULT=" + fault);
    options.environment.push_back(std::string("VASA_FAULT_SECONDS=") + (fault.empty() ? "600" : "60"));
    arguments.insert(arguments.begin() + 1, {"--body", body.string(), "--network", vessels.string()});
    const Outcome outcome = runProgram(arguments, options);
    log = contentOf(file);
    return outcome;
  }

  void tryAll(const std::vector<std::string>& arguments) {
    std::string log;
    const Outcome whole = run(arguments, "", log);
    REQUIRE_MESSAGE(whole.exit == 0, whole.err);
    const auto wanted = filesOf(folder.path() / "out");
    const auto called = calledOf(log);
    REQUIRE(called.contains("vkWaitSemaphores"));
    for (const Site& site : sitesOf(called, arguments.front().size())) {
      const Outcome outcome = run(arguments, site.text(), log);
      INFO(arguments.front() << " with " << site.text() << " (" << gpu::resultName(site.result) << "): exit "
                             << outcome.exit << "\n"
                             << outcome.err);
      ++runs;
      if (log.find("struck") != std::string::npos)
        ++struck;
      else
        CHECK(outcome.exit == 0);
      check(site, outcome, log.find("struck") != std::string::npos, wanted);
    }
  }

  void check(const Site& site, const Outcome& outcome, bool hit,
             const std::map<std::string, std::string>& wanted) {
    for (const auto& file : filesOf(folder.path() / "out")) {
      const std::string& name = file.first;
      CAPTURE(name);
      REQUIRE(wanted.contains(name));
      CHECK((file.second == wanted.at(name)));
    }
    if (outcome.exit == 0) {
      CHECK((!hit || goesOn(site)));
      CHECK(filesOf(folder.path() / "out").size() == wanted.size());
      return;
    }
    CHECK(("\n" + outcome.err).find("\nerror: ") != std::string::npos);  // after warnings
    if (site.result == VK_ERROR_DEVICE_LOST)
      CHECK(outcome.exit == 5);
    else
      CHECK((outcome.exit == 1 || outcome.exit == 4));
    CHECK((outcome.err.find(gpu::resultName(site.result)) != std::string::npos || outcome.exit == 4));
  }
};

// Of the app, told what to do by a script.
struct AppBench : Bench {
  const VirtualDisplay display;
  std::vector<std::string> command;
  explicit AppBench(const std::string& script) {
    environment.push_back(display.variable());
    command = {"view", "--script", writeBytes(folder.path() / "script.txt", script).string(), "--size",
               "400x320"};
  }
};

}  // namespace

TEST_CASE("render: whatever Vulkan call fails, the run ends in good order") {
  Bench bench;
  bench.tryAll({"render", "--clip", "bend", "--frames", "0:1", "--size", "64x64", "--quads", "4x2", "-o",
                "{frame}.png"});
  MESSAGE("render: " << bench.runs << " sites, " << bench.struck << " struck");
}

TEST_CASE("profile: whatever Vulkan call fails, the run ends in good order") {
  Bench bench;
  bench.tryAll(
      {"profile", "--clip", "bend", "--frames", "4", "--size", "64x64", "--quads", "4x2", "--with-body"});
  MESSAGE("profile: " << bench.runs << " sites, " << bench.struck << " struck");
}

TEST_CASE("view: whatever Vulkan call fails, the run ends in good order") {
  AppBench bench(
      "settle\nframes 2\nresize 420 300\nframes 2\nwindow window.png\npicture picture.png\nclose\n");
  bench.tryAll(bench.command);
  MESSAGE("view: " << bench.runs << " sites, " << bench.struck << " struck");
}

TEST_CASE("view: a device that is lost leaves what was not saved in a scene of its own") {
  AppBench bench(
      "settle\nhold control\nhold shift\nkey 4\nlet shift\nlet control\nframes 2\nwindow window.png\n");
  std::string log;
  const Outcome whole = bench.run(bench.command, "", log);
  REQUIRE_MESSAGE(whole.exit == 0, whole.err);
  CHECK(listOf(bench.folder.path() / "out") == std::vector<std::string>{"window.png"});
  const unsigned last = calledOf(log).at("vkQueueSubmit2").calls;
  const Outcome lost =
      bench.run(bench.command, Site{"vkQueueSubmit2", last, VK_ERROR_DEVICE_LOST, true}.text(), log);
  INFO(lost.err);
  CHECK(lost.exit == 5);
  CHECK(lost.err.find("what was not saved is in ./vasa_001.json") != std::string::npos);
  const auto scene = bench.folder.path() / "out" / "vasa_001.json";
  const auto kept = nlohmann::json::parse(contentOf(scene), nullptr, false);
  REQUIRE(kept.is_object());
  CHECK(kept["views"].contains("4"));
  CHECK(runProgram({"info", scene.string()}).exit == 0);
}
