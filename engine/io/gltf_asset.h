#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/gltf_buffers.h"
#include "io/gltf_model.h"

namespace vasa::gltf {

/// A glTF file that has passed every check of gltf_check.h: all indices, ranges and references of the model
/// hold.
struct Asset {
  std::string name;  ///< file name, for messages
  Model model;
  std::vector<std::byte> file;  ///< the bytes that the GLB's own buffer is a view of
  Buffers buffers;
  std::size_t bytes = 0;  ///< of the file, of those beside it that were read, and unpacked ones
};

/// Checks the bytes of a .gltf or .glb: container, JSON nesting and amount, structure, then the data in the
/// buffers. Outside files come only from the asset's own folder. Throws BrokenRule, or Error for I/O.
/// @param path  for messages, and whose folder it is
Asset loadAsset(std::vector<std::byte> bytes, const std::filesystem::path& path);

}  // namespace vasa::gltf
