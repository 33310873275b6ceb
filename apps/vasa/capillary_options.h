#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "render/renderer.h"
#include "scene/growth.h"

namespace vasa::cli {

/// What a person may say about capillaries on the command line; what is not said comes from the scene.
struct CapillaryOptions {
  std::optional<unsigned> levels, budget;
  std::optional<float> smallest;
  std::string edges, rules;
};

/// Declares --capillaries, --capillary-edges, --capillary-budget, --capillary-detail and --growth.
void addCapillaryOptions(CLI::App& sub, CapillaryOptions& options);

CapillaryChoice chooseCapillaries(CapillaryChoice choice, const CapillaryOptions& options);

CapillaryWish wishOf(const CapillaryChoice& choice);

/// What the scene's capillaries grow from; null where none are asked for.
/// @param table  makeSweepTable() of the scene's network, made where it is left out
Result<std::unique_ptr<SceneGrowth>> growthOf(const Scene& scene, const CapillaryChoice& choice);
Result<std::unique_ptr<SceneGrowth>> growthOf(const Scene& scene, const CapillaryChoice& choice,
                                              const SweepTable& table);

}  // namespace vasa::cli
