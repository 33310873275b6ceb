#pragma once
#include <filesystem>

#include "core/result.h"

namespace vasa::cli {

/// Whether a network can be written there, before the work is done: under a name that is not another kind of
/// file's (usage), into a folder that is there (io).
Result<void> checkNetworkOutput(const std::filesystem::path& file);

}  // namespace vasa::cli
