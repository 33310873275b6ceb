#include <stdexcept>

#include "golden/gallery.h"
#include "network/measure.h"
#include "render/renderer.h"
#include "scene/frame.h"
#include "scene/growth.h"

namespace vasa::golden {
namespace {

template <class T>
T taken(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

// What a renderer makes of it is made once for all pictures, too.
struct Human {
  Scene scene;
  SweepTable table;
  SceneGrowth growth;
  BodyLevels levels;
};

const Human& human() {
  static const Human loaded = [] {
    SceneFile file;
    file.body = VASA_GOLDEN_DATA "/human.glb";
    file.networks = {VASA_GOLDEN_DATA "/human.vasa"};
    file.holds = VASA_GOLDEN_DATA "/human.holds.csv";
    Scene scene = taken(loadScene(file));
    SweepTable table = makeSweepTable(scene.network);
    SceneGrowth growth = taken(loadGrowth(scene, VASA_GOLDEN_DATA "/growth", table));
    BodyLevels levels = bodyLevels(scene.body.meshes, &scene.body.skeleton);
    return Human{std::move(scene), std::move(table), std::move(growth), std::move(levels)};
  }();
  return loaded;
}

struct HumanShot {
  const char* preset = "atlas";
  const char* clip = "";
  std::uint32_t frame = 0;
  View view = View::front;
  const char* subject = "";      // a joint to look at; none: the whole body
  float around = 0.12f;          // [m] how much about it
  const char* parts = "abhosv";  // arteries, bones, heart, other organs, skin, veins
  std::uint32_t growLevels = 0;
  bool transparent = false, occlusion = true, beating = false;
  float boneOpacity = 1, skinOpacity = -1;  // below 0: the preset's
  bool avoid = false;                       // vessels are moved apart
};

Look lookOf(const HumanShot& shot) {
  Look look = *lookNamed(shot.preset);
  const std::string_view parts(shot.parts);
  look.drawArteries = parts.find('a') != std::string_view::npos;
  look.drawBones = parts.find('b') != std::string_view::npos;
  look.drawHeart = parts.find('h') != std::string_view::npos;
  look.drawOther = parts.find('o') != std::string_view::npos;
  look.drawSkin = parts.find('s') != std::string_view::npos;
  look.drawVeins = parts.find('v') != std::string_view::npos;
  look.transparent = shot.transparent;
  if (!shot.occlusion) look.occlusion = 0;
  look.boneOpacity = shot.boneOpacity;
  if (shot.skinOpacity >= 0) look.skinOpacity = shot.skinOpacity;
  return look;
}

std::size_t jointNamed(std::string_view name) {
  const auto& joints = human().scene.body.skeleton.joints;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].name == name) return j;
  throw std::runtime_error("no joint " + std::string(name));
}

Aabb boxOf(const HumanShot& shot, const FrameMaker& maker) {
  const Scene& scene = human().scene;
  if (*shot.subject) {
    Aabb close;
    close.add(vec3(maker.pose().world[jointNamed(shot.subject)][3]), shot.around);
    return close;
  }
  Aabb box = measure(scene.network, maker.points()).bounds;
  for (const mat4& joint : maker.pose().world) box.add(vec3(joint[3]), 0.08f);
  return box;
}

Image draw(gpu::Device& device, const HumanShot& shot) {
  const Human& all = human();
  FrameMaker maker(all.scene, {.avoid = shot.avoid, .beat = shot.beating});
  const Clip* clip = *shot.clip ? taken(findClip(all.scene.body, shot.clip)) : nullptr;
  maker.make(clip, clip ? clip->timeOfFrame(shot.frame) : 0.14f);
  // A body stands upright.
  const std::uint32_t width = *shot.subject ? kWidth : kHeight, height = kWidth + kHeight - width;
  Renderer renderer(device, all.scene.network, all.scene.body.meshes,
                    {.width = width,
                     .height = height,
                     .pixelError = kAutoPixelError,
                     .levels = &all.levels,
                     .skeleton = &all.scene.body.skeleton,
                     .table = &all.table,
                     .supersample = 2,
                     .occlusion = true,
                     .growth = shot.growLevels ? &all.growth : nullptr,
                     .capillaries = {.levels = shot.growLevels},
                     .timed = false});
  renderer.draw({.points = maker.points(),
                 .knotFrames = maker.knotFrames(),
                 .jointMatrices = maker.jointMatrices(),
                 .camera = cameraFrom(shot.view, boxOf(shot, maker), float(width) / float(height)),
                 .look = lookOf(shot),
                 .heartScale = maker.heartScale()});
  return renderer.readBack();
}

Picture ofHuman(std::string name, const HumanShot& shot) {
  return {std::move(name), [shot](gpu::Device& device) { return draw(device, shot); }};
}

}  // namespace

std::vector<Picture> humanPictures() {
  return {
      ofHuman("parts/arteries", {.parts = "a"}),
      ofHuman("parts/veins", {.parts = "v"}),
      ofHuman("parts/bones", {.parts = "b"}),
      ofHuman("parts/heart", {.subject = "Spine1", .parts = "hav"}),
      ofHuman("parts/heart_beating", {.subject = "Spine1", .parts = "hav", .beating = true}),
      ofHuman("parts/organs", {.subject = "Spine", .around = 0.24f, .parts = "ahov"}),
      ofHuman("parts/skin", {.parts = "s"}),
      ofHuman("presets/atlas", {.view = View::left, .subject = "Head"}),
      ofHuman("presets/clinical", {.preset = "clinical", .subject = "Head"}),
      ofHuman("presets/xray", {.preset = "xray", .subject = "Head"}),
      ofHuman("presets/flat", {.subject = "Spine1", .occlusion = false}),
      ofHuman("presets/transparent", {.subject = "Spine1", .transparent = true}),
      ofHuman("poses/front", {}),
      ofHuman("poses/left", {.view = View::left}),
      ofHuman("poses/back", {.view = View::back}),
      ofHuman("poses/walk", {.clip = "walk", .frame = 9}),
      ofHuman("poses/squat", {.clip = "squat", .frame = 30, .view = View::left}),
      ofHuman("poses/fist", {.clip = "fist", .frame = 20, .view = View::left, .subject = "LeftHandFinger2"}),
      ofHuman("poses/top", {.view = View::top, .parts = "abhov"}),
      ofHuman("poses/run", {.clip = "run", .frame = 5, .view = View::right}),
      ofHuman("poses/arms_overhead", {.clip = "arms_overhead", .frame = 60, .view = View::back}),
      ofHuman("poses/moved_apart", {.clip = "stand",
                                    .frame = 0,
                                    .subject = "LeftForeArm",
                                    .around = 0.06f,
                                    .parts = "av",
                                    .avoid = true}),
      ofHuman("opacity/bones", {.subject = "Spine1", .parts = "abv", .boneOpacity = 0.4f}),
      ofHuman("opacity/skin", {.view = View::left, .subject = "Head", .skinOpacity = 0.9f}),
      ofHuman("regions/hand", {.subject = "LeftHandFinger2", .parts = "ab", .growLevels = 2}),
      ofHuman("regions/foot", {.subject = "LeftToeBase", .parts = "ab", .growLevels = 2}),
      ofHuman("regions/head", {.subject = "Head", .parts = "abo", .growLevels = 3}),
  };
}

std::vector<Picture> humanMutations() {
  return {
      ofHuman("parts/arteries", {.parts = "av"}),
      ofHuman("presets/clinical", {.preset = "atlas", .subject = "Head"}),
      ofHuman("poses/walk", {.clip = "walk", .frame = 13}),
      ofHuman("regions/head", {.subject = "Head", .parts = "abo", .growLevels = 2}),
  };
}

}  // namespace vasa::golden
