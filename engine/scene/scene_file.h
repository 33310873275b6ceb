#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "math/types.h"

namespace vasa {

/// Where to look from: one of the named views, or a place and a target.
struct CameraChoice {
  std::string view = "front";    ///< front, back, left, right, top; ignored when position is given
  std::optional<vec3> position;  ///< [m]
  std::optional<vec3> target;    ///< [m]; default: the middle of the scene
  float angleDegrees = 30;       ///< vertical opening
  std::string focus;             ///< name of a vessel to fill the picture with; empty: the whole scene
  float distanceFactor = 1;      ///< 1: the subject just fits
  bool orthographic = false;     ///< without perspective: what is at the target keeps its size
};

/// In [0, 1]; default: the preset's.
struct OpacityChoice {
  std::optional<float> arteries, veins, bones, heart, organs, skin, capillaries;
};

/// What is shown and how.
struct LookChoice {
  std::string preset = "atlas";    ///< atlas, clinical or xray
  std::optional<vec4> background;  ///< sRGB 0..1 and opacity; default: the preset's
  bool skin = true, bones = true, organs = true, arteries = true, veins = true;
  std::optional<bool> heart;  ///< default: as organs
  OpacityChoice opacity;
  std::string colour =
      "kind";           ///< what vessels' colours tell: kind, blood, region, radius, strain, bend or lumen
  bool legend = false;  ///< of the colours, in the app
};

/// Which capillaries grow from the vessels (growth/plan.h).
struct CapillaryChoice {
  unsigned levels = 0;          ///< generations; 0: none
  unsigned edges = 0;           ///< of a capillary's polyline: 3, 5, 8, 10; 0: by its size in the picture
  unsigned budget = 4'000'000;  ///< most of them in a picture
  float smallest = 0.5f;        ///< [pixels] generations that are shorter are left out
  std::filesystem::path rules;  ///< folder with capillaries.lsys and regions.csv; empty: the program's own
};

/// How far a joint is turned beside what the clip does with it: bend, spread and twist, as the app has them;
/// and how far the pelvis is moved.
struct TurnChoice {
  std::string joint;
  vec3 degrees{0};
  vec3 metres{0};
};

/// A view that is kept under a number: of the app.
struct ViewChoice {
  unsigned number = 1;          ///< 1 to 9
  vec3 position{0}, target{0};  ///< [m]
  float angleDegrees = 30;      ///< vertical opening
  bool orthographic = false;

  bool operator==(const ViewChoice&) const = default;
};

/// What a scene is made of. JSON, all keys optional, paths relative to the file:
///   { "body": "body.glb", "networks": ["arteries.vasa", "veins.vasa"], "edits": ["lesions.vedit"],
///     "holds": "holds.csv", "clip": "walk" | "walk.bvh", "joint_map": "joints.txt", "as_recorded": false,
///     "camera": { "view": "front" | "position": [x,y,z], "target": [x,y,z], "angle": 30, "focus": "aorta",
///     "orthographic": true },
///     "look": { "preset": "atlas" | "clinical" | "xray", "background": [r,g,b,a], "skin": true, "bones":
///     true, "organs": true, "arteries": true, "veins": true,
///               "heart": true, "skin_opacity": 0.3 (likewise artery, vein, bone, heart, organ and
///               capillary), "colour": "kind" | "blood" | "region" | "radius" | "strain" | "bend" | "lumen",
///               "legend": true },
///     "capillaries": { "levels": 3, "edges": 0 | 3 | 5 | 8 | 10, "budget": 4000000, "smallest": 0.5,
///     "rules": "folder" },
///     "hidden": ["left great saphenous vein"],
///     "time": 1.5, "pose": { "LeftForeArm": [bend, spread, twist], "Hips": { "turn": [0,0,0], "move":
///     [x,y,z] } }, "chosen": "aorta",
///     "labels": ["coeliac trunk"],
///     "views": { "1": { "position": [x,y,z], "target": [x,y,z], "angle": 30, "orthographic": true } } }
struct SceneFile {
  std::filesystem::path body;  ///< empty: vessels alone, which nothing moves
  std::vector<std::filesystem::path> networks;
  std::vector<std::filesystem::path>
      edits;  ///< journals (edit/journal.h), replayed in order onto all networks together
  std::filesystem::path
      holds;         ///< where vessels are held in their beds (scene/holds.h); empty: at forks alone
  std::string clip;  ///< a clip's name or the beginning of it, or a .bvh file
  std::filesystem::path jointMap;  ///< pairs of joints for a .bvh file (io/bvh.h); empty: by name
  bool asRecorded = false;         ///< limbs that pass through the body stay there (body/limb_clearance.h)
  CameraChoice camera;
  LookChoice look;
  CapillaryChoice capillaries;
  std::vector<std::string> hidden;  ///< names of vessels that pictures leave out
  float time = 0;                   ///< [s] in the clip, where the app begins
  std::vector<TurnChoice> pose;     ///< of the app; by the joint's name
  std::string chosen;               ///< name of the vessel that is chosen in the app; empty: none
  std::vector<std::string> labels;  ///< names of vessels that the app writes beside them
  std::vector<ViewChoice> views;    ///< by rising number
  std::filesystem::path path;       ///< the scene file itself; empty: there is none
};

/// Whether a clip is meant that a file of its own holds.
bool isMotionFile(std::string_view clip);

/// Reads a scene file. badInput names the JSON place and the rule: malformed JSON, an unknown key, a wrong
/// type, a number that is not finite or out of range, more than 1 MiB, 1000 networks, or 16 levels of
/// nesting. Text as plainText() (core/text_file.h) has it: UTF-16 is refused by name.
Result<SceneFile> readSceneFile(const std::filesystem::path& path);

/// The same from text. @param folder  that relative paths start from; @param name  for messages
Result<SceneFile> parseScene(const std::string& text, const std::filesystem::path& folder,
                             const std::string& name);

/// The text that parseScene() reads as this scene: every key that is not its default, paths relative to the
/// folder. A scene that was read from such a text gives the same bytes.
std::string sceneText(const SceneFile& scene, const std::filesystem::path& folder);

}  // namespace vasa
