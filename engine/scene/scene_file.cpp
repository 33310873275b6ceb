#include "scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/atomic_file.h"
#include "core/text_file.h"
#include "io/foreign_files.h"
#include "io/markups.h"

namespace vasa {
namespace {

using Json = nlohmann::json;
constexpr std::size_t kMaximumSceneBytes = 1 << 20;
constexpr int kMaximumDepth = 16;
constexpr std::size_t kMostFiles = 1000;
constexpr std::size_t kMostNames = 100'000;  // a file of 1 MiB has room for no more

// The first fault that reading meets; what follows it is not looked at.
struct BrokenRule {
  std::string place, rule;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& folder) : folder_(folder) {}

  using Field = std::function<void(const Json&, const std::string& place)>;

  void object(const Json& value, const std::string& place, const std::map<std::string, Field>& fields) {
    if (!value.is_object()) return fail(place, "must be an object");
    for (const auto& [key, item] : value.items()) {
      const auto field = fields.find(key);
      const std::string where = place + "/" + key;
      if (field == fields.end()) {
        std::vector<std::string> known;
        for (const auto& known_field : fields) known.push_back(known_field.first);
        return fail(where, fmt::format("is not a known key; use one of {}", fmt::join(known, ", ")));
      }
      field->second(item, where);
    }
  }
  Field text(std::string& out) {
    return [this, &out](const Json& value, const std::string& place) {
      if (!value.is_string()) return fail(place, "must be a string");
      out = value.get<std::string>();
    };
  }
  Field flag(bool& out) {
    return [this, &out](const Json& value, const std::string& place) {
      if (!value.is_boolean()) return fail(place, "must be true or false");
      out = value.get<bool>();
    };
  }
  template <class Out>  // float, or std::optional of it
  Field number(Out& out, float low, float high) {
    return [this, &out, low, high](const Json& value, const std::string& place) {
      const double x = value.is_number() ? value.get<double>() : NAN;
      if (!(x >= low && x <= high))
        return fail(place, "must be a number from " + Json(low).dump() + " to " + Json(high).dump());
      out = float(x);
    };
  }
  Field whole(unsigned& out, unsigned low, unsigned high) {
    return [this, &out, low, high](const Json& value, const std::string& place) {
      const double x = value.is_number_integer() ? value.get<double>() : NAN;
      if (!(x >= low && x <= high))
        return fail(place,
                    "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
      out = unsigned(x);
    };
  }
  template <class Vector>
  Field vector(std::optional<Vector>& out, float low, float high) {
    return [this, &out, low, high](const Json& value, const std::string& place) {
      Vector read;
      if (!value.is_array() || value.size() != std::size_t(read.length()))
        return fail(place, "must be a list of " + std::to_string(read.length()) + " numbers");
      for (int i = 0; i < read.length(); ++i)
        number(read[i], low, high)(value[std::size_t(i)], place + "/" + std::to_string(i));
      out = read;
    };
  }
  Field path(std::filesystem::path& out) {
    return [this, &out](const Json& value, const std::string& place) {
      std::string name;
      text(name)(value, place);
      if (name.empty()) return;
      out = folder_ / name;
      if (std::error_code ignored; std::filesystem::exists(out, ignored)) return;
      std::ranges::replace(name, '\\', '/');  // as it was written on Windows
      out = folder_ / name;
    };
  }
  Field texts(std::vector<std::string>& out, std::size_t most) {
    return [this, &out, most](const Json& value, const std::string& place) {
      if (!value.is_array() || value.size() > most)
        return fail(place, "must be a list of at most " + std::to_string(most) + " names");
      for (std::size_t i = 0; i < value.size(); ++i)
        text(out.emplace_back())(value[i], place + "/" + std::to_string(i));
    };
  }
  Field paths(std::vector<std::filesystem::path>& out) {
    return [this, &out](const Json& value, const std::string& place) {
      if (!value.is_array()) return fail(place, "must be a list of file names");
      if (value.size() > kMostFiles)
        return fail(place, "must be a list of at most " + std::to_string(kMostFiles) + " file names");
      for (std::size_t i = 0; i < value.size(); ++i) {
        const std::string where = place + "/" + std::to_string(i);
        path(out.emplace_back())(value[i], where);
        if (out.back().empty())
          return fail(where, "must name a file; leave it out of the list where there is none");
      }
    };
  }
  // Of words, the last of which is told behind "or".
  template <std::size_t count>
  void oneOf(const std::string& word, const std::string_view (&known)[count], const std::string& place) {
    if (std::ranges::find(known, word) != std::end(known)) return;
    fail(place, fmt::format("must be {} or {}", fmt::join(known, known + count - 1, ", "), known[count - 1]));
  }
  void fail(const std::string& place, const std::string& rule) {
    if (!fault) fault = BrokenRule{place, rule};
  }

  std::optional<BrokenRule> fault;

 private:
  std::filesystem::path folder_;
};

constexpr float kFar = 1000;  // [m] no camera stands further off

void readCamera(Reader& reader, const Json& value, const std::string& place, CameraChoice& camera) {
  reader.object(value, place,
                {{"view", reader.text(camera.view)},
                 {"position", reader.vector(camera.position, -kFar, kFar)},
                 {"target", reader.vector(camera.target, -kFar, kFar)},
                 {"angle", reader.number(camera.angleDegrees, 1, 150)},
                 {"distance", reader.number(camera.distanceFactor, 0.01f, 100)},
                 {"orthographic", reader.flag(camera.orthographic)},
                 {"focus", reader.text(camera.focus)}});
  reader.oneOf(camera.view, {"front", "back", "left", "right", "top"}, place + "/view");
}

void readCapillaries(Reader& reader, const Json& value, const std::string& place,
                     CapillaryChoice& capillaries) {
  reader.object(value, place,
                {{"levels", reader.whole(capillaries.levels, 0, 6)},
                 {"edges", reader.whole(capillaries.edges, 0, 10)},
                 {"budget", reader.whole(capillaries.budget, 1, 64'000'000)},
                 {"smallest", reader.number(capillaries.smallest, 0, 1000)},
                 {"rules", reader.path(capillaries.rules)}});
  constexpr std::array kEdges{0u, 3u, 5u, 8u, 10u};
  if (std::find(kEdges.begin(), kEdges.end(), capillaries.edges) == kEdges.end())
    reader.fail(place + "/edges", "must be 3, 5, 8, 10, or 0 for the size in the picture to decide");
}

void readLook(Reader& reader, const Json& value, const std::string& place, LookChoice& look) {
  reader.object(
      value, place,
      {{"preset", reader.text(look.preset)},
       {"background", reader.vector(look.background, 0, 1)},
       {"skin", reader.flag(look.skin)},
       {"bones", reader.flag(look.bones)},
       {"organs", reader.flag(look.organs)},
       {"arteries", reader.flag(look.arteries)},
       {"veins", reader.flag(look.veins)},
       {"heart", [&](const Json& v, const std::string& p) { reader.flag(look.heart.emplace())(v, p); }},
       {"artery_opacity", reader.number(look.opacity.arteries, 0, 1)},
       {"vein_opacity", reader.number(look.opacity.veins, 0, 1)},
       {"bone_opacity", reader.number(look.opacity.bones, 0, 1)},
       {"heart_opacity", reader.number(look.opacity.heart, 0, 1)},
       {"organ_opacity", reader.number(look.opacity.organs, 0, 1)},
       {"skin_opacity", reader.number(look.opacity.skin, 0, 1)},
       {"capillary_opacity", reader.number(look.opacity.capillaries, 0, 1)},
       {"colour", reader.text(look.colour)},
       {"legend", reader.flag(look.legend)}});
  reader.oneOf(look.preset, {"atlas", "clinical", "xray"}, place + "/preset");
  reader.oneOf(look.colour, {"kind", "blood", "region", "radius", "strain", "bend", "lumen"},
               place + "/colour");
}

void readViews(Reader& reader, const Json& value, const std::string& place, std::vector<ViewChoice>& views) {
  if (!value.is_object()) return reader.fail(place, "must be an object of views");
  for (const auto& [key, item] : value.items()) {  // by rising name
    const std::string where = place + "/" + key;
    if (key.size() != 1 || key[0] < '1' || key[0] > '9')
      return reader.fail(where, "is no view's number: they are called 1 to 9");
    std::optional<vec3> position, target;
    ViewChoice view{.number = unsigned(key[0] - '0')};
    reader.object(item, where,
                  {{"position", reader.vector(position, -kFar, kFar)},
                   {"target", reader.vector(target, -kFar, kFar)},
                   {"angle", reader.number(view.angleDegrees, 1, 150)},
                   {"orthographic", reader.flag(view.orthographic)}});
    if (!position || !target) return reader.fail(where, "must have a position and a target");
    view.position = *position;
    view.target = *target;
    views.push_back(view);
  }
}

void readPose(Reader& reader, const Json& value, const std::string& place, std::vector<TurnChoice>& pose) {
  if (!value.is_object()) return reader.fail(place, "must be an object of joints");
  for (const auto& [joint, turn] : value.items()) {
    std::optional<vec3> degrees, metres;
    const std::string where = place + "/" + joint;
    if (turn.is_object())
      reader.object(
          turn, where,
          {{"turn", reader.vector(degrees, -360, 360)}, {"move", reader.vector(metres, -kFar, kFar)}});
    else
      reader.vector(degrees, -360, 360)(turn, where);
    if (degrees || metres) pose.push_back({joint, degrees.value_or(vec3(0)), metres.value_or(vec3(0))});
  }
}

// Of a key that an object has twice JSON's readers keep the last one, without a word.
class KeysOnce {
 public:
  bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
    if (depth > kMaximumDepth) throw BrokenRule{"", "is nested too deeply; scenes have few levels"};
    keys_.resize(kMaximumDepth + 2);
    if (event == Json::parse_event_t::object_start) keys_[std::size_t(depth) + 1].clear();
    if (event != Json::parse_event_t::key) return true;
    const std::string key = parsed.get<std::string>();
    if (!keys_[std::size_t(depth)].insert(key).second)
      throw BrokenRule{"/" + key, " is there twice; leave one of them out"};
    return true;
  }

 private:
  std::vector<std::set<std::string>> keys_;  // of the object at each depth that is being read
};

Error noScene(const std::string& name) {
  return badInput(
      name +
      ": is no scene (.json); a body is given with --body, vessels with --network, a motion with --clip");
}

}  // namespace

bool isMotionFile(std::string_view clip) { return extensionOf(clip) == ".bvh"; }

Result<SceneFile> parseScene(const std::string& text, const std::filesystem::path& folder,
                             const std::string& name) {
  Json json;
  try {
    json = Json::parse(text, KeysOnce(), true, true);  // with exceptions, and comments as C++ has them
  } catch (const BrokenRule& broken) {
    if (extensionOf(name) != ".json") return noScene(name);
    return badInput(name + ": " + broken.place + broken.rule);
  } catch (const std::exception& error) {
    if (extensionOf(name) != ".json") return noScene(name);
    std::string what = error.what();
    what.erase(0, what.find("] ") + 2);  // "[json.exception.parse_error.101] "
    return badInput(name + ": is not valid JSON: " + what +
                    "; mend it there: words stand in double quotes, commas between two things and not behind "
                    "the last");
  }
  SceneFile scene;
  Reader reader(folder);
  reader.object(
      json, "",
      {{"body", reader.path(scene.body)},
       {"networks", reader.paths(scene.networks)},
       {"edits", reader.paths(scene.edits)},
       {"holds", reader.path(scene.holds)},
       {"clip", reader.text(scene.clip)},
       {"joint_map", reader.path(scene.jointMap)},
       {"as_recorded", reader.flag(scene.asRecorded)},
       {"camera", [&](const Json& v, const std::string& p) { readCamera(reader, v, p, scene.camera); }},
       {"look", [&](const Json& v, const std::string& p) { readLook(reader, v, p, scene.look); }},
       {"capillaries",
        [&](const Json& v, const std::string& p) { readCapillaries(reader, v, p, scene.capillaries); }},
       {"hidden", reader.texts(scene.hidden, kMostNames)},
       {"labels", reader.texts(scene.labels, kMostNames)},
       {"views", [&](const Json& v, const std::string& p) { readViews(reader, v, p, scene.views); }},
       {"time", reader.number(scene.time, 0, 1e6f)},
       {"pose", [&](const Json& v, const std::string& p) { readPose(reader, v, p, scene.pose); }},
       {"chosen", reader.text(scene.chosen)}});
  if (reader.fault)
    return badInput(name + ": " + (reader.fault->place.empty() ? "/" : reader.fault->place) + " " +
                    reader.fault->rule);
  if (isMotionFile(scene.clip)) scene.clip = (folder / scene.clip).string();
  return scene;
}

Result<SceneFile> readSceneFile(const std::filesystem::path& path) {
  if (isMarkupsFile(path)) return noScene(path.string());
  const auto bytes = readFile(path, kMaximumSceneBytes);
  if (!bytes && bytes.error().fault == Fault::badInput && extensionOf(path) != ".json")  // larger than any
    return noScene(path.string());
  if (!bytes) return bytes.error();
  std::string kept;
  const auto text =
      plainText({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string(), kept);
  if (!text) return extensionOf(path) == ".json" ? text.error() : noScene(path.string());
  auto scene = parseScene(std::string(*text), path.parent_path(), path.string());
  if (scene) scene->path = path;
  return scene;
}

}  // namespace vasa
