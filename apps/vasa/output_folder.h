#pragma once
#include <filesystem>

#include "core/result.h"

namespace vasa::cli {

/// Refuses -, which stands for standard output elsewhere, as usage: before anything is loaded for it.
Result<void> checkOutputFolder(const std::filesystem::path& folder);

/// Makes a folder for what is to be written, and those above it. None is begun at the root of the file
/// system: a path that starts there with a name that is not there is a slip, as /hom/me/out is. Fails as io,
/// for - as usage.
Result<void> makeOutputFolder(const std::filesystem::path& folder);

}  // namespace vasa::cli
