#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/gltf_tinygltf.h"

namespace vasa::gltf {

/// A glTF file that has passed every check of gltf_check.h: all indices, ranges and references of the model
/// hold.
struct Asset {
  std::string name;  ///< file name, for messages
  tinygltf::Model model;
  /// One a buffer: false where the file names no data (no URI), or data on a network. Such a buffer may be
  /// described, but using it is an error.
  std::vector<bool> bufferPresent;
};

/// Reads and checks a .gltf or .glb: file size and kind, container, JSON nesting, structure, then tinygltf,
/// then the data in the buffers. tinygltf sees only a document whose structure has been checked, and no file:
/// buffers come from memory, and outside files only from the asset's own folder. Throws BrokenRule, or Error
/// for I/O.
Asset loadAsset(const std::filesystem::path& path);

}  // namespace vasa::gltf
