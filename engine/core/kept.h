#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace vasa {

/// Where results that took long to compute are kept from run to run. Without folders nothing is kept, which
/// is how a program begins.
struct KeptFolders {
  std::vector<std::filesystem::path> shipped;  ///< only read
  std::filesystem::path own;                   ///< read, written and held below `most`; may be missing
  std::uint64_t engine = 0;                    ///< tells one build of the engine from another
  /// [bytes] of the own folder; what nobody has used for longest goes first
  std::uintmax_t most = std::uintmax_t(512) << 20;
};

/// For the whole process; to be called before anything is computed.
void setKeptFolders(KeptFolders folders);

/// What keep() kept under this name, by this very engine: what another one made is not found, nor what is
/// damaged. Any thread.
/// @param kind  a short word, part of the file's name
/// @param key   hash of all that the result depends on
std::optional<std::vector<std::byte>> findKept(std::string_view kind, std::uint64_t key);

/// Keeps a result in the own folder. Where that cannot be (no folder, no room, no right) the next run
/// computes it again. Any thread, any number of processes.
void keep(std::string_view kind, std::uint64_t key, std::span<const std::byte> bytes);

/// Why not everything that was to be kept since setKeptFolders() is: the first failure.
Result<void> keptAll();

}  // namespace vasa
