#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "atlas/colouring.h"
#include "atlas/scene_look.h"
#include "camera_choice.h"
#include "capillary_options.h"
#include "commands.h"
#include "core/cancellation.h"
#include "core/files_read.h"
#include "core/hash.h"
#include "core/log.h"
#include "core/stage_log.h"
#include "endings.h"
#include "film.h"
#include "gpu/device.h"
#include "gpu/error.h"
#include "io/foreign_files.h"
#include "loading_line.h"
#include "look_options.h"
#include "output_folder.h"
#include "report.h"
#include "scene/motion_track.h"
#include "scene_options.h"
#include "tissue_options.h"
#include "track_option.h"

// vasa render: frames of a clip to PNG files and a video.
namespace vasa::cli {
namespace render_command {

struct Options {
  SceneOptions scene;
  CameraOptions camera;
  std::string frames, size = "1280x720", output, video, quads = "auto", shard, hide, track;
  CapillaryOptions capillaries;
  unsigned samples = 4;
  std::string look;                   // empty: as the scene says
  std::string labels, title, colour;  // colour empty: as the scene says
  std::string forks = "on";
  std::string settings;  // see settingsOf
  double fps = 0;        // 0: the clip's own
  std::uint32_t supersample = 1;
  bool beat = false;
  TissueOptions tissue;
  bool resume = false, transparent = false, avoid = true, highlightContacts = false, skinWall = false;
};

constexpr float kScreenDpi = 96;  // of a picture of 1280 by 720 with labels: letters of 11 pixels

// A picture with labels is a page that is held as far away as a screen.
plate::PlateStyle pageOf(const Options& options, PictureSize size, const Look& look) {
  const float dpi = kScreenDpi * std::sqrt(float(size.width) * float(size.height) / (1280.0f * 720.0f));
  plate::PlateStyle page;
  page.page = vec2(size.width, size.height) * 25.4f / dpi;
  page.margin = 5;
  page.labels = options.labels == "none" ? "" : options.labels;
  page.title = options.title;
  page.paper = vec3(look.background);
  page.wideColumns = true;
  return page;
}

Result<void> checkLabels(const Options& options) {
  if (!options.title.empty() && options.labels.empty())
    return Error{Fault::usage, "--title belongs to a picture with --labels"};
  if (options.labels.empty()) return {};
  if (!options.video.empty() || options.transparent || options.highlightContacts)
    return Error{
        Fault::usage,
        "--labels makes stills on a page: leave out --video, --transparent and --highlight-contacts"};
  return {};
}

FrameOptions frameOptions(const Options& options) {
  FrameOptions frame{.keep = options.tissue.kept(),
                     .slide = !options.tissue.noSlide,
                     .avoid = options.avoid || options.highlightContacts,
                     .beat = options.beat};
  frame.avoidance.skinWall = options.skinWall;
  if (!options.avoid) frame.avoidance.rounds = 0;
  return frame;
}

// What was asked for, but for where the pictures go and which of them this run makes. Of files it is what
// they hold that counts (FilesRead), of a clip its poses (trackKey).
std::string settingsOf(const CLI::App& sub) {
  static const std::set<std::string> otherwise{"SCENE",    "--body",   "--network", "--clip", "--joint-map",
                                               "--growth", "--output", "--frames",  "--fps",  "--video",
                                               "--shard",  "--resume", "--track"};
  std::string settings = fmt::format("{} {}", VASA_VERSION, kMotionEdition);
  for (const CLI::Option* option : sub.get_options()) {
    if (otherwise.contains(option->get_name())) continue;
    settings += fmt::format(
        "|{}={}", option->get_name(),
        option->empty() ? option->get_default_str() : fmt::format("{}", fmt::join(option->results(), " ")));
  }
  return settings;
}

// Everything that decides a picture but the frame's number. The points tell in which order networks were
// given.
std::uint64_t hashOfRun(const FilmJob& job, const Options& options, std::uint64_t seed,
                        const FilesRead& files) {
  const std::uint64_t scene =
      job.clip ? trackKey(job.scene, *job.clip, frameOptions(options)) : hashOf(job.scene.network.points());
  const std::string run = fmt::format("{}|{:016x}|{:016x}|{}|{}", options.settings, files.hash(), scene, seed,
                                      job.timing.framesPerSecond);
  return hashOf(std::span(run));
}

// All but what the scene hides.
std::vector<char> shownVessels(const SceneFile& choice, const Network& network) {
  std::vector<char> shown(network.vessels().size(), 1);
  for (const std::string& name : choice.hidden) {
    const auto found = std::ranges::find(network.vessels(), name, &Vessel::name);
    if (found == network.vessels().end())
      logWarning("'" + name + "', which the scene hides, is none of its vessels");
    for (std::size_t v = 0; v < shown.size(); ++v)
      if (network.vessels()[v].name == name) shown[v] = 0;
  }
  return shown;
}

atlas::Colouring colouringOf(const Options& options, const SceneFile& choice) {
  return *atlas::colouringNamed(options.colour.empty() ? choice.look.colour : options.colour);
}

Result<FilmJob> prepare(const Globals& globals, const Options& options) {
  FilmJob job;
  // What is wrong with the words themselves is told before anything is loaded.
  if (const auto pattern = FramePattern::parse(options.output, false); !pattern) return pattern.error();
  const auto size = parseSize(options.size);
  if (!size) return size.error();
  const auto quads = parseQuads(options.quads);
  if (!quads) return quads.error();
  const auto shard = parseShard(options.shard);
  if (!shard) return shard.error();
  if (std::max(size->width, size->height) * options.supersample > kMostPixelsAcross)
    return Error{Fault::usage,
                 fmt::format("--size {} --supersample {}: would be drawn {} pixels wide or high, and "
                             "{} is the most; make one of the two smaller",
                             options.size, options.supersample,
                             std::max(size->width, size->height) * options.supersample, kMostPixelsAcross)};
  if (options.transparent && !options.video.empty())
    return Error{Fault::usage,
                 "--transparent: videos have no alpha; write pictures (-o) alone, or leave it out"};
  if (shard->count > 1 && !options.video.empty())
    return Error{
        Fault::usage,
        "--video films every frame and --shard draws some; draw the shards' pictures with -o, then film "
        "them with the same -o, --resume and --video (vasa help clusters)"};
  if (auto fine = checkLabels(options); !fine) return fine.error();
  const FilesRead files;
  auto choice = chooseScene(options.scene, options.capillaries.rules);
  if (!choice) return choice.error();
  job.choice = std::move(*choice);
  job.choice.capillaries = chooseCapillaries(job.choice.capillaries, options.capillaries);
  const auto cameraChoice = chooseCamera(job.choice.camera, options.camera);
  if (!cameraChoice) return cameraChoice.error();
  if (auto chosen = chooseLook(job.choice.look, options.look, options.hide); !chosen) return chosen.error();
  LoadingLine line;
  auto scene = loadScene(job.choice, line.told());
  if (!scene) return scene.error();
  job.scene = std::move(*scene);
  line("planning where vessels join");
  StageLog stages("planning where vessels join");
  job.table = makeSweepTable(job.scene.network);
  if (job.choice.capillaries.levels > 0) stages.next("preparing capillaries"), line("preparing capillaries");
  auto growth = growthOf(job.scene, job.choice.capillaries, job.table);
  stages.end();
  if (!growth) return growth.error();
  job.growth = std::move(*growth);
  const auto clip = sceneClip(job.scene, job.choice);
  if (!clip) return clip.error();
  job.clip = *clip;
  auto timing = timingOf(job.clip, options.fps);
  if (!timing) return timing.error();
  job.timing = std::move(*timing);
  const auto range = parseFrameRange(options.frames, job.timing.frameCount());
  if (!range) return range.error();
  if (options.output != "-" && !options.output.empty()) {
    auto pattern = FramePattern::parse(options.output, range->first != range->last);
    if (!pattern) return pattern.error();
    job.pattern = std::move(*pattern);
  }
  job.look = atlas::lookOf(job.choice.look);
  job.look.transparent = options.transparent;
  job.size = *size;
  float aspect = float(size->width) / float(size->height);
  vec2 pixels(size->width, size->height);
  if (!options.labels.empty()) {
    if (range->first != range->last)
      return Error{Fault::usage,
                   "--labels draws stills: labels would jump in a film; choose one with --frames N"};
    job.page = pageOf(options, *size, job.look);
    const vec2 room = plate::pictureRoom(*job.page);
    aspect = room.x / room.y;
    pixels = glm::max(glm::round(room * float(size->width) / job.page->page.x), vec2(1));
  }
  job.shown = shownVessels(job.choice, job.scene.network);
  job.colouring = colouringOf(options, job.choice);
  if (job.colouring != atlas::Colouring::kind || job.page) job.groups = atlas::groupsOf(job.scene);
  if (auto known = atlas::checkColouring(job.colouring, job.groups, job.scene.body.name); !known)
    return known.error();
  auto camera = CameraMan::create(*cameraChoice, job.scene, job.clip, aspect);
  if (!camera) return camera.error();
  job.camera = std::move(*camera);
  job.render = {.width = std::uint32_t(pixels.x),
                .height = std::uint32_t(pixels.y),
                .samples = options.samples,
                .shape = {quads->around, quads->along},
                .pixelError = quads->pixelError,
                .forks = options.forks == "on",
                .supersample = options.supersample,
                .occlusion = true,
                .timed = false};
  job.printed = options.output == "-";
  job.video = options.video;
  job.resume = options.resume;
  job.highlightContacts = options.highlightContacts;
  job.range = *range;
  job.shard = *shard;
  job.render.growth = job.growth.get();
  job.render.capillaries = wishOf(job.choice.capillaries);
  job.render.seed = std::uint32_t(globals.seed);
  job.runHash = hashOfRun(job, options, globals.seed, files);
  return job;
}

// Folders are made when there is something to put into them.
Result<void> makeFolders(const Options& options) {
  for (const std::string& name : {options.output, options.video, options.track}) {
    const auto folder = std::filesystem::path(name).parent_path();
    if (name == "-" || folder.empty() || folder.string().find('{') != std::string::npos) continue;
    if (auto made = makeOutputFolder(folder); !made) return made;
  }
  return {};
}

// Without pictures or a video: the motion alone is solved and kept, which takes no Vulkan device.
Result<void> makeTrack(const Globals& globals, const Options& options, const FilmJob& job) {
  FrameOptions frame = frameOptions(options);
  const auto track = TrackFile::open(options.track, job.scene, job.clip, frame);
  if (!track) return track.error();
  FrameMaker maker(job.scene, frame);
  ProgressLine progress("solving");
  // The clip's own frames, up to the first that is no earlier than the last one asked for.
  const float last = job.timing.timeOfFrame(job.range.last) - job.clip->start;
  const std::uint32_t count = std::min(std::uint32_t(std::ceil(last * job.clip->framesPerSecond - 1e-3f)) + 1,
                                       job.clip->frameCount());
  std::uint32_t solved = 0;
  setPatience(kPatienceToSave);  // what is solved is kept, so frames are left whole
  const CancellationScope fromWithin(nullptr);
  for (; solved < count && !stopRequested(); ++solved) {
    maker.make(job.clip, job.clip->timeOfFrame(solved));
    progress.update(solved + 1, count);
  }
  if (auto saved = track->save(); !saved) return saved;
  if (solved < count) return stopError();
  if (globals.json) return printJson({{"track", options.track}, {"frames", solved}});
  return {};
}

// "a.png", "f/000.png to f/033.png and film.mp4"
std::string filesOf(const FilmJob& job, const Options& options) {
  std::string files = options.output == "-" ? "standard output" : "";
  if (job.pattern) {
    files = job.pattern->of(job.range.first).string();
    if (job.range.first != job.range.last) files += " to " + job.pattern->of(job.range.last).string();
  }
  if (!options.video.empty()) files += (files.empty() ? "" : " and ") + options.video;
  return files;
}

std::string summaryOf(const Report& report, const std::string& files) {
  const auto frames = report["frames"].get<std::uint32_t>(),
             kept = report["frames_kept"].get<std::uint32_t>();
  std::string text = fmt::format("{}: {} {} in {:.1f} s", files, frames, frames == 1 ? "picture" : "pictures",
                                 report["seconds"].get<double>());
  if (kept > 0) text += fmt::format(", {} kept", kept);
  if (frames > 1 && report["largest_step_m"].is_number())
    text += fmt::format("; largest step between frames: {:.1f} mm of a control point, {:.1f} mm of a joint",
                        1e3 * report["largest_step_m"].get<double>(),
                        1e3 * report["largest_joint_step_m"].get<double>());
  return text;
}

Result<void> run(const Globals& globals, const Options& options) {
  if (options.output.empty() && options.video.empty() && options.track.empty())
    return Error{Fault::usage, "nothing to write; give -o 'frame_{frame:04}.png', --video film.mp4, or both"};
  if (options.output == "-" && globals.json)
    return Error{Fault::usage, "-o - and --json both want standard output; leave out one"};
  // A device takes what it is given.
  if (const std::filesystem::path name = options.output; !name.empty() && name != "-" &&
                                                         extensionOf(name) != ".png" &&
                                                         !std::filesystem::is_character_file(name))
    return Error{Fault::usage, "-o " + options.output + ": pictures are PNG files; end the name in .png"};
  auto job = prepare(globals, options);
  if (!job) return job.error();
  if (options.output == "-" && job->range.first != job->range.last)
    return Error{Fault::usage, "-o - writes one picture; choose it with --frames N"};
  if (auto made = makeFolders(options); !made) return made;
  if (options.output.empty() && options.video.empty()) return makeTrack(globals, options, *job);
  const auto start = std::chrono::steady_clock::now();
  const auto film = gpu::attempt([&]() -> Result<Report> {
    StageLog stages("opening the device");
    gpu::Device device({.choice = globals.device});
    stages.end();
    logDetail("device: " + device.adapter().name);
    FrameOptions frame = frameOptions(options);
    const auto track =
        TrackFile::open(options.track, job->scene, job->clip, frame, MotionTrack::Keeps::latest);
    if (!track) return track.error();
    std::optional<LoadingLine> line(std::in_place);
    (*line)("preparing to draw");
    Film work(*job, frame, device);
    line.reset();
    const auto done = work.run();
    // A run that is stopped keeps what it solved, too.
    if (auto saved = track->save(); !saved) return saved.error();
    if (!done) return done.error();
    // A shard's frames are no neighbours: there is no step between them to tell.
    const auto ofNeighbours = [&](auto step) {
      return job->shard.count == 1 ? Report(step) : Report(nullptr);
    };
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return Report{{"frames", work.drawn},
                  {"frames_kept", work.kept},
                  {"width", job->size.width},
                  {"height", job->size.height},
                  {"sweeps", job->scene.network.sweepCount()},
                  {"seconds", seconds},
                  {"largest_step_m", ofNeighbours(work.largestStep)},
                  {"largest_step_frame", ofNeighbours(work.largestStepFrame)},
                  {"largest_joint_step_m", ofNeighbours(work.largestJointStep)},
                  {"capillaries", work.capillaries().curves},
                  {"capillary_trees", work.capillaries().trees},
                  {"capillary_bytes", work.capillaries().bytes},
                  {"device", device.adapter().name}};
  });
  if (!film) return film.error();
  if (!*film) return film->error();
  const Report& report = **film;
  if (globals.json) return printJson(report);
  logInfo(summaryOf(report, filesOf(*job, options)));
  return {};
}

}  // namespace render_command

void addRender(CLI::App& app, Command& command) {
  using namespace render_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("render", "Frames of a clip to PNG files and a video");
  sub->footer(
      "Examples:\n"
      "  vasa render --clip walk -o 'out/{frame:04}.png' --video walk.mp4\n"
      "  vasa render --body b.glb --network b.vasa --clip fist --focus LeftHand --camera left -o 'out/{frame:04}.png'\n"
      "  vasa render --clip squat --frames 30 --size 640x1280 -o - > picture.png\n"
      "  vasa render --clip run --fps 120 --video slow.mp4    (four frames for each of the clip's)\n"
      "  vasa render --clip walk --track walk.track    (solves the motion for later runs, draws nothing)");
  addSceneOptions(*sub, options->scene);
  addTrackOption(*sub, options->track);
  addCameraOptions(*sub, options->camera);
  addCapillaryOptions(*sub, options->capillaries);
  sub->add_option("--frames", options->frames, "FIRST:LAST frame, both included (default: the whole clip)");
  sub->add_option("--fps", options->fps, "Frames a second to draw and to number (default: the clip's own)")
      ->check(CLI::Range(0.1, 1000.0));
  sub->add_option("--size", options->size, "Picture size in pixels")->capture_default_str();
  sub->add_option("-o,--output", options->output,
                  "PNG files, e.g. 'out/{frame:04}.png'; - writes one PNG to standard output");
  sub->add_option("--video", options->video, "Video file (.mp4, .mov, .mkv, .webm), made by ffmpeg");
  sub->add_option("--quads", options->quads,
                  "Quads around and along every sweep, MxN; auto: by its size on the picture, to 0.25 pixels")
      ->capture_default_str();
  sub->add_option("--samples", options->samples, "Samples a pixel: 1 or 4")
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  sub->add_option("--forks", options->forks,
                  "on: vessels join smoothly; off: they end inside one another, to compare")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  sub->add_option("--supersample", options->supersample,
                  "Draw each pixel of the picture as NxN, 1 to 4: for stills")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  sub->add_flag("--beat", options->beat, "The heart beats as the clip goes on");
  sub->add_option("--look", options->look, kLookHelp);
  sub->add_option("--hide", options->hide, kHideHelp);
  sub->add_option(
      "--labels", options->labels,
      "Names, a legend and a scale bar beside the figure: main (the important ones), all-visible, none, or "
      "names with commas between them; for stills (vasa help plate)");
  sub->add_option("--title", options->title, "Title of a picture with labels");
  sub->add_option("--colour", options->colour,
                  "What colours of vessels stand for (default: as the scene says, else kind): " +
                      atlas::colouringsListed())
      ->check(CLI::IsMember(std::vector<std::string>(atlas::kColourings.begin(), atlas::kColourings.end())));
  sub->add_option("--shard", options->shard,
                  "i/n: draw every n-th frame from the i-th, to share a film among processes");
  sub->add_flag("--resume", options->resume,
                "Keep pictures that an earlier, stopped run of the same command made");
  sub->add_flag("--transparent", options->transparent, "Pictures with alpha instead of a background");
  sub->add_flag("--avoid,!--no-avoid", options->avoid,
                "Move vessels apart that run through one another or through bones (the default)");
  sub->add_flag("--highlight-contacts", options->highlightContacts,
                "Vessels grey; yellow where they ran through one another, red where they still do");
  sub->add_flag("--skin-wall", options->skinWall, "Hold vessels below the skin, too");
  addTissueOptions(*sub, options->tissue);
  sub->callback([options, &command, sub] {
    options->settings = settingsOf(*sub);
    command.run = [options, &command] { return run(command.globals, *options); };
  });
}

}  // namespace vasa::cli
