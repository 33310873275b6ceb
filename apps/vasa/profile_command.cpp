#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "camera_choice.h"
#include "capillary_options.h"
#include "collide/box_tree.h"
#include "collide/network_tubes.h"
#include "collide/sphere_tree.h"
#include "commands.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "frame_output.h"
#include "gpu/device.h"
#include "gpu/error.h"
#include "network/file.h"
#include "render/profiler.h"
#include "report.h"
#include "scene_options.h"

// vasa profile: the paper's Tables I to III on this machine. Each row draws a clip's changing poses at one
// resolution, and beside it the same triangles from ready vertex buffers (render/profiler.h).
namespace vasa::cli {
namespace profile_command {

constexpr const char* kMeasured =
    "frame_ms: from one picture to the next, while the next pose is solved on another thread; latency_ms: from a pose to its "
    "finished picture; stages, solve_ms and picture_ms: one after the other, nothing beside them";

struct Options {
  SceneOptions scene;
  CameraOptions camera;
  std::string quads = "4x5,4x10,8x5,8x10", size = "1280x720";
  std::uint32_t frames = 40;
  unsigned samples = 1;
  CapillaryOptions capillaries;
  bool body = false, avoid = true, cull = true;
};

struct Setting {
  Scene scene;
  CapillaryChoice capillaries;
  std::unique_ptr<SceneGrowth> growth;  // none without capillaries
  const Clip* clip = nullptr;
  CameraMan camera;
  Look look;
  PictureSize size;
  std::vector<Quads> quads;
};

Report asReport(const ProfileRow& measured, bool growing) {
  Report row{{"quads", measured.name()}, {"sweeps", measured.sweeps}, {"triangles", measured.triangles}};
  for (const auto& [name, value] : measured.stages) row[name] = value;
  if (growing) {
    row["capillaries"] = measured.capillaries.curves;
    row["capillary_trees"] = measured.capillaries.trees;
    row["capillary_bytes"] = measured.capillaries.bytes;
  }
  // The picture decides, and leaves no others.
  if (measured.quads.pixelError > 0) row["triangles"] = row["triangles_drawn"];
  row["fps"] = measured.fps();
  row["template_bytes"] = measured.templateBytes;
  return row;
}

ProfileSetting profileSetting(const Setting& setting, const Options& options) {
  return {.scene = &setting.scene,
          .clip = setting.clip,
          .meshes = options.body ? std::span<const SkinnedMesh>(setting.scene.body.meshes)
                                 : std::span<const SkinnedMesh>(),
          .render = {.width = setting.size.width,
                     .height = setting.size.height,
                     .samples = options.samples,
                     .cull = options.cull,
                     .growth = setting.growth.get(),
                     .capillaries = wishOf(setting.capillaries)},
          .look = setting.look,
          .camera =
              [&setting](const FrameMaker& maker) {
                return setting.camera.at(setting.scene, maker.pose(), maker.points());
              },
          .avoid = options.avoid,
          .frames = options.frames};
}

// What the network, its binding and the trees of detection (the paper's and ours) take, beside the triangle
// mesh that would have to be stored at 8x5 instead (paper, Tables I, II).
Report storageReport(const Scene& scene) {
  const SweepShape shape{8, 5};
  const std::size_t sweeps = scene.network.sweepCount(), vessels = scene.network.vessels().size();
  const std::size_t vertices = (sweeps * shape.along + vessels) * shape.around;
  const std::size_t triangles = 2 * sweeps * shape.along * shape.around;
  const NetworkTubes layout(scene.network);
  std::vector<Bezier> tubes(layout.count());
  layout.shape(scene.network.points(), tubes);
  return {{"network_bytes", encodeNetwork(scene.network).size()},
          {"network_quantised_bytes", encodeNetwork(scene.network, {.quantise = true}).size()},
          {"binding_bytes", scene.binding.bytes()},
          {"sphere_tree_bytes", SphereTree(tubes).bytes()},
          {"box_tree_bytes", BoxTree(tubes).bytes()},
          {"mesh_bytes", vertices * sizeof(vec3) + triangles * sizeof(uvec3)}};
}

std::string asText(const Report& report) {
  std::string text = fmt::format("{}, {}\n{}\n\n", report["device"].get<std::string>(),
                                 report["size"].get<std::string>(), kMeasured);
  const Report& rows = report["rows"];
  for (const auto& [name, unused] : rows.front().items())
    text += fmt::format("{:>{}}", name, std::max<std::size_t>(name.size() + 2, 9));
  text += "\n";
  for (const Report& row : rows) {
    for (const auto& [name, value] : row.items()) {
      const std::string cell = value.is_string()         ? value.get<std::string>()
                               : value.is_number_float() ? fmt::format("{:.2f}", value.get<double>())
                                                         : value.dump();
      text += fmt::format("{:>{}}", cell, std::max<std::size_t>(name.size() + 2, 9));
    }
    text += "\n";
  }
  text += "\n";
  for (const auto& [name, value] : report["storage"].items())
    text += fmt::format("{:<26}{:>12}\n", name, value.dump());
  return text;
}

Result<Setting> prepare(const Options& options) {
  Setting setting;
  std::stringstream list(options.quads);
  for (std::string item; std::getline(list, item, ',');) {
    const auto quads = parseQuads(item);
    if (!quads) return quads.error();
    setting.quads.push_back(*quads);
  }
  const auto size = parseSize(options.size);
  if (!size) return size.error();
  setting.size = *size;
  auto choice = chooseScene(options.scene, options.capillaries.rules);
  if (!choice) return choice.error();
  const auto cameraChoice = chooseCamera(choice->camera, options.camera);
  if (!cameraChoice) return cameraChoice.error();
  auto scene = loadScene(*choice);
  if (!scene) return scene.error();
  setting.scene = std::move(*scene);
  setting.capillaries = chooseCapillaries(choice->capillaries, options.capillaries);
  auto growth = growthOf(setting.scene, setting.capillaries);
  if (!growth) return growth.error();
  setting.growth = std::move(*growth);
  if (choice->clip.empty() && !setting.scene.body.clips.empty())
    choice->clip = setting.scene.body.clips.front().name;
  const auto clip = sceneClip(setting.scene, *choice);
  if (!clip) return clip.error();
  setting.clip = *clip;
  auto camera =
      CameraMan::create(*cameraChoice, setting.scene, setting.clip, float(size->width) / float(size->height));
  if (!camera) return camera.error();
  setting.camera = *camera;
  return setting;
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto setting = prepare(options);
  if (!setting) return setting.error();
  const auto report = gpu::attempt([&] {
    gpu::Device device({.choice = globals.device});
    Report all{{"device", device.adapter().name},
               {"size", options.size},
               {"clip", setting->clip ? setting->clip->name : "rest"},
               {"frames", options.frames},
               {"cull", options.cull},
               {"measured", kMeasured},
               {"rows", Report::array()}};
    std::vector<ProfileQuads> quads;
    for (const Quads& each : setting->quads) quads.push_back({{each.around, each.along}, each.pixelError});
    Profiler profiler(device, profileSetting(*setting, options), quads);
    ProgressLine progress("profiling");
    while (profiler.step()) {
      progress.update(profiler.done(), profiler.total());
      checkpoint();
    }
    for (const ProfileRow& row : profiler.rows())
      all["rows"].push_back(asReport(row, setting->growth != nullptr));
    all["storage"] = storageReport(setting->scene);
    return all;
  });
  if (!report) return report.error();
  return globals.json ? printJson(*report) : printText(asText(*report));
}

}  // namespace profile_command

void addProfile(CLI::App& app, Command& command) {
  using namespace profile_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("profile", "How long each stage takes at several tessellations");
  sub->footer(
      "Examples:\n  vasa profile\n  vasa profile --body b.glb --network b.vasa --clip walk --quads 4x5,8x10 --json");
  addSceneOptions(*sub, options->scene);
  addCameraOptions(*sub, options->camera);
  addCapillaryOptions(*sub, options->capillaries);
  sub->add_option("--quads", options->quads, "Tessellations, MxN or auto, with commas between")
      ->capture_default_str();
  sub->add_option("--size", options->size, "Picture size in pixels")->capture_default_str();
  sub->add_option("--frames", options->frames, "Frames to take the median of, each another pose")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  sub->add_option("--samples", options->samples, "Samples a pixel: 1 or 4")
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  sub->add_flag("--avoid,!--no-avoid", options->avoid, "Move vessels apart, too (the default)");
  sub->add_flag("--cull,!--no-cull", options->cull,
                "Leave out triangles that cannot be seen (the default); the paper draws them all");
  sub->add_flag("--with-body", options->body, "Draw the body's meshes too");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
