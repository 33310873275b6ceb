#include "body/limb_clearance.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "body/joint_motion.h"
#include "body/limb_flesh.h"
#include "body/skin_field.h"
#include "body/skinning.h"
#include "core/parallel.h"
#include "math/direction.h"

namespace vasa {
namespace {

constexpr float kMostArmTurn = 0.5f, kMostLegTurn = 0.25f;  // [rad], see the header
constexpr float kReachSeconds = 0.2f;                       // to both sides, see the header
constexpr float kBeyond = 0.001f;  // [m] taken out by more than is asked, so that steps end
constexpr float kLever =
    0.1f;  // [m] a limb shorter than this is turned by less than would do: no step is wild
constexpr int kSteps = 20, kRounds = 4;

quat turnOf(vec3 turn) {
  const float angle = glm::length(turn);
  return angle > 0 ? glm::angleAxis(angle, turn / angle) : quat(1, 0, 0, 0);
}

vec3 vectorOf(quat turn) {
  if (turn.w < 0) turn = -turn;
  const vec3 v(turn.x, turn.y, turn.z);
  const float sine = glm::length(v);
  return sine > 0 ? v * (2 * std::atan2(sine, turn.w) / sine) : vec3(0);
}

// One limb in one frame.
struct LimbStance {
  vec3 top{0};    // shoulder or hip
  vec3 aside{0};  // from the other side's
  std::vector<vec3> places;
  std::vector<mat4> toRest;
  std::span<const float> unturned;  // [m] how deep the places are without a turn (Flesh::depths)
};

struct Deepest {
  float depth = 0;  // [m] beyond what it is at rest
  vec3 place{0}, outwards{0};
};

class LimbClearing {
 public:
  LimbClearing(const Body& body, const SkinnedMesh& skin, const Flesh& flesh, const LimbPlaces& limb,
               float mostTurn)
      : body_(body), skin_(skin), flesh_(flesh), limb_(limb), mostTurn_(mostTurn) {}

  // @param share  of the turn that is made
  ClearedLimb run(Clip& clip, float share) {
    ClearedLimb told{.joint = body_.skeleton.joints[limb_.top.value].name};
    const std::vector<float> times = momentsOf(clip);
    const std::size_t frames = times.size();
    unturned_.assign(frames, {});
    std::vector<float> depths(frames);
    const auto stance = [&](std::size_t f) {
      return stanceIn(samplePose(body_.skeleton, clip, times[f]), unturned_[f]);
    };
    parallelFor(frames, 1, [&](std::size_t f) { depths[f] = deepest(stance(f), vec3(0)).depth; });
    told.before = *std::ranges::max_element(depths);
    told.frames = std::uint32_t(std::ranges::count_if(depths, [](float d) { return d > kFleshGives; }));
    if (told.frames == 0) return told;
    const auto reach = std::max(1, int(std::lround(kReachSeconds * clip.framesPerSecond)));
    const bool round = closes(body_.skeleton, clip);
    std::vector<vec3> asked(frames, vec3(0)), turns = asked;
    for (int k = 0;; ++k) {
      std::atomic<bool> done = true;
      parallelFor(frames, 1, [&](std::size_t f) {
        const LimbStance here = stance(f);
        depths[f] = deepest(here, turns[f]).depth;
        if (depths[f] <= kFleshGives || k == kRounds) return;
        asked[f] = cleared(here, turns[f]);
        done = false;
      });
      if (done) break;
      turns = spread(asked, reach, round);
    }
    told.after = *std::ranges::max_element(depths);
    told.left = std::uint32_t(std::ranges::count_if(depths, [](float d) { return d > kFleshGives; }));
    for (vec3& turn : turns) told.turn = std::max(told.turn, glm::length(turn *= share));
    turnTop(clip, times, turns);
    return told;
  }

 private:
  // @param unturned  kept from one time to the next: most of the cost
  LimbStance stanceIn(const Pose& pose, std::vector<float>& unturned) const {
    const vec3 top(pose.world[limb_.top.value][3]);
    const vec3 aside =
        limb_.other.valid() ? directionOf(top - vec3(pose.world[limb_.other.value][3])) : vec3(0);
    LimbStance stance{
        top, aside, limb_.posed(skin_, skinMatrices(body_.skeleton, pose)), flesh_.toRest(pose), {}};
    if (unturned.empty()) unturned = flesh_.depths(stance.toRest, stance.places);
    stance.unturned = unturned;
    return stance;
  }

  // A place that a turn takes less far than it was from the flesh is out of it still.
  Deepest deepest(const LimbStance& stance, vec3 turn) const {
    const quat q = turnOf(turn);
    const float angle = glm::length(turn);
    Deepest found;
    for (std::size_t i = 0; i < stance.places.size(); ++i) {
      const vec3 reach = stance.places[i] - stance.top;
      if (stance.unturned[i] + angle * glm::length(reach) <= limb_.atRest[i]) continue;
      const auto at = flesh_.look(stance.toRest, stance.top + q * reach);
      if (const float depth = at.depth - limb_.atRest[i]; depth > found.depth)
        found = {depth, stance.top + q * reach, at.outwards};
    }
    return found;
  }

  // The least turn that takes the limb out, from one that does not. A hand that is most of the way through a
  // limb would leave it on the wrong side: where the nearest way out is none, it is taken aside.
  vec3 cleared(const LimbStance& stance, vec3 turn) const {
    const vec3 nearest = turnedOut(stance, turn, vec3(0));
    const float left = deepest(stance, nearest).depth;
    if (stance.aside == vec3(0) || left <= kFleshGives) return nearest;
    const vec3 aside = turnedOut(stance, turn, stance.aside);
    return deepest(stance, aside).depth < left ? aside : nearest;
  }

  vec3 turnedOut(const LimbStance& stance, vec3 turn, vec3 way) const {
    for (int k = 0; k < kSteps; ++k) {
      const Deepest at = deepest(stance, turn);
      if (at.depth <= kFleshGives) break;
      const vec3 axis = glm::cross(at.place - stance.top, way == vec3(0) ? at.outwards : way);
      const float lever = std::max(glm::dot(axis, axis), kLever * kLever);
      turn = vectorOf(turnOf(axis * ((at.depth - kFleshGives + kBeyond) / lever)) * turnOf(turn));
      if (const float angle = glm::length(turn); angle > mostTurn_) return turn * (mostTurn_ / angle);
    }
    return turn;
  }

  // The greatest turn of the frames near by, averaged over as many twice: as large as asked for everywhere,
  // and without a corner. Its axis is the mean of theirs.
  static std::vector<vec3> spread(const std::vector<vec3>& asked, int reach, bool round) {
    const int count = int(asked.size());
    const auto at = [&](const auto& items, int f) {
      if (round) f = ((f % (count - 1)) + count - 1) % (count - 1);
      return items[std::size_t(std::clamp(f, 0, count - 1))];
    };
    std::vector<float> sizes, greatest(asked.size());
    for (const vec3& turn : asked) sizes.push_back(glm::length(turn));
    for (int f = 0; f < count; ++f)
      for (int k = -reach; k <= reach; ++k)
        greatest[std::size_t(f)] = std::max(greatest[std::size_t(f)], at(sizes, f + k));
    std::vector<vec3> out(asked.size());
    for (int f = 0; f < count; ++f) {
      float size = 0, weights = 0;
      vec3 axis(0);
      for (int k = -2 * reach; k <= 2 * reach; ++k) {
        axis += float(2 * reach + 1 - std::abs(k)) * at(asked, f + k);
        if (const int w = reach + 1 - std::abs(k); w > 0)
          size += float(w) * at(greatest, f + k), weights += float(w);
      }
      out[std::size_t(f)] = directionOf(axis) * (size / weights);
    }
    return out;
  }

  // Keys at the frames: between its own keys a clip may bend otherwise, but frames are what is shown.
  void turnTop(Clip& clip, const std::vector<float>& times, const std::vector<vec3>& turns) const {
    const auto& joints = body_.skeleton.joints;
    const JointId above = joints[limb_.top.value].parent;
    Track<quat> track;
    for (std::size_t f = 0; f < turns.size(); ++f) {
      const Pose pose = samplePose(body_.skeleton, clip, times[f]);
      const quat parent = rotationOf(above.valid() ? pose.world[above.value] : body_.skeleton.rootTransform);
      const quat world = turnOf(turns[f]) * rotationOf(pose.world[limb_.top.value]);
      quat local = glm::normalize(glm::conjugate(parent) * world);
      if (!track.values.empty() && glm::dot(track.values.back(), local) < 0) local = -local;
      track.times.push_back(times[f]);
      track.values.push_back(local);
    }
    const auto of =
        std::ranges::find_if(clip.tracks, [&](const JointTracks& t) { return t.joint == limb_.top; });
    if (of != clip.tracks.end())
      of->rotation = std::move(track);
    else
      clip.tracks.push_back(
          {.joint = limb_.top, .translation = {}, .rotation = std::move(track), .scale = {}});
  }

  const Body& body_;
  const SkinnedMesh& skin_;
  const Flesh& flesh_;
  const LimbPlaces& limb_;
  float mostTurn_;
  std::vector<std::vector<float>> unturned_;  // one a frame
};

}  // namespace

std::vector<ClearedLimb> keepLimbsClear(const Body& body, std::span<Clip> clips) {
  std::vector<ClearedLimb> told;
  const SkinnedMesh* skin = skinOf(body);
  if (!skin || clips.empty()) return told;
  const Rig rig = rigOf(body.skeleton);
  const Pose rest = restPose(body.skeleton);
  const std::vector<mat4> restMatrices = skinMatrices(body.skeleton, rest);
  const auto settle = [&](LimbPlaces& limb, const Flesh& flesh) {
    const std::vector<mat4> toRest = flesh.toRest(rest);
    for (const vec3& place : limb.posed(*skin, restMatrices))
      limb.atRest.push_back(std::max(0.0f, flesh.look(toRest, place).depth));
  };
  std::vector<Clip*> looked;
  for (Clip& clip : clips)
    if (clip.frameCount() <= kMostClearedFrames) looked.push_back(&clip);

  // Legs first: arms keep clear of them as they go then. The left one makes half of the way out of the right
  // one, and that one the rest; what only one of them meets is mended last.
  if (std::vector<LimbPlaces> legs = legPlaces(body, *skin, rig); legs.size() == 2) {
    const auto fleshOf = [&](const LimbPlaces& leg) {
      std::vector<char> others = hangingOn(rig, {&leg, 1});
      for (char& other : others) other = !other;
      return Flesh(body, *skin, others);
    };
    const Flesh right = fleshOf(legs[1]), left = fleshOf(legs[0]);
    settle(legs[0], right);
    settle(legs[1], left);
    for (Clip* clip : looked) {
      ClearedLimb& both =
          told.emplace_back(LimbClearing(body, *skin, right, legs[0], 2 * kMostLegTurn).run(*clip, 0.5f));
      const ClearedLimb second = LimbClearing(body, *skin, left, legs[1], kMostLegTurn).run(*clip, 1);
      both.clip = clip->name;
      both.other = second.joint;
      both.frames = std::max(both.frames, second.frames);
      both.before = std::max(both.before, second.before);
      if (both.frames == 0) continue;
      const ClearedLimb third =
          LimbClearing(body, *skin, right, legs[0], std::max(0.0f, kMostLegTurn - both.turn)).run(*clip, 1);
      both.left = std::max(second.left, third.left);
      both.after = std::max(second.after, third.after);
      both.turn += second.turn + third.turn;
    }
  }
  std::vector<LimbPlaces> arms = armPlaces(body, *skin, rig);
  if (arms.empty()) return told;
  const Flesh flesh(body, *skin, hangingOn(rig, arms));
  for (LimbPlaces& arm : arms) settle(arm, flesh);
  for (Clip* clip : looked)
    for (const LimbPlaces& arm : arms) {
      told.push_back(LimbClearing(body, *skin, flesh, arm, kMostArmTurn).run(*clip, 1));
      told.back().clip = clip->name;
    }
  return told;
}

}  // namespace vasa
