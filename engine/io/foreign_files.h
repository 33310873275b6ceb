#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"
#include "io/import_frame.h"

// Files that others' programs write and that are not read here, or not for this.
namespace vasa {

/// ".glb" of "Body.GLB".
std::string extensionOf(const std::filesystem::path& path);
/// .glb, .gltf, .vrm.
bool isGltfFile(const std::filesystem::path& path);

/// What other programs wrote about a file into its head.
struct ToldFrame {
  std::optional<ImportFrame::Up> up;  ///< 3D Slicer's "SPACE=LPS"
  double metresPerUnit = 0;           ///< Maya's "uses centimeters as units", Magics' "UNITS=mm", a comment
                                      ///< "units: inches", a column "x [cm]"; 0: not told
};
ToldFrame toldFrame(const std::filesystem::path& path);

enum class FileUse { vessels, body, motion };

/// What to do with such a file, by its extension: the end of a message, as "; open it in Blender ...". Empty
/// where nothing is known of it.
std::string remedyFor(const std::filesystem::path& path, FileUse use);

/// An error of reading a file, with what it is by its content where its name says another kind.
Error withTrueKind(Error error, const std::filesystem::path& path);

}  // namespace vasa
