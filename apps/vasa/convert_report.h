#pragma once
#include "convert/keep_patches.h"
#include "convert/report.h"
#include "report.h"

namespace vasa::cli {

/// What became of the written file.
struct ConvertOutput {
  std::string file;  ///< empty: none was written
  std::size_t bytes = 0;
  bool quantised = false;
  float quantisationError = 0;  ///< [m] largest move of a point
  double seconds = 0;
};

/// The machine-readable report of `vasa convert`.
Report convertJson(const ConvertReport& report, const ConvertOutput& output);

/// The same for a person: the summary, and the elements that are not ok.
std::string convertText(const ConvertReport& report, const ConvertOutput& output);

/// What became of the forks with --keep-patches.
Report patchesJson(const PatchReport& report, const Network& network);
std::string patchesText(const PatchReport& report);

}  // namespace vasa::cli
