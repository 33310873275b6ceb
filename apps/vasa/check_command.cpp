#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "check_text.h"
#include "commands.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "frame_output.h"
#include "network/kinks.h"
#include "network/measure.h"
#include "paper_look.h"
#include "realism/clip_loads.h"
#include "report.h"
#include "scene/correction_step.h"
#include "scene/frame.h"
#include "scene_options.h"
#include "side_look.h"
#include "tissue_options.h"
#include "track_option.h"

// vasa check: what is wrong with each frame of a clip, before vessels are moved apart and after.
namespace vasa::cli {
namespace check_command {

struct Options {
  SceneOptions scene;
  std::string frames, track, method = "exact";
  double fps = 0;
  TissueOptions tissue;
  bool places = false, skinWall = false;
};

struct Setting {
  Scene scene;
  const Clip* clip = nullptr;
  Clip timing;
  FrameRange range;
};

Result<Setting> prepare(const Options& options) {
  const auto choice = chooseScene(options.scene);
  if (!choice) return choice.error();
  auto scene = loadScene(*choice);
  if (!scene) return scene.error();
  Setting setting{std::move(*scene)};
  const auto clip = sceneClip(setting.scene, *choice);
  if (!clip) return clip.error();
  setting.clip = *clip;
  auto timing = timingOf(setting.clip, options.fps);
  if (!timing) return timing.error();
  setting.timing = std::move(*timing);
  const auto range = parseFrameRange(options.frames, setting.timing.frameCount());
  if (!range) return range.error();
  setting.range = *range;
  return setting;
}

// Volumes by the vessels' points alone, whatever the solver says of them. Those that gave way (a radius at
// its least or greatest, or a narrow place) cannot keep theirs, and are told apart.
struct VolumeErrors {
  double kept = 0, gaveWay = 0;
  std::uint32_t gaveWayCount = 0;
};

VolumeErrors volumeErrors(const Network& network, std::span<const vec4> points, const Avoider& avoider,
                          Keep keep) {
  constexpr double kNegligible = 1e-4;
  VolumeErrors errors;
  std::vector<char> narrow(network.vessels().size(), 0);
  for (const NarrowPlace& place : avoider.narrowed()) narrow[place.vessel.value] = 1;
  for (std::size_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const double rest = volumeOf(network.pointsOf(vessel));
    if (!(rest > 0)) continue;
    const double error = std::abs(volumeOf(Network::pointsOf(vessel, points)) - rest) / rest;
    bool atLimit = narrow[v];
    const VolumeKeeper::Range range = VolumeKeeper::rangeOf(vessel.kind, keep);
    const std::uint32_t first = vessel.firstPoint + vessel.start.valid(),  // rings at nodes keep their radii
        end = vessel.firstPoint + vessel.pointCount - vessel.end.valid();
    for (std::uint32_t p = first; p < end; ++p) {
      const float factor = points[p].w / network.points()[p].w;
      atLimit |= factor < 1.001f * range.lowest || factor > 0.999f * range.highest;
    }
    if (atLimit && error > kNegligible)
      ++errors.gaveWayCount, errors.gaveWay = std::max(errors.gaveWay, error);
    else
      errors.kept = std::max(errors.kept, error);
  }
  return errors;
}

// The correction of each point as its surroundings see it, and how much it differs from another frame's, in
// radii at rest: what an eye would take for flicker.
class CorrectionChange {
 public:
  // 99th percentile over the points that are corrected in either frame, and the largest.
  struct Change {
    double p99 = 0, largest = 0;
  };
  Change next(const Network& network, const FrameMaker& maker) {
    std::vector<vec3> now(maker.points().size());
    std::vector<double> changes;
    for (std::size_t p = 0; p < now.size(); ++p) {
      now[p] =
          glm::conjugate(maker.rotations()[p]) * (vec3(maker.points()[p]) - vec3(maker.posedPoints()[p]));
      if (last_.empty() || (now[p] == vec3(0) && last_[p] == vec3(0))) continue;
      changes.push_back(double(glm::distance(now[p], last_[p])) /
                        std::max(double(network.points()[p].w), 1e-6));
    }
    last_ = std::move(now);
    if (changes.empty()) return {};
    const auto at = changes.begin() + std::ptrdiff_t(0.99 * double(changes.size() - 1));
    std::nth_element(changes.begin(), at, changes.end());
    return {*at, *std::max_element(at, changes.end())};
  }

 private:
  std::vector<vec3> last_;
};

// What is looked at beside the maker's own report; some of it remembers the frame before.
struct Looks {
  explicit Looks(const Network& network) : steps(network), sides(network), loads(network) {}
  CorrectionChange change;
  CorrectionSteps steps;
  SideLook sides;
  ClipLoads loads;
  std::optional<PaperLook> paper;  // with --method paper
};

// As the body alone moves the network, before vessels were moved apart.
std::vector<vec4> unmoved(const Network& network, const FrameMaker& maker, Keep keep) {
  std::vector<vec4> points(maker.posedPoints().begin(), maker.posedPoints().end());
  if (keep != Keep::radii) VolumeKeeper(network, keep).run(points);
  return points;
}

// Nothing for the first frame, which follows on none.
void addSteps(const Network& network, const std::optional<CorrectionSteps::Steps>& steps, Report& row) {
  if (!steps) return;
  row["correction_step_max_m"] = steps->largest;
  row["correction_step_excess"] = steps->excess;
  if (steps->worst)
    row["correction_step_worst"] = {{"vessel", network.vessel(steps->worst->vessel).name},
                                    {"span", steps->worst->parameter},
                                    {"step_m", steps->worst->step},
                                    {"bound_m", steps->worst->bound}};
}

// The places that are left: overlaps, changed sides with how far beyond one another's centre lines the two
// are, tubes in bones by the joint that carries the bone, and spans whose lumen gave way.
void addPlaces(const Scene& scene, const Avoider& avoider, const SideLook& sides, Report& row) {
  const Network& network = scene.network;
  const auto describe = [&](const Contact& contact, float depth) {
    const auto nameOf = [&](std::uint32_t tube) {
      return network.vessel(avoider.layout().address(tube).vessel).name;
    };
    const auto spanOf = [&](std::uint32_t tube) { return avoider.layout().address(tube).span; };
    return Report{{"vessels", {nameOf(contact.i), nameOf(contact.j)}},
                  {"spans", {spanOf(contact.i), spanOf(contact.j)}},
                  {"depth_m", depth}};
  };
  row["remaining"] = row["changed_sides"] = row["passed"] = Report::array();
  for (const Interference::Place& place : avoider.remaining())
    row["remaining"].push_back(describe(place.contact, place.excess()));
  for (const RestSides::Turned& turned : sides.changed())
    row["changed_sides"].push_back(describe(turned.at, -turned.at.f));
  for (const Passage& passage : sides.passed()) {
    const auto placeOf = [&](std::uint32_t tube, float parameter) {
      const auto [vessel, span] = avoider.layout().address(tube);
      return Report{{"vessel", network.vessel(vessel).name}, {"span", float(span) + parameter}};
    };
    row["passed"].push_back({placeOf(passage.i, passage.s), placeOf(passage.j, passage.t)});
  }
  row["in_bones"] = Report::array();
  for (const BoneContact& contact : avoider.inBones()) {
    const auto [vessel, span] = avoider.layout().address(contact.tube);
    row["in_bones"].push_back(
        {{"vessel", network.vessel(vessel).name},
         {"span", float(span) + contact.s},
         {"joint", scene.body.skeleton.joints[avoider.jointOfBone(contact.part).value].name},
         {"depth_m", contact.allowed - contact.f},
         {"allowed_m", contact.allowed}});
  }
  row["narrowed"] = Report::array();
  for (const NarrowPlace& place : avoider.narrowed())
    row["narrowed"].push_back({{"vessel", network.vessel(place.vessel).name},
                               {"span", place.span},
                               {"radius_by_rest", place.factor}});
}

Report frameReport(const Scene& scene, FrameMaker& maker, Looks& looks, std::uint32_t frame,
                   const Options& options) {
  const AvoidReport& avoid = maker.report().avoid;
  const PosedLook before = maker.lookAtPosed();
  const VolumeErrors volume =
      volumeErrors(scene.network, maker.points(), *maker.avoider(), options.tissue.kept());
  const CorrectionChange::Change change = looks.change.next(scene.network, maker);
  looks.sides.next(maker);
  Report row{{"frame", frame},
             {"contacts_before", before.vessels.contacts},
             {"contacts_after", avoid.after.contacts},
             {"depth_before_m", before.vessels.depth},
             {"depth_after_m", avoid.after.depth},
             {"certified", avoid.after.holds()},
             {"volume_error", volume.kept},
             {"volume_gave_way", volume.gaveWayCount},
             {"volume_gave_way_error", volume.gaveWay},
             {"correction_change_p99", change.p99},
             {"correction_change_max", change.largest},
             {"moved_max_m", avoid.movedMax},
             {"moved_rms_m", avoid.movedRms},
             {"kinks_before", maker.report().kinks},
             {"kinks", kinkCount(scene.network, maker.points())},
             {"sides_changed", looks.sides.changed().size()},
             {"passages_before", looks.sides.passedBefore()},
             {"passages", looks.sides.passed().size()},
             {"steps", maker.report().steps},
             {"obstacle_contacts_before", before.bones.contacts},
             {"obstacle_contacts_after", avoid.bonesAfter.contacts},
             {"obstacle_deeper_before", before.bones.deeper},
             {"obstacle_deeper_after", avoid.bonesAfter.deeper},
             {"obstacle_depth_before_m", before.bones.depth},
             {"obstacle_depth_after_m", avoid.bonesAfter.depth},
             {"skin_contacts_before", before.skinContacts},
             {"skin_contacts_after", avoid.skinContactsAfter},
             {"bone_ms", avoid.boneMs},
             {"rest_contacts", avoid.after.restContacts},
             {"narrow_spans", avoid.narrowSpans},
             {"least_lumen", avoid.leastLumen},
             {"constraints", avoid.constraints},
             {"rounds", avoid.rounds},
             {"detect_ms", avoid.detectMs},
             {"solve_ms", avoid.solveMs},
             {"certify_ms", avoid.certifyMs}};
  addSteps(scene.network, looks.steps.next(maker.posedPoints(), maker.points()), row);
  if (looks.paper) {
    const PaperLook::Pairs posed = looks.paper->at(unmoved(scene.network, maker, options.tissue.kept()));
    addPaperLook(posed, looks.paper->at(maker.points()), row);
  }
  if (options.places) addPlaces(scene, *maker.avoider(), looks.sides, row);
  return row;
}

// Of steps in excess all are counted, and the place that is told is the farthest beyond its bound.
void addStepsOfAll(const Report& frames, Report& summary) {
  if (!summary.contains("correction_step_excess")) return;
  std::uint32_t samples = 0, inFrames = 0;
  double farthest = 0;
  Report worst;
  for (const Report& frame : frames) {
    if (!frame.contains("correction_step_worst")) continue;
    samples += frame["correction_step_excess"].get<std::uint32_t>(), ++inFrames;
    const Report& place = frame["correction_step_worst"];
    const double beyond = place["step_m"].get<double>() - place["bound_m"].get<double>();
    if (beyond <= farthest) continue;
    farthest = beyond;
    worst = {{"frame", frame["frame"]}};
    worst.update(place);
  }
  summary["correction_step_excess"] = samples;
  summary["correction_step_excess_frames"] = inFrames;
  if (inFrames > 0) summary["correction_step_worst"] = worst;
}

// The worst of each number over the frames.
Report summaryOf(const Report& frames) {
  Report summary;
  std::uint32_t bad = 0, certified = 0;
  for (const Report& frame : frames) {
    certified += frame["certified"].get<bool>();
    bad += frame["contacts_after"].get<std::uint32_t>() > 0;
    for (const auto& [key, value] : frame.items()) {
      if (!value.is_number() || key == "frame") continue;
      const bool worse =
          !summary.contains(key) || (key == "least_lumen" ? value < summary[key] : value > summary[key]);
      if (worse) summary[key] = value;
    }
  }
  addStepsOfAll(frames, summary);
  for (const char* key : {"passages_before", "passages"}) {
    std::size_t sum = 0;
    for (const Report& frame : frames) sum += frame[key].get<std::size_t>();
    summary[key] = sum;
  }
  summary["certified"] = bad == 0;
  summary["frames"] = frames.size();
  summary["frames_certified"] = certified;
  summary["frames_with_penetration_after"] = bad;
  return summary;
}

// What `certified` says something of, and what it does not: bones and the skin have counts of their own.
Report certificateReport(const Avoider& avoider) {
  return {{"tubes", true},        {"rest_pairs_exempt", avoider.restPairCount()},
          {"forks_walls", false}, {"bones", false},
          {"capillaries", false}, {"skin", false}};
}

Report listOf(const Network& network, std::span<const VesselBeyond> vessels, const char* of) {
  Report list = Report::array();
  for (const VesselBeyond& vessel : vessels)
    list.push_back(
        {{"vessel", network.vessel(vessel.vessel).name}, {of, vessel.value}, {"frame", vessel.frame}});
  return list;
}

void addLoads(const Network& network, const ClipLoads& loads, Report& summary) {
  const std::vector<VesselBeyond> kinked = loads.kinked();
  summary["kinked"] = listOf(network, kinked, "bend");
  for (std::size_t k = 0; k < kinked.size(); ++k) summary["kinked"][k]["at"] = kinked[k].place;
  summary["strained"] = listOf(network, loads.strained(), "length_change");
  summary["fast"] = listOf(network, loads.fast(), "length_step");
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto setting = prepare(options);
  if (!setting) return setting.error();
  FrameOptions frameOptions{.keep = options.tissue.kept(),
                            .slide = !options.tissue.noSlide,
                            .avoid = true,
                            .avoidance = {.skinWall = options.skinWall}};
  const auto track =
      TrackFile::open(options.track, setting->scene, setting->clip, frameOptions, MotionTrack::Keeps::latest);
  if (!track) return track.error();
  FrameMaker maker(setting->scene, frameOptions);
  Report report{{"clip", setting->clip ? setting->clip->name : "rest"}, {"frames", Report::array()}};
  ProgressLine progress("checking");
  const auto [first, last] = setting->range;
  Looks looks(setting->scene.network);
  if (options.method == "paper") looks.paper.emplace(setting->scene.network);
  maker.onStep([&] { looks.sides.step(maker); });
  for (std::uint32_t frame = first; frame <= last; ++frame) {
    checkpoint();
    maker.make(setting->clip, setting->timing.timeOfFrame(frame));
    maker.onStep({});
    report["frames"].push_back(frameReport(setting->scene, maker, looks, frame, options));
    looks.loads.look(frame, maker.points(), *maker.avoider());
    progress.update(frame - first + 1, last - first + 1);
  }
  if (auto saved = track->save(); !saved) return saved;
  report["summary"] = summaryOf(report["frames"]);
  report["summary"]["kinks_at_rest"] = kinkCount(setting->scene.network, setting->scene.network.points());
  report["summary"]["excluded_pairs"] = maker.avoider()->neighbourCount();
  report["summary"]["obstacle_rest_contacts"] = maker.avoider()->restBoneContactCount();
  report["summary"]["rest_pairs"] = maker.avoider()->restPairCount();
  report["summary"]["passages_from_rest"] = looks.sides.isFromRest();
  addLoads(setting->scene.network, looks.loads, report["summary"]);
  report["summary"]["certificate"] = certificateReport(*maker.avoider());
  return globals.json ? printJson(report) : printText(checkText(report));
}

}  // namespace check_command

void addCheck(CLI::App& app, Command& command) {
  using namespace check_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand(
      "check", "Interference before and after, certificate, volume, kinks and jumps of each frame");
  sub->footer(
      "Examples:\n"
      "  vasa check --clip walk --json\n"
      "  vasa check --body b.glb --network b.vasa --clip fist --frames 20:40\n"
      "  vasa check --clip walk --fps 120 --json\n"
      "  vasa check --clip twist --method paper --threads 1\n"
      "A pair of tubes that overlaps at rest may stay as deep as it is there: rest_pairs counts these.\n"
      "obstacle_contacts: tubes in a bone or the heart that were not in it at rest; obstacle_deeper: those that were, and\n"
      "lie deeper now, but for thin tubes whose axis lay in it; obstacle_rest_contacts counts all that were at rest.\n"
      "certified: no two tubes run through one another deeper than they do at rest, by an exact query; certificate\n"
      "lists what the word covers. It says nothing of tubes that are near one another along a vessel or across a\n"
      "fork (excluded_pairs), of the walls drawn around forks, of bones (obstacle_contacts), of capillaries, nor of\n"
      "the skin (skin_contacts).\n"
      "passages: how often a vessel passes through another on the way to a frame from the one before, exactly,\n"
      "whatever overlaps in either; for the first, on all its way from rest (passages_from_rest; not with a --track that holds\n"
      "it); passages_before: if the body alone moved them.\n"
      "sides_changed: pairs near one another, at rest and now, that lie on another side of one another than at rest, by the\n"
      "angle, if only as they rolled.\n"
      "correction_step: how far the correction of a place of a vessel (two a span) is from what it was in the frame\n"
      "before. More than 1.5 mm, and more than the body alone moves any vessel near by (50 mm along each axis), looks\n"
      "like a jump: correction_step_excess counts such places, in the summary over all frames, and\n"
      "correction_step_worst is the one farthest beyond its bound.\n"
      "kinked, strained, fast: vessels that a frame bends to a kink (bend: radius by bending radius, 1 or more, and more than\n"
      "at rest), makes longer or shorter than at rest by more than 40 %, or than in the frame before by more than 5 %; each\n"
      "with its worst frame.\n"
      "--method paper looks at each frame's shapes, before and after vessels are moved apart, by the source paper's detection,\n"
      "too (a tree of spheres over line-swept spheres, tolerance 1e-3 of the body height, one thread): the pairs that it\n"
      "reports, those of them that do not intersect (paper_false_pairs), and its time beside the exact detection's.");
  addSceneOptions(*sub, options->scene);
  addTrackOption(*sub, options->track);
  sub->add_option("--frames", options->frames, "FIRST:LAST frame, both included (default: the whole clip)");
  sub->add_option("--fps", options->fps, "Frames a second to check and to number (default: the clip's own)")
      ->check(CLI::Range(0.1, 1000.0));
  sub->add_option("--method", options->method, "exact, or paper: the source paper's detection beside it")
      ->check(CLI::IsMember({"exact", "paper"}))
      ->capture_default_str();
  addTissueOptions(*sub, options->tissue);
  sub->add_flag("--skin-wall", options->skinWall,
                "Hold vessels below the skin, too; without it skin_contacts are 0");
  sub->add_flag(
      "--places", options->places,
      "Name the vessels that still interfere, passed through one another, have changed sides, are in bones or gave "
      "way in each frame");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
