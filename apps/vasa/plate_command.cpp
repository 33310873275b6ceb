#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <filesystem>

#include "atlas/colouring.h"
#include "atlas/scene_look.h"
#include "commands.h"
#include "core/atomic_file.h"
#include "core/log.h"
#include "core/stage_log.h"
#include "frame_output.h"
#include "gpu/device.h"
#include "gpu/error.h"
#include "io/foreign_files.h"
#include "io/png.h"
#include "loading_line.h"
#include "look_options.h"
#include "plate/plate.h"
#include "plate/plate_region.h"
#include "render/renderer.h"
#include "report.h"
#include "scene_options.h"

// vasa plate: a part of the body as a page of an atlas.
namespace vasa::cli {
namespace plate_command {

namespace fs = std::filesystem;
using plate::PlatePlan;
using plate::PlateStyle;

constexpr float kInch = 25.4f;                     // [mm]
constexpr std::uint64_t kSmallPicture = 3u << 20;  // [pixels] up to which each is drawn as four

struct Options {
  SceneOptions scene;
  std::string name, output, side = "right", view, labels = "main", page = "A4", colour = "kind", look, hide;
  std::optional<std::string> title;
  std::uint32_t frame = 0;
  double dpi = 300;
  bool noLegend = false, noScale = false;
};

struct PageChoice {
  vec2 size;
  bool mayTurn;  // a sheet of a named size lies on its side where that makes the picture larger
};

Result<PageChoice> parsePage(const std::string& text) {
  constexpr std::pair<const char*, vec2> kPages[] = {
      {"A5", {148, 210}}, {"A4", {210, 297}}, {"A3", {297, 420}}, {"letter", {215.9f, 279.4f}}};
  for (const auto& [name, size] : kPages)
    if (text == name) return PageChoice{size, true};
  vec2 size(0);
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, size.x);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == 'x') {
    const auto second = std::from_chars(first.ptr + 1, end, size.y);
    if (second.ec == std::errc() && second.ptr == end && size.x >= 60 && size.y >= 60 && size.x <= 1200 &&
        size.y <= 1200)
      return PageChoice{size, false};
  }
  return Error{Fault::usage, "--page " + text +
                                 ": give A5, A4, A3, letter or WIDTHxHEIGHT in millimetres, 60 to 1200 each"};
}

// What a page may be in pixels, as in `render`, and what its picture may take of memory.
Result<void> checkPixels(vec2 page, double dpi) {
  constexpr double kMostAcross = kMostPixelsAcross, kMost = 1u << 27;
  const double width = page.x * dpi / kInch, height = page.y * dpi / kInch;
  if (width <= kMostAcross && height <= kMostAcross && width * height <= kMost) return {};
  return Error{
      Fault::usage,
      fmt::format("--page and --dpi make a page of {:.0f} x {:.0f} pixels; at most {:g} either way and "
                  "{:.0f} million in all are drawn: give fewer --dpi",
                  width, height, kMostAcross, kMost / 1e6)};
}

enum class Form { png, svg, pdf };
Result<Form> formOf(const std::string& file) {
  const std::string ending = extensionOf(file);
  if (ending == ".png") return Form::png;
  if (ending == ".svg") return Form::svg;
  if (ending == ".pdf") return Form::pdf;
  return Error{Fault::usage, "-o " + file + ": a plate is a .png, .svg or .pdf file"};
}

const char* viewText(View view) {
  constexpr const char* kTexts[] = {"Anterior view", "Posterior view", "Left lateral view",
                                    "Right lateral view", "View from above"};
  return kTexts[int(view)];
}

Report reportOf(const PlatePlan& plan, const Options& options, const PlateStyle& style,
                const gpu::Device& device) {
  Report report{{"plate", options.name},
                {"file", options.output},
                {"page_mm", {style.page.x, style.page.y}},
                {"dpi", options.dpi},
                {"scale", plan.millimetresAMetre / 1000},
                {"labels", Report::array()},
                {"left_out", Report::array()},
                {"unseen", plan.unseen},
                {"device", device.adapter().name}};
  for (const plate::PlacedLabel& placed : plan.layout.placed)
    report["labels"].push_back({{"text", plan.labels[placed.label].text},
                                {"column", placed.right ? "right" : "left"},
                                {"port_mm", {placed.port.x, placed.port.y}},
                                {"anchor_mm", {placed.anchor.x, placed.anchor.y}}});
  for (const std::uint32_t dropped : plan.layout.dropped)
    report["left_out"].push_back(plan.labels[dropped].text);
  return report;
}

// Everything before the picture is drawn.
struct Job {
  Scene scene;
  SweepTable table;
  atlas::VesselGroups groups;
  std::unique_ptr<FrameMaker> frame;
  plate::PlateSubject subject;
  plate::FittedCamera fitted;
  Look look;
  PlateStyle style;
};

PlateStyle styleOf(const Options& options, vec2 page) {
  PlateStyle style;
  style.page = page;
  // Letters are of one size on all pages that are held in a hand; small pages have narrower margins.
  const float width = std::min(page.x, page.y);
  style.margin = std::min(10.0f, 0.06f * width);
  style.letters = std::clamp(0.0131f * width, 2.1f, 2.75f);
  style.labels = options.labels == "none" ? "" : options.labels;
  style.legend = !options.noLegend;
  style.scale = !options.noScale;
  return style;
}

// A page that is turned has to be worth it.
constexpr float kTurnGain = 1.03f;

vec2 turned(vec2 page, const PlateStyle& upright, float aspect) {
  const auto widthOn = [&](vec2 size) {
    PlateStyle style = upright;
    style.page = size;
    const vec2 room = plate::pictureRoom(style);
    return std::min(room.x, aspect * room.y);
  };
  const vec2 side(page.y, page.x);
  return widthOn(side) > kTurnGain * widthOn(page) ? side : page;
}

Result<std::unique_ptr<Job>> prepare(const Options& options) {
  auto job = std::make_unique<Job>();
  const auto page = parsePage(options.page);
  if (!page) return page.error();
  if (auto fine = checkPixels(page->size, options.dpi); !fine) return fine.error();
  job->style = styleOf(options, page->size);
  auto file = chooseScene(options.scene);
  if (!file) return file.error();
  if (auto chosen = chooseLook(file->look, options.look, options.hide); !chosen) return chosen.error();
  LoadingLine line;
  auto scene = loadScene(*file, line.told());
  if (!scene) return scene.error();
  job->scene = std::move(*scene);
  line("planning where vessels join");
  job->table = makeSweepTable(job->scene.network);
  const auto found = sceneClip(job->scene, *file);
  if (!found) return found.error();
  const Clip* clip = *found;
  if (!clip && options.frame > 0)
    return Error{
        Fault::usage,
        fmt::format("--frame {}: without a clip there is one pose, rest; add --clip NAME", options.frame)};
  if (clip && options.frame >= clip->frameCount())
    return Error{Fault::usage, fmt::format("--frame {}: the clip has frames 0 to {}", options.frame,
                                           clip->frameCount() - 1)};
  line("posing the vessels");
  job->frame = std::make_unique<FrameMaker>(job->scene, FrameOptions{.avoid = true});
  job->frame->make(clip, clip ? clip->timeOfFrame(options.frame) : 0);
  job->groups = atlas::groupsOf(job->scene);
  auto subject = plate::plateSubject(job->scene, *job->frame, options.name, options.side == "left" ? 1 : -1);
  if (!subject) return subject.error();
  job->subject = std::move(*subject);
  if (const auto view = viewNamed(options.view)) {
    const Camera camera = cameraFrom(*view, Aabb{vec3(-1), vec3(1)}, 1);
    job->subject.towards = job->subject.turn * (camera.position - camera.target);
    if (*view == View::top || !job->subject.axial) job->subject.up = job->subject.turn * camera.up;
    std::string& subtitle = job->subject.subtitle;
    std::string seen = viewText(*view);
    // "Right, palmar view": a limb's side stays.
    if (const auto comma = subtitle.find(", "); comma != subtitle.npos) {
      seen[0] = char(std::tolower(static_cast<unsigned char>(seen[0])));
      subtitle = subtitle.substr(0, comma + 2) + seen;
    } else {
      subtitle = seen;
    }
  }
  job->look = atlas::lookOf(file->look);
  if (!file->look.opacity.skin) job->look.skinOpacity = 0.2f;
  job->style.paper = vec3(job->look.background);
  job->style.title = options.title.value_or(job->subject.title);
  job->style.subtitle = job->subject.subtitle;
  std::vector<vec3> drawn;
  for (const vec4& point : job->frame->points()) drawn.emplace_back(point);
  job->fitted = plate::cameraOnto(job->subject.framed, job->subject.towards, job->subject.up, drawn);
  job->fitted.camera.cut = job->subject.cut;
  if (page->mayTurn) job->style.page = turned(page->size, job->style, job->fitted.aspect);
  return job;
}

// Colours of what is drawn.
std::vector<std::uint32_t> coloursOf(const Job& job, atlas::Colouring colouring) {
  const Network& network = job.scene.network;
  auto colours = atlas::spanColours(network, job.groups, job.frame->points(), colouring);
  atlas::leaveOut(network, job.subject.vessels, colours);
  return colours;
}

Image draw(const Job& job, const PlatePlan& plan, std::span<const std::uint32_t> colours, double dpi,
           gpu::Device& device) {
  const auto pixels = [&](float millimetres) {
    return std::uint32_t(std::max(1l, std::lround(millimetres * dpi / kInch)));
  };
  RenderOptions options{.width = pixels(plan.pictureSize.x),
                        .height = pixels(plan.pictureSize.y),
                        .pixelError = kAutoPixelError,
                        .table = &job.table,
                        .occlusion = true,
                        .timed = false};
  if (std::uint64_t(options.width) * options.height <= kSmallPicture) options.supersample = 2;
  Renderer renderer(device, job.scene.network, job.subject.meshes, options);
  renderer.setSweepColours(colours);
  renderer.draw({.points = job.frame->points(),
                 .knotFrames = job.frame->knotFrames(),
                 .jointMatrices = job.frame->jointMatrices(),
                 .camera = plan.camera,
                 .look = job.look,
                 .heartScale = job.frame->heartScale()});
  Image picture = renderer.readBack();
  plate::fadeEdges(picture, plan.cut, job.style.paper);
  return picture;
}

Result<void> write(const plate::Sheet& sheet, const Options& options, Form form,
                   const plate::Typesetter& type) {
  switch (form) {
    case Form::png: {
      const auto page = plate::sheetImage(sheet, float(options.dpi));
      if (!page) return page.error();
      return writePng(options.output, *page, {.compression = 6, .dotsPerInch = float(options.dpi)});
    }
    case Form::svg: {
      const auto text = plate::sheetSvg(sheet, type);
      if (!text) return text.error();
      return writeFileAtomically(options.output, *text);
    }
    case Form::pdf: {
      const auto bytes = plate::sheetPdf(sheet, type);
      if (!bytes) return bytes.error();
      return writeFileAtomically(options.output, *bytes);
    }
  }
  return {};
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto form = formOf(options.output);
  if (!form) return form.error();
  if (auto known = plate::checkPlateName(options.name); !known) return known.error();
  const auto type = plate::Typesetter::load();
  if (!type) return type.error();
  const auto prepared = prepare(options);
  if (!prepared) return prepared.error();
  const Job& job = **prepared;
  const auto plan = plate::planPlate(
      {job.scene, *job.frame, job.table, job.subject.meshes, job.subject.vessels, job.subject.own, job.look},
      job.style, *type, job.fitted.camera, job.fitted.aspect);
  if (!plan) return plan.error();
  for (const std::string& name : plan->unseen)
    logWarning("'" + name + "' is not seen in this picture and gets no label");
  const atlas::Colouring colouring = *atlas::colouringNamed(options.colour);
  if (auto known = atlas::checkColouring(colouring, job.groups, job.scene.body.name); !known)
    return known.error();
  const auto colours = coloursOf(job, colouring);
  const atlas::ColourLegend keys = atlas::legendOf(job.scene.network, job.groups, colouring, plan->seen);
  const auto made = gpu::attempt([&]() -> Result<Report> {
    const StageLog stage("drawing");
    gpu::Device device({.choice = globals.device});
    auto picture = std::make_shared<const Image>(draw(job, *plan, colours, options.dpi, device));
    const plate::Sheet sheet = plate::plateSheet(*plan, job.style, *type, std::move(picture), keys);
    if (auto written = write(sheet, options, *form, *type); !written) return written.error();
    return reportOf(*plan, options, job.style, device);
  });
  if (!made) return made.error();
  if (!*made) return made->error();
  if (globals.json) return printJson(**made);
  const std::size_t left = plan->layout.dropped.size();
  logInfo(fmt::format("{}: {} labels{}", options.output, plan->layout.placed.size(),
                      left ? fmt::format(", {} more had no room", left) : ""));
  return {};
}

}  // namespace plate_command

void addPlate(CLI::App& app, Command& command) {
  using namespace plate_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("plate", "A part of the body as a labelled page of an atlas: PNG, SVG, PDF");
  sub->footer(
      "Examples:\n"
      "  vasa plate front -o front.png\n"
      "  vasa plate arm --side left --labels all-visible -o arm.svg\n"
      "  vasa plate leg --body b.glb --network b.vasa --labels 'femoral artery,great saphenous vein' -o leg.pdf\n"
      "Labels name what is seen, beside the figure, with lines that do not cross; vasa help plate says which.");
  sub->add_option("PLATE", options->name, "front, back, head, brain, thorax, abdomen, arm, hand, leg or foot")
      ->required();
  addSceneOptions(*sub, options->scene);
  sub->add_option("-o,--output", options->output, "The page: .png, .svg or .pdf")->required();
  sub->add_option(
         "--labels", options->labels,
         "main (what a teacher points at first), all-visible, none, or names with commas between them")
      ->capture_default_str();
  sub->add_option("--side", options->side, "Of a limb: right or left")
      ->check(CLI::IsMember({"right", "left"}))
      ->capture_default_str();
  sub->add_option("--view", options->view,
                  "Look from front, back, left, right or top instead of as the plate does")
      ->check(CLI::IsMember({"front", "back", "left", "right", "top"}));
  sub->add_option("--page", options->page, "A5, A4, A3, letter or WIDTHxHEIGHT in millimetres")
      ->capture_default_str();
  sub->add_option("--dpi", options->dpi, "Pixels an inch of paper")
      ->check(CLI::Range(20.0, 1200.0))
      ->capture_default_str();
  sub->add_option("--title", options->title, "Instead of the plate's own; '' for none");
  sub->add_option("--colour", options->colour,
                  "What colours of vessels stand for: " + atlas::colouringsListed())
      ->check(CLI::IsMember(std::vector<std::string>(atlas::kColourings.begin(), atlas::kColourings.end())))
      ->capture_default_str();
  sub->add_option("--look", options->look, kLookHelp);
  sub->add_option("--hide", options->hide, kHideHelp);
  sub->add_option("--frame", options->frame, "Frame of the clip (--clip)")->capture_default_str();
  sub->add_flag("--no-legend", options->noLegend, "Leave out what the colours mean");
  sub->add_flag("--no-scale", options->noScale, "Leave out the scale bar");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
