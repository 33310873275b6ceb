#pragma once
#include <CLI/CLI.hpp>

#include "scene/frame.h"

namespace vasa::cli {

/// How vessels give way when a pose draws or presses them.
struct TissueOptions {
  std::string keep = "volume";
  bool noVolume = false, noSlide = false;

  Keep kept() const;
};

/// Declares --keep, --no-volume and --no-slide.
void addTissueOptions(CLI::App& sub, TissueOptions& options);

}  // namespace vasa::cli
