#include "output_folder.h"

namespace vasa::cli {

namespace fs = std::filesystem;

Result<void> checkOutputFolder(const fs::path& folder) {
  if (folder == "-")
    return Error{
        Fault::usage,
        "-o -: several files do not go to standard output; name a folder (./- where it is called so)"};
  return {};
}

Result<void> makeOutputFolder(const fs::path& folder) {
  if (auto checked = checkOutputFolder(folder); !checked) return checked;
  std::error_code failed;
  fs::path missing = fs::absolute(folder, failed).lexically_normal();
  while (!failed && missing.has_relative_path() && !fs::exists(missing.parent_path(), failed))
    missing = missing.parent_path();
  if (!failed && !fs::exists(missing, failed) && missing.parent_path() == missing.root_path())
    return ioError(folder.string() + ": cannot make the folder: there is no " + missing.string() +
                   "; choose one inside a folder that exists");
  if (!failed) fs::create_directories(folder, failed);
  if (failed)
    return ioError(folder.string() + ": cannot make the folder: " + failed.message() +
                   "; choose one that you may write to");
  return {};
}

}  // namespace vasa::cli
