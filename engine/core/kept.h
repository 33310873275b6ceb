#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace vasa {

/// Where results that took long to compute are kept from run to run. Without folders nothing is kept, which is
/// how a program begins.
struct KeptFolders {
  std::vector<std::filesystem::path> shipped;  ///< only read
  std::filesystem::path own;                   ///< read, written and held below kMostKept; may be missing
};
/// Of all files in the own folder; the ones that nobody has used for longest go first.
constexpr std::uintmax_t kMostKept = std::uintmax_t(512) << 20;

/// For the whole process; to be called before anything is computed.
void setKeptFolders(KeptFolders folders);

/// What keep() kept under this name, by this very engine: what other sources or another compiler made is not
/// found, nor what is damaged. Any thread.
/// @param kind  a short word, part of the file's name
/// @param key   hash of all that the result depends on
std::optional<std::vector<std::byte>> findKept(std::string_view kind, std::uint64_t key);

/// Keeps a result in the own folder. Where that cannot be (no folder, no room, no right) the next run computes
/// it again. Any thread, any number of processes.
void keep(std::string_view kind, std::uint64_t key, std::span<const std::byte> bytes);

}  // namespace vasa
