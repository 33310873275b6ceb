#include <CLI/CLI.hpp>
#include <filesystem>

#include "core/atomic_file.h"
#include "core/log.h"
#include "make_human/glb.h"
#include "make_human/human.h"
#include "network/file.h"

namespace {

vasa::Result<void> generate(const std::filesystem::path& tables, const std::filesystem::path& out,
                            const vasa::human::GrowOptions& options, bool quantise) {
  using namespace vasa;
  Result<human::Human> made = human::makeHuman(tables, options);
  if (!made.ok()) return made.error();
  const std::vector<std::byte> body = human::writeGlb(made->rig, made->meshes, made->clips);
  if (Result<void> written = writeFileAtomically(out / "human.glb", body); !written.ok()) return written;
  const Result<std::size_t> network = writeNetwork(out / "human.vasa", made->vessels, {quantise});
  if (!network.ok()) return network.error();
  if (const std::uint32_t sweeps = made->vessels.sweepCount(); float(sweeps) < 0.95f * float(options.sweeps))
    logWarning("the regions are full at " + std::to_string(sweeps) + " sweeps of " +
               std::to_string(options.sweeps));
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes OUT/human.glb and OUT/human.vasa, the built-in human, of the tables in a folder");
  std::string tables, out;
  vasa::human::GrowOptions options;
  bool quantise = false;
  app.add_option("tables", tables, "Folder of the tables (.csv)")->required();
  app.add_option("out", out, "Folder for the results")->required();
  app.add_option("--detail", options.sweeps,
                 "Sweeps of the network, at least: small vessels grow until there are as many")
      ->capture_default_str()
      ->check(CLI::Range(1u, 2000000u));
  app.add_option("--seed", options.seed, "Another seed, other small vessels")->capture_default_str();
  app.add_flag("--quantise", quantise, "8 bytes a point instead of 16");
  app.footer("Example:\n  make_human data/human build --detail 403000");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : int(vasa::Fault::usage);
  }
  const vasa::Result<void> done = generate(tables, out, options, quantise);
  if (done.ok()) return 0;
  vasa::logError(done.error().message);
  return int(done.error().fault);
}
