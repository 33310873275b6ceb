#pragma once
#include "core/kept.h"

namespace vasa::cli {

/// Where this build of the program keeps results between runs (core/kept.h): what ships is read, `own` read
/// and written.
KeptFolders keptFolders(std::filesystem::path own);

}  // namespace vasa::cli
