#include "viewer/settings.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"

namespace vasa::viewer {
namespace {

using Json = nlohmann::ordered_json;

void take(const Json& json, const char* key, bool& value) {
  if (const auto found = json.find(key); found != json.end() && found->is_boolean())
    value = found->get<bool>();
}

template <class Number>
void take(const Json& json, const char* key, Number& value, Number least, Number most) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return;
  const double number = found->get<double>();
  if (number >= double(least) && number <= double(most)) value = Number(number);
}

}  // namespace

std::optional<std::filesystem::path> settingsFile() {
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config)
    return std::filesystem::path(config) / "vasa" / "view.json";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".config" / "vasa" / "view.json";
  return std::nullopt;
}

void readSettings(const std::string& text, Settings& settings) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return;
  ViewState& state = settings.state;
  if (const auto preset = json.find("preset");
      preset != json.end() && preset->is_string() && lookNamed(preset->get<std::string>())) {
    state.preset = preset->get<std::string>();
    state.look = *lookNamed(state.preset);
  }
  take(json, "width", settings.width, 320u, 16384u);
  take(json, "height", settings.height, 240u, 16384u);
  take(json, "skin_opacity", state.look.skinOpacity, 0.0f, 1.0f);
  take(json, "bone_opacity", state.look.boneOpacity, 0.0f, 1.0f);
  take(json, "skin", state.look.drawSkin);
  take(json, "bones", state.look.drawBones);
  take(json, "panels", state.panels);
  bool orthographic = state.orbit.orthographic();
  take(json, "orthographic", orthographic);
  state.orbit.setOrthographic(orthographic);
  take(json, "automatic", state.detail.automatic);
  take(json, "around", state.detail.around, 3, 16);
  take(json, "along", state.detail.along, 2, 20);
  take(json, "fine_stills", state.fineStills);
  take(json, "avoid", state.forces.avoid);
  take(json, "volume", state.forces.volume);
  take(json, "beat", state.forces.beat);
  take(json, "loop", state.playback.loop);
  take(json, "speed", state.playback.speed, -2.0f, 2.0f);
  if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array())
    for (const Json& file : *recent)
      if (file.is_string()) state.recent.push_back(file.get<std::string>());
}

std::string writeSettings(const Settings& settings) {
  const ViewState& state = settings.state;
  const Json json{{"preset", state.preset},
                  {"width", settings.width},
                  {"height", settings.height},
                  {"skin_opacity", state.look.skinOpacity},
                  {"bone_opacity", state.look.boneOpacity},
                  {"skin", state.look.drawSkin},
                  {"bones", state.look.drawBones},
                  {"panels", state.panels},
                  {"orthographic", state.orbit.orthographic()},
                  {"automatic", state.detail.automatic},
                  {"around", state.detail.around},
                  {"along", state.detail.along},
                  {"fine_stills", state.fineStills},
                  {"avoid", state.forces.avoid},
                  {"volume", state.forces.volume},
                  {"beat", state.forces.beat},
                  {"loop", state.playback.loop},
                  {"speed", state.playback.speed},
                  {"recent", state.recent}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void loadSettings(Settings& settings) {
  const auto path = settingsFile();
  if (!path) return;
  if (const auto bytes = readFile(*path, 1 << 20))
    readSettings({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, settings);
}

Result<void> saveSettings(const Settings& settings) {
  const auto path = settingsFile();
  if (!path) return {};
  std::error_code error;
  std::filesystem::create_directories(path->parent_path(), error);
  if (error) return ioError(path->parent_path().string() + ": cannot make the folder: " + error.message());
  return writeFileAtomically(*path, writeSettings(settings));
}

}  // namespace vasa::viewer
