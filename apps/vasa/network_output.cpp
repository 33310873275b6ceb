#include "network_output.h"

#include <array>

#include "io/foreign_files.h"

namespace vasa::cli {

Result<void> checkNetworkOutput(const std::filesystem::path& file) {
  constexpr std::array kOthers{".glb", ".gltf", ".vrm", ".obj", ".stl", ".vtp",  ".vtu",  ".vtk",
                               ".swc", ".bvh",  ".csv", ".png", ".ply", ".json", ".vedit"};
  if (file == "-")
    return Error{Fault::usage, "-o -: a network is written to a file, not to standard output; name a .vasa"};
  const std::string extension = extensionOf(file);
  for (const char* other : kOthers)
    if (extension == other)
      return Error{Fault::usage,
                   file.string() + ": a network is written as .vasa; vasa export makes other files of it"};
  const std::filesystem::path folder = file.parent_path();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    return ioError(file.string() + ": is a folder; name a file in it, for example " +
                   (file / "network.vasa").string());
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
    return Error{Fault::io, file.string() + ": there is no folder " + folder.string() + "; create it first"};
  return {};
}

}  // namespace vasa::cli
