#include "viewer/pose_text.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

namespace vasa::viewer {

std::string poseText(std::span<const TurnChoice> pose) {
  std::map<std::string, TurnChoice> turns;  // by name, as a scene has them
  for (const TurnChoice& turn : pose) turns[turn.joint] = turn;
  const auto list = [](vec3 value) { return fmt::format("[{:g}, {:g}, {:g}]", value.x, value.y, value.z); };
  std::string text;
  for (const auto& [joint, turn] : turns) {
    text += fmt::format("{}\n    {}: ", text.empty() ? "" : ",", nlohmann::json(joint).dump());
    text += turn.metres == vec3(0)
                ? list(turn.degrees)
                : fmt::format("{{ \"turn\": {}, \"move\": {} }}", list(turn.degrees), list(turn.metres));
  }
  return "{ \"pose\": {" + text + " } }\n";
}

Result<std::vector<TurnChoice>> poseOfText(const std::string& text) {
  auto scene = parseScene(text, {}, "what was copied");
  if (!scene) return scene.error();
  if (scene->pose.empty() && text.find("\"pose\"") == std::string::npos)
    return badInput("what was copied holds no pose: copy one with Ctrl+C while posing");
  return std::move(scene->pose);
}

}  // namespace vasa::viewer
