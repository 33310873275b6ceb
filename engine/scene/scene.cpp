#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "body/axial_bones.h"
#include "body/belonging.h"
#include "body/clip_reach.h"
#include "body/retarget.h"
#include "core/cancellation.h"
#include "core/letters.h"
#include "core/log.h"
#include "core/nearest_names.h"
#include "core/stage_log.h"
#include "edit/replay.h"
#include "io/bvh.h"
#include "io/foreign_files.h"
#include "io/gltf.h"
#include "network/measure.h"
#include "network/merge.h"
#include "scene/holds.h"
#include "scene/make_scene.h"
#include "scene/vessel_files.h"

namespace vasa {
namespace {

// Items whose name is `wanted`, or else those that contain it, in their order.
template <class Items>
std::vector<std::uint32_t> numbersNamed(const Items& items, const std::string& wanted) {
  std::vector<std::uint32_t> partial;
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    const std::string name = lowerCase(items[i].name);
    if (name == wanted) return {i};
    if (name.find(wanted) != std::string::npos) partial.push_back(i);
  }
  return partial;
}

template <class Items>
void addNames(const Items& items, std::vector<std::string>& names) {
  for (const auto& item : items) names.push_back(item.name);
}

// The first joint with more than one child, as a rule the hips: some rigs have joints above it that stay
// behind.
std::size_t firstFork(const Skeleton& skeleton) {
  std::vector<int> children(skeleton.joints.size(), 0);
  std::vector<std::size_t> only(skeleton.joints.size(), 0);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    if (const JointId parent = skeleton.joints[j].parent; parent.valid())
      ++children[parent.value], only[parent.value] = j;
  std::size_t at = 0;
  while (children[at] == 1) at = only[at];
  return children[at] > 1 ? at : 0;
}

void addJoints(Aabb& box, const Pose& pose, vec3 way = vec3(0)) {
  for (const mat4& world : pose.world) box.add(vec3(world[3]) - way);
}

// A motion file's clip bears the file's name as it was given.
Result<void> addMotion(const SceneFile& file, Body& body) {
  const auto motion = readBvh(file.clip);
  if (!motion) return motion.error();
  JointMap map;
  if (!file.jointMap.empty()) {
    auto read = readJointMap(file.jointMap);
    if (!read) return read.error();
    map = std::move(*read);
  }
  auto done = retargeted(*motion, body, map);
  if (!done) return done.error();
  const std::string match = file.clip + ": " + describeMatch(*done);
  if (done->sureness < kLeastSureness || !done->stands)
    logWarning(match);  // a map is taken at its word
  else
    logInfo(match);
  if (!staysNear(body.skeleton, done->clip)) {
    float jump = std::numeric_limits<float>::infinity();  // as where a tracker lost its person
    for (const JointTracks& tracks : done->clip.tracks)
      for (std::size_t key = 1; key < tracks.translation.values.size(); ++key)
        if (glm::distance(tracks.translation.values[key - 1], tracks.translation.values[key]) >
            kFarthestReach / 2)
          jump = std::min(jump, tracks.translation.times[key]);
    return badInput(fmt::format(
        "{}: takes the body farther than a kilometre from where it rests; {}", file.clip,
        std::isfinite(jump) ? fmt::format("leave out the frames that jump there, from frame {:.0f} on",
                                          jump * done->clip.framesPerSecond)
                            : "check the unit of its positions"));
  }
  body.clips.push_back(std::move(done->clip));
  return {};
}

Result<Network> replayJournals(const Network& network, std::span<const std::filesystem::path> journals) {
  std::vector<Edit> edits;
  for (const auto& path : journals) {
    auto read = readJournal(path);
    if (!read) return read.error();
    std::ranges::move(*read, std::back_inserter(edits));
  }
  return editNetwork(network, edits);
}

// Holds go by names: what an edit renamed or cut off is held no more.
void tellFreed(const Network& edited, std::span<const VesselHold> holds) {
  std::string freed;
  for (const VesselHold& hold : holds)
    if (std::ranges::find(edited.vessels(), hold.vessel, &Vessel::name) == edited.vessels().end())
      freed += (freed.empty() ? "" : ", ") + hold.vessel;
  if (!freed.empty())
    logWarning("after the edits no vessel bears these names, and none is held there: " + freed);
}

// Of vessels that stand alone: one joint, which nothing moves.
Body noBody() {
  Body body;
  body.name = "no body";
  body.skeleton.joints.emplace_back().name = "vessels";
  return body;
}

}  // namespace

Result<Body> loadBody(const SceneFile& file) {
  if (file.body.empty()) return noBody();
  auto body = readBody(file.body);
  if (!body || !isMotionFile(file.clip)) return body;
  if (auto added = addMotion(file, *body); !added) return added.error();
  return body;
}

namespace {

// Two vessels in one place press one another to threads, and all of them count as overlapping at rest.
bool isToldAgain(const Network& network, const std::filesystem::path& path, std::span<const Network> earlier,
                 std::span<const std::filesystem::path> paths) {
  const std::size_t count = network.vessels().size();
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    const std::size_t shared = sharedVessels(network, earlier[i]);
    if (shared == 0) continue;
    if (shared == count) {
      logWarning(path.string() + ": tells the same vessels as " + paths[i].string() + ", and is left out");
      return true;
    }
    logWarning(path.string() + ": " + std::to_string(shared) + " of its " + std::to_string(count) +
               " vessels are in " + paths[i].string() +
               ", too, and lie in one another; give each vessel once");
  }
  return false;
}

}  // namespace

Result<Scene> loadScene(const SceneFile& file, const ReadingProgress& told) {
  StageLog stages;
  const auto tell = [&](const char* what) {
    checkpoint();
    stages.next(what);
    if (told) told(what, 0, 0);
  };
  tell("reading the body");
  auto body = loadBody(file);
  if (!body) return body.error();
  std::vector<Network> networks;
  std::vector<std::filesystem::path> paths;
  for (const auto& path : file.networks) {
    tell("reading vessels");
    auto network = readVessels(path, body->height(), told);
    if (!network) return network.error();
    if (file.networks.size() > 1 && !file.body.empty())
      if (const auto near = checkNear(*body, network->points(), path.filename().string()); !near)
        return near.error();
    if (isToldAgain(*network, path, networks, paths)) continue;
    networks.push_back(std::move(*network));
    paths.push_back(path);
  }
  tell("binding vessels to the body");
  std::string names;
  for (const auto& path : paths) names += (names.empty() ? "" : ", ") + path.filename().string();
  return makeScene(std::move(*body), std::move(networks), file, names);
}

Result<Scene> makeScene(Body body, std::vector<Network> networks, const SceneFile& file,
                        std::string_view names) {
  auto network =
      networks.size() == 1 ? Result<Network>(std::move(networks.front())) : mergeNetworks(networks);
  std::vector<VesselHold> holds;
  if (network && !file.holds.empty()) {
    auto read = readHolds(file.holds, *network);
    if (!read) return read.error();
    holds = std::move(*read);
  }
  if (network && !file.edits.empty()) network = replayJournals(*network, file.edits);
  if (network) tellFreed(*network, holds);
  if (!network) return network.error();
  separateAxialBones(body);
  auto binding = vasa::bind(body, *network, names);
  if (!binding) return binding.error();
  return Scene{std::move(body), std::move(*network), std::move(*binding), std::move(holds)};
}

Result<const Clip*> findClip(const Body& body, std::string_view name) {
  const Clip* found = nullptr;
  bool several = false;
  std::string list, begun;
  std::vector<std::string> names;
  for (const Clip& clip : body.clips) {
    list += (list.empty() ? "" : ", ") + clip.name;
    names.push_back(clip.name);
    if (clip.name == name) return &clip;
    if (!clip.name.starts_with(name)) continue;
    begun += (begun.empty() ? "" : ", ") + clip.name;
    several = found != nullptr;
    found = &clip;
  }
  const std::string quoted = "clip '" + std::string(name) + "'";
  if (several)
    return badInput(body.name + ": " + quoted +
                    " is the beginning of several names; write more of it: " + begun);
  if (!found) {
    const std::string near = didYouMean(std::string(name), names),
                      remedy = remedyFor(std::filesystem::path(name), FileUse::motion);
    return badInput(body.name + " has no " + quoted + "; " + near + (near.empty() ? "" : " ") +
                    (list.empty()   ? "it has no clips at all"
                     : near.empty() ? "it has " + list
                                    : "It has " + list) +
                    (remedy.empty() ? "; --clip takes .bvh files, too" : remedy));
  }
  return found;
}

std::string describeLimb(const ClearedLimb& limb) {
  const bool legs = !limb.other.empty();
  const std::string what =
      fmt::format("{} up to {:.0f} mm in {} in {} frames",
                  legs ? limb.joint + " and " + limb.other + " lie" : limb.joint + " lies",
                  1000 * limb.before, legs ? "one another" : "the body", limb.frames);
  const float degrees = glm::degrees(limb.turn);
  if (limb.left == 0)
    return fmt::format("{}, and {} by up to {:.1f} degrees", what,
                       legs ? "are turned apart" : "is turned out of it", degrees);
  return fmt::format(
      "{}, and still in {} of them after a turn by {:.1f} degrees: vessels there are held aside", what,
      limb.left, degrees);
}

std::vector<ClearedLimb> clearLimbs(const SceneFile& file, const Body& body, std::span<Clip> clips) {
  if (file.asRecorded) return {};
  for (const Clip& clip : clips)
    if (clip.frameCount() > kMostClearedFrames)
      logWarning(fmt::format(
          "{}: of more than {} frames, so that limbs are left as they are, also where they pass through the body",
          clip.name, kMostClearedFrames));
  std::vector<ClearedLimb> limbs = keepLimbsClear(body, clips);
  std::erase_if(limbs, [](const ClearedLimb& limb) { return limb.frames == 0; });
  for (const ClearedLimb& limb : limbs) {
    const std::string text = limb.clip + ": " + describeLimb(limb);
    limb.left == 0 ? logInfo(text + "; --as-recorded leaves it") : logWarning(text);
  }
  return limbs;
}

Result<const Clip*> clipOf(const Body& body, const SceneFile& file) {
  return file.clip.empty() ? Result<const Clip*>(nullptr) : findClip(body, file.clip);
}

Result<const Clip*> sceneClip(Scene& scene, const SceneFile& file) {
  auto found = clipOf(scene.body, file);
  if (!found || !*found) return found;
  clearLimbs(file, scene.body,
             std::span(scene.body.clips).subspan(std::size_t(*found - scene.body.clips.data()), 1));
  return found;
}

Result<Subject> findSubject(const Scene& scene, std::string_view name) {
  const std::string wanted = lowerCase(name);
  const auto& vessels = scene.network.vessels();
  const auto& joints = scene.body.skeleton.joints;
  const auto subject = [](const auto& items, const std::vector<std::uint32_t>& found, Subject first) {
    for (std::size_t i = 1; i < found.size(); ++i) first.others.push_back(items[found[i]].name);
    return first;
  };
  if (const auto found = numbersNamed(vessels, wanted); !found.empty())
    return subject(vessels, found, {.vessel = {found.front()}, .joint = {}, .others = {}});
  if (const auto found = numbersNamed(joints, wanted); !found.empty())
    return subject(joints, found, {.vessel = {}, .joint = {found.front()}, .others = {}});
  std::vector<std::string> names;
  addNames(vessels, names);
  addNames(joints, names);
  return badInput("no vessel and no joint is named '" + std::string(name) + "'; " +
                  didYouMean(std::string(name), names, "vasa info NET.vasa --vessels lists the vessels"));
}

Aabb subjectBounds(const Scene& scene, const Subject& subject, const Pose& pose,
                   std::span<const vec4> points) {
  Aabb box;
  if (subject.joint.valid()) {
    box.add(vec3(pose.world[subject.joint.value][3]), scene.body.height() / 14);
    return box;
  }
  for (const vec4& p : Network::pointsOf(scene.network.vessel(subject.vessel), points)) box.add(vec3(p), p.w);
  return box;
}

vec3 wayOverFloor(const Scene& scene, const Pose& pose) {
  if (pose.world.empty()) return vec3(0);
  const std::size_t trunk = firstFork(scene.body.skeleton);
  const vec3 way = vec3(pose.world[trunk][3]) - vec3(scene.body.skeleton.joints[trunk].restWorld[3]);
  return {way.x, 0, way.z};
}

Aabb motionBounds(const Scene& scene, const Clip* clip) {
  Aabb rest, joints, moving;
  for (const SkinnedMesh& mesh : scene.body.meshes) rest.add(mesh.mesh.bounds());
  rest.add(measure(scene.network, scene.network.points()).bounds);
  addJoints(joints, restPose(scene.body.skeleton));
  for (std::uint32_t frame = 0; clip && frame < clip->frameCount(); ++frame) {
    const Pose pose = samplePose(scene.body.skeleton, *clip, clip->timeOfFrame(frame));
    addJoints(moving, pose, wayOverFloor(scene, pose));
  }
  if (!clip) moving = joints;
  moving.low += glm::min(rest.low - joints.low, vec3(0));
  moving.high += glm::max(rest.high - joints.high, vec3(0));
  return moving;
}

}  // namespace vasa
