#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"
#include "viewer/view_state.h"

// What is kept from one session to the next: how things are shown, not what is looked at. JSON in
// $XDG_CONFIG_HOME/vasa/view.json (~/.config where that is not set), written whole or not at all.
namespace vasa::viewer {

struct Settings {
  std::uint32_t width = 0, height = 0;  ///< [pixels] of the window; 0: unknown
  ViewState state;                      ///< only what is kept of it counts
};

/// Where settings are kept; none without a home.
std::optional<std::filesystem::path> settingsFile();

/// What a text says over what `settings` held; unknown keys and values out of range are passed over.
void readSettings(const std::string& text, Settings& settings);
std::string writeSettings(const Settings& settings);

/// From and to the file. No file: nothing changes. A file that cannot be read or written is no reason not to
/// work.
void loadSettings(Settings& settings);
Result<void> saveSettings(const Settings& settings);

}  // namespace vasa::viewer
