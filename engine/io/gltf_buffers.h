#pragma once
#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "io/gltf_json.h"

namespace vasa::gltf {

/// The bytes of every buffer, exactly byteLength each; empty where the file names none (no URI, or one with a
/// scheme such as http:, which is never fetched): such a buffer may be described, but using it is an error.
struct Buffers {
  std::vector<std::span<const std::byte>> bytes;
  std::deque<std::vector<std::byte>> read;  ///< what `bytes` are views of, beside the GLB's own chunk
  std::size_t bytesBeside = 0;              ///< of the files beside the asset, each counted once
};

/// Sources: the GLB's BIN chunk, base64 data URIs, and files in the asset's folder or below it, symbolic
/// links resolved, each of them read once. Throws BrokenRule, or Error where a file cannot be read.
/// @param binary  must outlive the result
Buffers loadBuffers(const JsonView& root, std::optional<std::span<const std::byte>> binary,
                    const std::filesystem::path& folder);

/// What a URI in a glTF names, percent-decoded.
struct UriTarget {
  enum class Kind { data, relative, elsewhere } kind;
  std::string path;  ///< for relative: below the asset's folder
};

/// Throws where the URI is absolute, climbs with "..", or is no URI.
UriTarget classifyUri(const JsonView& uri);

}  // namespace vasa::gltf
