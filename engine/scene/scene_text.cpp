#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "scene/scene_file.h"

// Scene files as text. Keys stand in the order of vasa help scenes; what is as by default is left out, so
// that a scene says what was chosen.
namespace vasa {
namespace {

using OrderedJson = nlohmann::ordered_json;

// The shortest number that reads back as this one.
OrderedJson number(float value) { return std::stod(fmt::format("{}", value)); }

template <class Vector>
OrderedJson list(const Vector& vector) {
  OrderedJson numbers = OrderedJson::array();
  for (int i = 0; i < vector.length(); ++i) numbers.push_back(number(vector[i]));
  return numbers;
}

std::string pathFrom(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto base = std::filesystem::absolute(folder.empty() ? "." : folder).lexically_normal();
  return std::filesystem::absolute(file).lexically_normal().lexically_proximate(base).generic_string();
}

// A list where nothing is moved.
OrderedJson turned(const TurnChoice& choice) {
  if (choice.metres == vec3(0)) return list(choice.degrees);
  OrderedJson json = OrderedJson::object();
  if (choice.degrees != vec3(0)) json["turn"] = list(choice.degrees);
  json["move"] = list(choice.metres);
  return json;
}

OrderedJson camera(const CameraChoice& choice) {
  const CameraChoice usual;
  OrderedJson json = OrderedJson::object();
  if (choice.view != usual.view) json["view"] = choice.view;
  if (choice.position) json["position"] = list(*choice.position);
  if (choice.target) json["target"] = list(*choice.target);
  if (choice.angleDegrees != usual.angleDegrees) json["angle"] = number(choice.angleDegrees);
  if (choice.distanceFactor != usual.distanceFactor) json["distance"] = number(choice.distanceFactor);
  if (choice.orthographic) json["orthographic"] = true;
  if (!choice.focus.empty()) json["focus"] = choice.focus;
  return json;
}

OrderedJson look(const LookChoice& choice) {
  OrderedJson json = OrderedJson::object();
  if (!choice.preset.empty()) json["preset"] = choice.preset;
  if (choice.background) json["background"] = list(*choice.background);
  const std::pair<const char*, bool> parts[] = {{"skin", choice.skin},
                                                {"bones", choice.bones},
                                                {"organs", choice.organs},
                                                {"arteries", choice.arteries},
                                                {"veins", choice.veins}};
  for (const auto& [name, shown] : parts)
    if (!shown) json[name] = false;
  if (choice.heart) json["heart"] = *choice.heart;
  const std::pair<const char*, std::optional<float>> opacities[] = {
      {"artery_opacity", choice.opacity.arteries},      {"vein_opacity", choice.opacity.veins},
      {"bone_opacity", choice.opacity.bones},           {"heart_opacity", choice.opacity.heart},
      {"organ_opacity", choice.opacity.organs},         {"skin_opacity", choice.opacity.skin},
      {"capillary_opacity", choice.opacity.capillaries}};
  for (const auto& [name, opacity] : opacities)
    if (opacity) json[name] = number(*opacity);
  if (choice.colour != LookChoice().colour) json["colour"] = choice.colour;
  if (choice.legend) json["legend"] = true;
  return json;
}

OrderedJson views(const std::vector<ViewChoice>& choices) {
  OrderedJson json = OrderedJson::object();
  for (const ViewChoice& view : choices) {
    OrderedJson& own = json[std::to_string(view.number)];
    own = {{"position", list(view.position)},
           {"target", list(view.target)},
           {"angle", number(view.angleDegrees)}};
    if (view.orthographic) own["orthographic"] = true;
  }
  return json;
}

OrderedJson capillaries(const CapillaryChoice& choice, const std::filesystem::path& folder) {
  const CapillaryChoice usual;
  OrderedJson json = OrderedJson::object();
  if (choice.levels != usual.levels) json["levels"] = choice.levels;
  if (choice.edges != usual.edges) json["edges"] = choice.edges;
  if (choice.budget != usual.budget) json["budget"] = choice.budget;
  if (choice.smallest != usual.smallest) json["smallest"] = number(choice.smallest);
  if (!choice.rules.empty()) json["rules"] = pathFrom(choice.rules, folder);
  return json;
}

}  // namespace

std::string sceneText(const SceneFile& scene, const std::filesystem::path& folder) {
  OrderedJson json = OrderedJson::object();
  const auto add = [&](const char* key, OrderedJson value) {
    if (!value.empty()) json[key] = std::move(value);
  };
  const auto names = [&](const std::vector<std::filesystem::path>& files) {
    OrderedJson all = OrderedJson::array();
    for (const auto& file : files) all.push_back(pathFrom(file, folder));
    return all;
  };
  if (!scene.body.empty()) json["body"] = pathFrom(scene.body, folder);
  add("networks", names(scene.networks));
  add("edits", names(scene.edits));
  if (!scene.holds.empty()) json["holds"] = pathFrom(scene.holds, folder);
  if (!scene.clip.empty())
    json["clip"] = isMotionFile(scene.clip) ? pathFrom(scene.clip, folder) : scene.clip;
  if (!scene.jointMap.empty()) json["joint_map"] = pathFrom(scene.jointMap, folder);
  if (scene.asRecorded) json["as_recorded"] = true;
  add("camera", camera(scene.camera));
  add("look", look(scene.look));
  add("capillaries", capillaries(scene.capillaries, folder));
  add("hidden", scene.hidden);
  if (scene.time != 0) json["time"] = number(scene.time);
  std::map<std::string, OrderedJson> pose;  // by name, as readers hand them out
  for (const TurnChoice& turn : scene.pose) pose[turn.joint] = turned(turn);
  add("pose", pose);
  if (!scene.chosen.empty()) json["chosen"] = scene.chosen;
  add("labels", scene.labels);
  add("views", views(scene.views));
  return json.dump(2) + "\n";
}

}  // namespace vasa
