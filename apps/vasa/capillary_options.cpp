#include "capillary_options.h"

#include <fmt/format.h>

#include "scene_options.h"

namespace vasa::cli {
namespace {

Result<std::filesystem::path> rulesFolder(const CapillaryChoice& choice) {
  if (!choice.rules.empty()) return choice.rules;
  auto folder = dataFolder();
  if (!folder) return folder;
  return *folder / "growth";
}

}  // namespace

void addCapillaryOptions(CLI::App& sub, CapillaryOptions& options) {
  const CapillaryChoice usual;
  sub.add_option("--capillaries", options.levels,
                 "Generations of capillaries that grow from the vessels (default: the scene's, or 0: none)")
      ->check(CLI::Range(0u, shared::kMostGrowthLevels));
  sub.add_option("--capillary-edges", options.edges,
                 "Edges of a capillary's polyline: 3, 5, 8, 10, or auto by its size in the picture (default)")
      ->check(CLI::IsMember({"3", "5", "8", "10", "auto"}));
  sub.add_option(
         "--capillary-budget", options.budget,
         fmt::format(
             "Most capillaries in a picture; beyond it trees lose generations, the deepest first (default {})",
             usual.budget))
      ->check(CLI::Range(1u, 64'000'000u));
  sub.add_option(
         "--capillary-detail", options.smallest,
         fmt::format(
             "Leave out generations shorter than this in pixels, draw thin ones with fewer triangles, and fewer of those not much longer; 0: neither (default {})",
             usual.smallest))
      ->check(CLI::Range(0.0f, 1000.0f));
  sub.add_option("--growth", options.rules,
                 "Folder with capillaries.lsys and regions.csv (default: the program's own)");
}

CapillaryChoice chooseCapillaries(CapillaryChoice choice, const CapillaryOptions& options) {
  if (options.levels) choice.levels = *options.levels;
  if (options.budget) choice.budget = *options.budget;
  if (options.smallest) choice.smallest = *options.smallest;
  if (!options.edges.empty())
    choice.edges = options.edges == "auto" ? 0u : unsigned(std::stoul(options.edges));
  if (!options.rules.empty()) choice.rules = options.rules;
  return choice;
}

CapillaryWish wishOf(const CapillaryChoice& choice) {
  return {
      .levels = choice.levels, .edges = choice.edges, .budget = choice.budget, .smallest = choice.smallest};
}

Result<std::unique_ptr<SceneGrowth>> growthOf(const Scene& scene, const CapillaryChoice& choice) {
  return growthOf(scene, choice, choice.levels > 0 ? makeSweepTable(scene.network) : SweepTable{});
}

Result<std::unique_ptr<SceneGrowth>> growthOf(const Scene& scene, const CapillaryChoice& choice,
                                              const SweepTable& table) {
  if (choice.levels == 0) return std::unique_ptr<SceneGrowth>();
  const auto folder = rulesFolder(choice);
  if (!folder) return folder.error();
  auto growth = loadGrowth(scene, *folder, table);
  if (!growth) return growth.error();
  return std::make_unique<SceneGrowth>(std::move(*growth));
}

}  // namespace vasa::cli
