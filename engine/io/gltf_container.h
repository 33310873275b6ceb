#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace vasa::gltf {

/// Largest file, and largest buffer beside it, that is read [bytes].
inline constexpr std::size_t kMaximumFileBytes = std::size_t(1) << 30;
/// Largest JSON text [bytes].
inline constexpr std::size_t kMaximumJsonBytes = std::size_t(64) << 20;
/// Deepest nesting of arrays and objects; parsers recurse, and 40 KB of brackets overflow a stack.
inline constexpr std::size_t kMaximumNesting = 64;

/// The two parts of a glTF file; views into its bytes.
struct Container {
  std::string_view json;
  std::optional<std::span<const std::byte>> binary;  ///< the BIN chunk of a GLB
  bool isGlb = false;
};

/// Takes a .glb apart, or passes a .gltf through, after checking sizes, chunk order, JSON nesting and the
/// memory that the parsed JSON will take: at most 11 times the file's bytes and 24 MiB. Lengths are computed
/// in 64 bits, so none can wrap. Throws BrokenRule. O(file), no allocation.
/// @param bytes  the whole file; must outlive the result
/// @param path   tells .glb from .gltf where the first bytes do not
Container openContainer(std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace vasa::gltf
