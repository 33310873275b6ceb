#pragma once
#include "cli/program.h"
#include "support/shared_data.h"
#include "view/virtual_display.h"

// vasa view on a display without a screen. The pictures that it must show are in tests/view/pictures;
// scripts/golden.sh writes them anew.
namespace vasa::test {

/// The script with OUT/ standing for a folder, in a file there.
std::filesystem::path scriptIn(const std::filesystem::path& folder, std::string text);
/// A run of the program whose settings lie in `home`.
ProgramOptions on(const VirtualDisplay& display, const TemporaryFolder& home);
void checkPicture(const std::filesystem::path& found, const std::string& name);

}  // namespace vasa::test
