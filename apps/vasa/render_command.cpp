#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <future>
#include <iostream>
#include <set>

#include "atlas/colouring.h"
#include "camera_choice.h"
#include "capillary_options.h"
#include "commands.h"
#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/files_read.h"
#include "core/hash.h"
#include "core/log.h"
#include "core/parallel.h"
#include "core/stage_log.h"
#include "endings.h"
#include "frame_output.h"
#include "gpu/device.h"
#include "gpu/error.h"
#include "io/png.h"
#include "io/video.h"
#include "loading_line.h"
#include "look_options.h"
#include "output_folder.h"
#include "plate/plate.h"
#include "render/renderer.h"
#include "report.h"
#include "scene_options.h"
#include "track_option.h"

// vasa render: frames of a clip to PNG files and a video.
namespace vasa::cli {
namespace {

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
  std::uint32_t supersample = 1;
  bool beat = false;
  bool resume = false, transparent = false, noVolume = false, noSlide = false, avoid = true,
       highlightContacts = false, skinWall = false;
};

// What is to be drawn, settled before the first frame.
struct Job {
  SceneFile choice;
  Scene scene;
  const Clip* clip = nullptr;
  CameraMan camera;
  Look look;
  RenderOptions render;
  SweepTable table;
  std::unique_ptr<SceneGrowth> growth;  // none without capillaries
  FrameRange range;
  Shard shard;
  std::optional<FramePattern> pattern;  // none: raw PNG to standard output
  std::uint64_t runHash = 0;            // tells this run's pictures from another's
  PictureSize size;                     // of what is written
  std::optional<plate::PlateStyle>
      page;                 // labels beside the picture, which is smaller then than what is written
  std::vector<char> shown;  // one a vessel
  atlas::Colouring colouring = atlas::Colouring::kind;
  atlas::VesselGroups groups;
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
  FrameOptions frame{.keepVolume = !options.noVolume,
                     .slide = !options.noSlide,
                     .avoid = options.avoid || options.highlightContacts,
                     .beat = options.beat};
  frame.avoidance.skinWall = options.skinWall;
  if (!options.avoid) frame.avoidance.rounds = frame.avoidance.lumenRounds = 0;
  return frame;
}

// What was asked for, but for where the pictures go and which of them this run makes. Of files it is what
// they hold that counts (FilesRead), of a clip its poses (trackKey).
std::string settingsOf(const CLI::App& sub) {
  static const std::set<std::string> otherwise{"SCENE",       "--body",   "--network", "--clip",
                                               "--joint-map", "--growth", "--output",  "--frames",
                                               "--video",     "--shard",  "--resume",  "--track"};
  std::string settings = VASA_VERSION;
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
std::uint64_t hashOfRun(const Job& job, const Options& options, std::uint64_t seed, const FilesRead& files) {
  const std::uint64_t scene =
      job.clip ? trackKey(job.scene, *job.clip, frameOptions(options)) : hashOf(job.scene.network.points());
  const std::string run = fmt::format("{}|{:016x}|{:016x}|{}", options.settings, files.hash(), scene, seed);
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

Result<Job> prepare(const Globals& globals, const Options& options) {
  Job job;
  // What is wrong with the words themselves is told before anything is loaded.
  if (const auto pattern = FramePattern::parse(options.output, false); !pattern) return pattern.error();
  const auto size = parseSize(options.size);
  if (!size) return size.error();
  const auto quads = parseQuads(options.quads);
  if (!quads) return quads.error();
  const auto shard = parseShard(options.shard);
  if (!shard) return shard.error();
  if (auto fine = checkLabels(options); !fine) return fine.error();
  const FilesRead files;
  auto choice = chooseScene(options.scene);
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
  if (!job.choice.clip.empty()) {
    const auto clip = findClip(job.scene.body, job.choice.clip);
    if (!clip) return clip.error();
    job.clip = *clip;
  }
  const auto range = parseFrameRange(options.frames, job.clip ? job.clip->frameCount() : 1);
  if (!range) return range.error();
  if (options.output != "-" && !options.output.empty()) {
    auto pattern = FramePattern::parse(options.output, range->first != range->last);
    if (!pattern) return pattern.error();
    job.pattern = std::move(*pattern);
  }
  job.look = lookOf(job.choice.look);
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
  job.range = *range;
  job.shard = *shard;
  job.render.growth = job.growth.get();
  job.render.capillaries = wishOf(job.choice.capillaries);
  job.render.seed = std::uint32_t(globals.seed);
  job.runHash = hashOfRun(job, options, globals.seed, files);
  return job;
}

// Draws frames and hands each picture on; encoding and writing go on beside the next frame's drawing.
class Film {
 public:
  Film(const Job& job, const Options& options, const FrameOptions& frame, gpu::Device& device)
      : job_(job),
        options_(options),
        making_(makerBeside(job, frame)),
        renderer_(rendererOf(job, device)),
        maker_(making_.get()) {}

  Result<void> run() {
    ProgressLine progress("rendering");
    if (!options_.video.empty()) {
      auto video = VideoWriter::create(options_.video, job_.render.width, job_.render.height,
                                       job_.clip ? job_.clip->framesPerSecond : 30);
      if (!video) return video.error();
      video_.emplace(std::move(*video));
    }
    for (std::uint32_t frame = job_.range.first; frame <= job_.range.last; ++frame) {
      checkpoint();
      if (frame % job_.shard.count != job_.shard.index) continue;
      if (auto done = makeFrame(frame); !done) return done;
      progress.update(frame - job_.range.first + 1, job_.range.last - job_.range.first + 1);
    }
    if (auto written = finishWriting(); !written) return written;
    return video_ ? video_->finish() : Result<void>();
  }

  CapillaryCounts capillaries() const { return renderer_.capillaryCounts(); }

  std::uint32_t drawn = 0, kept = 0, steps = 0;
  float largestStep = 0;       // [m] of a control point between consecutive frames
  float largestJointStep = 0;  // [m] of a joint: what the motion itself asks for
  std::uint32_t largestStepFrame = 0;

 private:
  Result<void> makeFrame(std::uint32_t frame) {
    if (options_.resume && job_.pattern) {
      const auto present = isPresent(frame);
      if (!present) return present.error();
      if (*present) {
        ++kept;
        if (!video_) return {};
        auto picture = readPng(job_.pattern->of(frame));
        if (!picture) return picture.error();
        return video_->write(*picture);
      }
    }
    maker_->make(job_.clip, job_.clip ? job_.clip->timeOfFrame(frame) : 0);
    noteStep(frame);
    if (options_.highlightContacts)
      highlightContacts();
    else if (job_.colouring != atlas::Colouring::kind || !job_.choice.hidden.empty())
      renderer_.setSweepColours(withoutHidden(
          atlas::spanColours(job_.scene.network, job_.groups, maker_->points(), job_.colouring)));
    const Camera camera = job_.camera.at(job_.scene, maker_->pose(), maker_->points());
    renderer_.draw({.points = maker_->points(),
                    .knotFrames = maker_->knotFrames(),
                    .jointMatrices = maker_->jointMatrices(),
                    .camera = camera,
                    .look = job_.look,
                    .heartScale = maker_->heartScale()});
    ++drawn;
    if (auto written = finishWriting(); !written) return written;
    Image picture = renderer_.readBack();
    if (job_.page) {
      auto labelled = withLabels(std::move(picture), camera);
      if (!labelled) return labelled.error();
      picture = std::move(*labelled);
    }
    writing_ = std::async(std::launch::async,
                          [this, frame, done = std::move(picture)] { return write(frame, done); });
    return {};
  }

  Result<Image> withLabels(Image picture, const Camera& camera) const {
    const auto type = plate::Typesetter::load();
    if (!type) return type.error();
    const plate::PlateStyle& page = *job_.page;
    const auto plan = plate::planPlate(
        {job_.scene, *maker_, job_.table, job_.scene.body.meshes, job_.shown, job_.shown, job_.look}, page,
        *type, camera, float(picture.width) / float(picture.height));
    if (!plan) return plan.error();
    for (const std::string& name : plan->unseen)
      logWarning("'" + name + "' is not seen in this picture and gets no label");
    const auto keys = atlas::legendOf(job_.scene.network, job_.groups, job_.colouring, plan->seen);
    const plate::Sheet sheet =
        plate::plateSheet(*plan, page, *type, std::make_shared<const Image>(std::move(picture)), keys);
    return plate::sheetImage(sheet, uvec2(job_.size.width, job_.size.height));
  }

  // What the scene hides has no colour.
  std::vector<std::uint32_t> withoutHidden(std::vector<std::uint32_t> colours) const {
    atlas::leaveOut(job_.scene.network, job_.shown, colours);
    return colours;
  }

  // Grey vessels; yellow where they ran through one another, red where they still do.
  void highlightContacts() {
    maker_->lookAtPosed();
    const Avoider& avoider = *maker_->avoider();
    std::vector<std::uint32_t> colours(job_.scene.network.sweepCount(), packColour({0.5f, 0.5f, 0.55f, 1}));
    const auto paint = [&](std::span<const Interference::Place> places, vec4 colour) {
      for (const Interference::Place& place : places)
        colours[place.contact.i] = colours[place.contact.j] = packColour(colour);
    };
    paint(avoider.found(), {1, 0.75f, 0, 1});
    paint(avoider.remaining(), {1, 0, 0, 1});
    renderer_.setSweepColours(withoutHidden(std::move(colours)));
  }

  // Whether this frame's picture is there already, from the same run.
  Result<bool> isPresent(std::uint32_t frame) const {
    const auto path = job_.pattern->of(frame);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return false;
    const auto comment = readPngComment(path);
    if (comment && *comment == stamp()) return true;
    return Error{Fault::resumeMismatch,
                 path.string() +
                     ": was made by another run (other scene, clip or settings), so --resume "
                     "cannot go on from it; choose another output or leave out --resume"};
  }

  std::string stamp() const { return fmt::format("vasa run {:016x}", job_.runHash); }

  Result<void> write(std::uint32_t frame, const Image& picture) {
    if (video_)
      if (auto written = video_->write(picture); !written) return written;
    if (options_.output.empty()) return {};
    const auto bytes = encodePng(picture, {.alpha = job_.look.transparent, .comment = stamp()});
    if (!bytes) return bytes.error();
    if (job_.pattern) return writeFileAtomically(job_.pattern->of(frame), *bytes);
    return printBytes(*bytes);
  }

  Result<void> finishWriting() { return writing_.valid() ? writing_.get() : Result<void>(); }

  void noteStep(std::uint32_t frame) {
    const auto points = maker_->points();
    if (!previous_.empty() && frame == previousFrame_ + 1) {
      ++steps;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const float step = glm::distance(vec3(points[i]), vec3(previous_[i]));
        if (step > largestStep) largestStep = step, largestStepFrame = frame;
      }
      for (std::size_t j = 0; j < previousPose_.world.size(); ++j)
        largestJointStep = std::max(largestJointStep, glm::distance(vec3(maker_->pose().world[j][3]),
                                                                    vec3(previousPose_.world[j][3])));
    }
    previous_.assign(points.begin(), points.end());
    previousPose_ = maker_->pose();
    previousFrame_ = frame;
  }

  // Made on a thread of its own, unless one is to do everything.
  static std::future<std::unique_ptr<FrameMaker>> makerBeside(const Job& job, const FrameOptions& frame) {
    return std::async(threadCount() > 1 ? std::launch::async : std::launch::deferred,
                      [&job, frame, asked = CancellationScope::current()] {
                        const CancellationScope scope(asked);
                        const StageLog stage("preparing how vessels move");
                        return std::make_unique<FrameMaker>(job.scene, frame);
                      });
  }

  static Renderer rendererOf(const Job& job, gpu::Device& device) {
    const StageLog stage("preparing to draw");
    RenderOptions options = job.render;
    options.table = &job.table;
    return Renderer(device, job.scene.network, job.scene.body.meshes, options);
  }

  const Job& job_;
  const Options& options_;
  std::future<std::unique_ptr<FrameMaker>> making_;
  Renderer renderer_;
  std::unique_ptr<FrameMaker> maker_;
  std::optional<VideoWriter> video_;
  std::future<Result<void>> writing_;
  std::vector<vec4> previous_;
  Pose previousPose_;
  std::uint32_t previousFrame_ = 0;
};

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
Result<void> makeTrack(const Globals& globals, const Options& options, const Job& job) {
  FrameOptions frame = frameOptions(options);
  const auto track = TrackFile::open(options.track, job.scene, job.clip, frame);
  if (!track) return track.error();
  FrameMaker maker(job.scene, frame);
  ProgressLine progress("solving");
  const std::uint32_t count = job.range.last + 1;
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
std::string filesOf(const Job& job, const Options& options) {
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
  if (frames > 1)
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
  if (const std::filesystem::path name = options.output;
      !name.empty() && name != "-" && name.extension() != ".png" && !std::filesystem::is_character_file(name))
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
    Film work(*job, options, frame, device);
    line.reset();
    const auto done = work.run();
    // A run that is stopped keeps what it solved, too.
    if (auto saved = track->save(); !saved) return saved.error();
    if (!done) return done.error();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return Report{{"frames", work.drawn},
                  {"frames_kept", work.kept},
                  {"width", job->size.width},
                  {"height", job->size.height},
                  {"sweeps", job->scene.network.sweepCount()},
                  {"seconds", seconds},
                  {"largest_step_m", work.largestStep},
                  {"largest_step_frame", work.largestStepFrame},
                  {"largest_joint_step_m", work.largestJointStep},
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

}  // namespace

void addRender(CLI::App& app, Command& command) {
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("render", "Frames of a clip to PNG files and a video");
  sub->footer(
      "Examples:\n"
      "  vasa render --clip walk -o 'out/{frame:04}.png' --video walk.mp4\n"
      "  vasa render --body b.glb --network b.vasa --clip fist --focus LeftHand --camera left -o 'out/{frame:04}.png'\n"
      "  vasa render --clip squat --frames 30 --size 640x1280 -o - > picture.png\n"
      "  vasa render --clip walk --track walk.track    (solves the motion for later runs, draws nothing)");
  addSceneOptions(*sub, options->scene);
  addTrackOption(*sub, options->track);
  addCameraOptions(*sub, options->camera);
  addCapillaryOptions(*sub, options->capillaries);
  sub->add_option("--frames", options->frames, "FIRST:LAST frame, both included (default: the whole clip)");
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
      "Names, a legend and a scale bar beside the figure: main (large vessels), all-visible, none, or "
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
  sub->add_flag("--no-volume", options->noVolume, "Do not keep the vessels' volumes");
  sub->add_flag("--no-slide", options->noSlide, "Leave every vessel glued to its bed, point by point");
  sub->callback([options, &command, sub] {
    options->settings = settingsOf(*sub);
    command.run = [options, &command] { return run(command.globals, *options); };
  });
}

}  // namespace vasa::cli
