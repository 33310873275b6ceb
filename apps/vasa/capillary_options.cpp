#include "capillary_options.h"

#include <fmt/format.h>

#include "core/atomic_file.h"
#include "core/hash.h"
#include "scene_options.h"

namespace vasa::cli {
namespace {

Result<std::filesystem::path> rulesFolder(const CapillaryOptions& options) {
  if (!options.rules.empty()) return std::filesystem::path(options.rules);
  auto folder = dataFolder();
  if (!folder) return folder;
  return *folder / "growth";
}

}  // namespace

void addCapillaryOptions(CLI::App& sub, CapillaryOptions& options) {
  sub.add_option("--capillaries", options.levels, "Generations of capillaries that grow from the vessels; 0: none")
      ->check(CLI::Range(0u, shared::kMostGrowthLevels))
      ->capture_default_str();
  sub.add_option("--capillary-edges", options.edges, "Edges of a capillary's polyline: 3, 5, 8, 10, or auto by its size in the picture")
      ->check(CLI::IsMember({"3", "5", "8", "10", "auto"}))
      ->capture_default_str();
  sub.add_option("--capillary-budget", options.budget, "Most capillaries in a picture; beyond it all vessels have fewer trees")
      ->check(CLI::Range(1u, 64'000'000u))
      ->capture_default_str();
  sub.add_option("--capillary-detail", options.smallest, "Leave out generations shorter than this in pixels; 0: draw them all")
      ->check(CLI::Range(0.0f, 1000.0f))
      ->capture_default_str();
  sub.add_option("--growth", options.rules, "Folder with capillaries.lsys and regions.csv (default: the program's own)");
}

CapillaryWish wishOf(const CapillaryOptions& options) {
  return {.levels = options.levels,
          .edges = options.edges == "auto" ? 0u : std::uint32_t(std::stoul(options.edges)),
          .budget = options.budget,
          .smallest = options.smallest};
}

Result<std::unique_ptr<SceneGrowth>> growthOf(const Scene& scene, const CapillaryOptions& options) {
  if (options.levels == 0) return std::unique_ptr<SceneGrowth>();
  const auto folder = rulesFolder(options);
  if (!folder) return folder.error();
  auto growth = loadGrowth(scene, *folder);
  if (!growth) return growth.error();
  return std::make_unique<SceneGrowth>(std::move(*growth));
}

Result<std::uint64_t> hashOfCapillaries(const CapillaryOptions& options, std::uint64_t hash) {
  if (options.levels == 0) return hash;
  const auto folder = rulesFolder(options);
  if (!folder) return folder.error();
  for (const char* file : {"capillaries.lsys", "regions.csv"}) {
    const auto bytes = readFile(*folder / file);
    if (!bytes) return bytes.error();
    hash = hashBytes(*bytes, hash);
  }
  const std::string settings = fmt::format("{}|{}|{}|{}", options.levels, options.edges, options.budget, options.smallest);
  return hashOf(std::span(settings), hash);
}

}  // namespace vasa::cli
