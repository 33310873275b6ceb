#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "render/renderer.h"
#include "scene/growth.h"

namespace vasa::cli {

/// What a person may say about capillaries on the command line.
struct CapillaryOptions {
  std::uint32_t levels = 0;
  std::string edges = "auto";
  std::uint32_t budget = CapillaryWish{}.budget;
  float smallest = CapillaryWish{}.smallest;
  std::string rules;  ///< folder; empty: the program's own

  bool operator==(const CapillaryOptions&) const = default;
};

/// Declares --capillaries, --capillary-edges, --capillary-budget, --capillary-detail and --growth.
void addCapillaryOptions(CLI::App& sub, CapillaryOptions& options);

CapillaryWish wishOf(const CapillaryOptions& options);

/// What the scene's capillaries grow from; null where none are asked for.
Result<std::unique_ptr<SceneGrowth>> growthOf(const Scene& scene, const CapillaryOptions& options);

/// Everything about them that decides a picture, rules included: tells runs apart.
Result<std::uint64_t> hashOfCapillaries(const CapillaryOptions& options, std::uint64_t hash);

}  // namespace vasa::cli
