#include "body/retarget.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "body/motion_rest.h"
#include "body/rest_alignment.h"
#include "body/rest_stance.h"
#include "body/rig.h"
#include "core/ids.h"

// Rotations are kept relative to a pose in which the motion's skeleton stands (its zero pose, as a rule), in
// world axes: Q = world · standing⁻¹. A joint that follows has Q_body = Q_motion · A, with A the constant
// turn that brings the body's rest pose to the motion's standing one.
namespace vasa {
namespace {

constexpr std::size_t kLeastJoints = 6;
constexpr float kKneeCapShare = 0.6f;
constexpr float kFloorShare = 0.05f;  // of the frames may have a foot lower than the floor, a little
constexpr std::uint32_t kFramesCompared = 12;
constexpr float kWordsSure = 0.95f, kShapeSure = 0.8f;  // a known convention: 1
constexpr float kStiffSure = 0.8f;                      // where the trunk is not followed
constexpr float kDoubtedTurnsSure = 0.7f;               // limbs point elsewhere, and nobody knows how far
constexpr float kNoStandSure = 0.7f;                    // where the pose compared with rest may be any
constexpr float kTurnedRoundSure = 0.4f;                // where joints stand the other way round
constexpr float kGoodAngle = 10, kLostAngle = 60;  // [degrees] between limbs: as good as right, and wrong

class Retargeter {
 public:
  Retargeter(const Motion& motion, const Body& body)
      : given_(motion), body_(body), from_(rigOf(motion)), to_(rigOf(body.skeleton)) {}

  Result<Retargeting> run(const JointMap& map) {
    auto matched = pairJoints(from_, to_, map, given_.name, body_.name);
    if (!matched) return matched.error();
    source_ = std::move(matched->source), spread_ = std::move(matched->spread);
    const auto count =
        std::size_t(std::ranges::count_if(source_, [](std::uint32_t s) { return s != kNone; }));
    hips_ = hipsOf();
    const std::string remedy =
        "; `vasa map BODY MOTION -o map.txt` lists the joints of both and the pairs that it finds, to be mended by hand "
        "and given with --joint-map";
    if (count < kLeastJoints)
      return badInput(body_.name + " and " + given_.name + " have " + std::to_string(count) +
                      " joints in common, fewer than " + std::to_string(kLeastJoints) + remedy);
    if (hips_ == kNone)
      return badInput(body_.name + " has no joint that follows the hips of " + given_.name + remedy);
    partsFromSource();
    stand();
    measureScale();
    Retargeting out;
    out.clip = makeClip();
    out.source = source_;
    describe(out, !map.empty());
    if (map.empty() && out.sureness < kLeastSureness)
      return badInput(given_.name + " does not fit " + body_.name + ": " + describeMatch(out) +
                      ", less than the " + std::to_string(int(std::lround(100 * kLeastSureness))) +
                      " % that is asked for" + remedy);
    return out;
  }

 private:
  // Turns the motion upright and brings the body's rest pose to the one in which it stands.
  void stand() {
    up_ = upOf(given_, from_.parts.of);
    if (up_ != vec3(0, 1, 0)) turned_ = withUp(given_, up_);
    standing_ = standingPose(motion(), from_.parts.of);
    const MotionPose pose = motionPose(motion(), standing_);
    placeIn(from_, pose);
    const RestStance stance(from_.parts.of);
    const vec3 stretched = stance.up(pose);
    stands_ = stretched == vec3(0) || stance.stands(pose, stretched);
    standingTurns_ = pose.world;
    alignment_ = alignRest(motion(), standing_, standingTurns_, from_, to_, source_);
  }
  const Motion& motion() const { return turned_ ? *turned_ : given_; }

  // The hips, or the first joint that follows one which moves.
  std::uint32_t hipsOf() const {
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] != kNone && (to_.parts.of[j] == "hips" || from_.parts.of[source_[j]] == "hips"))
        return j;
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] != kNone && (given_.joints[source_[j]].moves || from_.parents[source_[j]] == kNone))
        return j;
    return kNone;
  }

  // Joints that only the map knows are the parts that their counterparts are.
  void partsFromSource() {
    const auto spread = [&](std::uint32_t j) {
      return std::ranges::find(spread_.shares, j, &TrunkShare::joint) != spread_.shares.end();
    };
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (spread(j))
        continue;
      else if (source_[j] != kNone && to_.parts.of[j].empty())
        to_.parts.of[j] = from_.parts.of[source_[j]];
      else if (source_[j] != kNone && from_.parts.of[source_[j]].empty())
        from_.parts.of[source_[j]] = to_.parts.of[j];
  }

  // Legs where both have them, else the skeletons' heights.
  void measureScale() {
    const float own = legsOf(to_), theirs = legsOf(from_);
    if (own > 0 && theirs > 0)
      scale_ = own / theirs;
    else if (extentOf(from_) > 0)
      scale_ = extentOf(to_) / extentOf(from_);
  }

  // Turns relative to rest of all of the body's joints.
  std::vector<quat> bodyTurns(const MotionPose& frame) const {
    std::vector<quat> turns(source_.size(), kIdentity), theirs(frame.world.size());
    for (std::size_t s = 0; s < theirs.size(); ++s)
      theirs[s] = frame.world[s] * glm::conjugate(standingTurns_[s]);
    for (std::uint32_t j = 0; j < source_.size(); ++j) {
      if (source_[j] != kNone)
        turns[j] = glm::normalize(theirs[source_[j]] * alignment_[j]);
      else if (to_.parents[j] != kNone)
        turns[j] = turns[to_.parents[j]];
    }
    turnTrunk(spread_, theirs, alignment_, turns);
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] == kNone && to_.parents[j] != kNone) settleFree(j, turns);
    return turns;
  }

  void settleFree(std::uint32_t j, std::vector<quat>& turns) const {
    const std::uint32_t parent = to_.parents[j];
    turns[j] = turns[parent];
    for (std::uint32_t k = 0; k < source_.size(); ++k) {
      if (source_[k] == kNone) continue;
      const bool sibling = to_.parents[k] == parent && to_.centres[k] == to_.centres[j];
      if (sibling)
        turns[j] =
            turns[parent] * glm::slerp(kIdentity, glm::conjugate(turns[parent]) * turns[k], kKneeCapShare);
      const bool roll = to_.parents[k] == j && to_.parts.of[k].ends_with("Hand") &&
                        to_.parts.of[parent].ends_with("LowerArm");
      if (!roll) continue;
      const quat turn = glm::conjugate(turns[parent]) * turns[k];
      const vec3 axis = directionOf(to_.centres[k] - to_.centres[j]);
      const float along = glm::dot(vec3(turn.x, turn.y, turn.z), axis);
      const quat twist(turn.w, axis * along);
      if (glm::length(twist) > 1e-6f) turns[j] = turns[parent] * glm::normalize(twist);
    }
  }

  Clip makeClip() {
    Clip clip;
    clip.name = given_.name;
    clip.framesPerSecond = given_.framesPerSecond;
    std::vector<JointTracks> tracks(source_.size());
    for (std::uint32_t j = 0; j < source_.size(); ++j) {
      tracks[j].joint = {j};
      restRotations_.push_back(rotationOf(body_.skeleton.joints[j].restWorld));
    }
    std::vector<vec3> hips;
    std::vector<float> lowest;
    for (std::uint32_t frame = 0; frame < given_.frameCount; ++frame) {
      const MotionPose source = motionPose(motion(), frame);
      const std::vector<quat> turns = bodyTurns(source);
      for (std::uint32_t j = 0; j < source_.size(); ++j) {
        const quat above = to_.parents[j] == kNone ? rotationOf(body_.skeleton.rootTransform)
                                                   : turns[to_.parents[j]] * restRotations_[to_.parents[j]];
        quat local = glm::normalize(glm::conjugate(above) * turns[j] * restRotations_[j]);
        auto& values = tracks[j].rotation.values;
        if (!values.empty() && glm::dot(values.back(), local) < 0) local = -local;
        values.push_back(local);
      }
      hips.push_back(scale_ * source.places[source_[hips_]]);
      lowest.push_back(lowestFoot(turns) + hips.back().y);
    }
    placeHips(hips, lowest, tracks[hips_].translation);
    std::vector<float> times;
    for (std::uint32_t frame = 0; frame < given_.frameCount; ++frame)
      times.push_back(float(double(frame) / double(given_.framesPerSecond)));
    clip.end = times.back();
    tracks[hips_].translation.times = times;
    for (JointTracks& track : tracks) {
      track.rotation.times = times;
      clip.tracks.push_back(std::move(track));
    }
    return clip;
  }

  // How far the lowest of ankles and toes is above its height at rest, with the hips at the origin.
  float lowestFoot(const std::vector<quat>& turns) const {
    std::vector<vec3> places(source_.size(), vec3(0));
    float least = 1e9f;
    for (std::uint32_t j = 0; j < source_.size(); ++j) {
      if (const std::uint32_t parent = to_.parents[j]; j != hips_ && parent != kNone)
        places[j] = places[parent] + turns[parent] * (to_.centres[j] - to_.centres[parent]);
      const std::string_view part = to_.parts.of[j];
      if ((part.ends_with("Foot") || part.ends_with("Toes")) && hangsOn(to_.parents, j, hips_))
        least = std::min(least, places[j].y - to_.centres[j].y);
    }
    return least < 1e8f ? least : -to_.centres[hips_].y;
  }

  void placeHips(const std::vector<vec3>& hips, std::vector<float> lowest, Track<vec3>& track) const {
    const std::size_t floor = std::size_t(kFloorShare * float(lowest.size()));
    std::nth_element(lowest.begin(), lowest.begin() + std::ptrdiff_t(floor), lowest.end());
    const vec3 shift(to_.centres[hips_].x - hips[0].x, -lowest[floor], to_.centres[hips_].z - hips[0].z);
    const std::uint32_t parent = to_.parents[hips_];
    const mat4 toLocal = glm::inverse(parent == kNone ? body_.skeleton.rootTransform
                                                      : body_.skeleton.joints[parent].restWorld);
    for (const vec3& place : hips) track.values.push_back(vec3(toLocal * vec4(place + shift, 1)));
  }

  // How much of a person follows, and how far the limbs that do are from where the motion has them.
  void describe(Retargeting& out, bool told) const {
    out.motionNames = from_.parts.family, out.bodyNames = to_.parts.family;
    out.motionParts.assign(from_.parts.of.begin(), from_.parts.of.end());
    out.standingFrame = standing_, out.stands = stands_;
    out.up = up_;
    std::vector<std::string_view> followed;
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] != kNone) followed.push_back(to_.parts.of[j]), ++out.joints;
    out.keys = humanoidKeys(followed);
    const Trunk trunk = findTrunk(to_), theirs = findTrunk(from_);
    double sum = 0;
    int measured = 0;
    for (const std::uint32_t frame : sampledFrames(motion(), kFramesCompared)) {
      const MotionPose source = motionPose(motion(), frame);
      const Pose pose = samplePose(body_.skeleton, out.clip, out.clip.timeOfFrame(frame));
      if (trunk.known() && theirs.known())
        if (const float wanted = bendOf(theirs, source), own = bendOf(trunk, pose); own < 0.5f * wanted)
          out.trunkMissing = std::max(out.trunkMissing, wanted - own);
      const std::vector<vec3> places = placesOf(pose);
      for (std::uint32_t j = 0; j < source_.size(); ++j) {
        if (source_[j] == kNone) continue;
        const auto end = to_.boneEnd(j, to_.parts.of[j], places, places),
                   sourceEnd =
                       from_.boneEnd(source_[j], from_.parts.of[source_[j]], source.places, source.tips);
        if (!end || !sourceEnd) continue;
        const vec3 own = directionOf(*end - places[j]),
                   wanted = directionOf(*sourceEnd - source.places[source_[j]]);
        const float angle = std::acos(std::clamp(glm::dot(own, wanted), -1.0f, 1.0f)) * 180 / kPi;
        out.worstAngle = std::max(out.worstAngle, angle);
        sum += double(angle), ++measured;
      }
    }
    out.meanAngle = measured > 0 ? float(sum / measured) : 0;
    const auto sure = [](std::string_view family) {
      return family == "shape" ? kShapeSure : family == "words" ? kWordsSure : 1.0f;
    };
    const int most = std::max({humanoidKeys(from_.parts.of), humanoidKeys(to_.parts.of), 1});
    const float names = told ? 1.0f : std::min(sure(out.motionNames), sure(out.bodyNames));
    out.sureness = names * std::min(1.0f, float(out.keys) / float(most));
    const float plausible = plausibility(from_) * plausibility(to_);
    if (!told) out.sureness *= plausible * plausible;
    if (out.trunkMissing > kTrunkFollowed) out.sureness *= kStiffSure;
    out.turnedRound = turnedRound();
    if (!out.turnedRound.empty()) out.sureness *= kTurnedRoundSure;
    if (!out.stands) out.sureness *= kNoStandSure;
    if (given_.turnsDoubted) out.sureness *= kDoubtedTurnsSure;
    out.sureness *= 1 - std::clamp((out.meanAngle - kGoodAngle) / (kLostAngle - kGoodAngle), 0.0f, 1.0f);
  }

  std::string turnedRound() const {
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      for (std::uint32_t above = to_.parents[j]; above != kNone; above = to_.parents[above]) {
        if (source_[j] == kNone || source_[above] == kNone || source_[j] == source_[above]) continue;
        if (hangsOn(from_.parents, source_[above], source_[j]))
          return "'" + to_.names[above] + "' above '" + to_.names[j] + "'";
      }
    return "";
  }

  static std::vector<vec3> placesOf(const Pose& pose) {
    std::vector<vec3> places;
    for (const mat4& joint : pose.world) places.push_back(vec3(joint[3]));
    return places;
  }

  // How far a trunk is bent against the hips, beside how it stands [degrees].
  static float bend(vec3 standing, vec3 now) {
    return std::acos(std::clamp(glm::dot(directionOf(standing), directionOf(now)), -1.0f, 1.0f)) * 180 / kPi;
  }
  float bendOf(const Trunk& trunk, const MotionPose& pose) const {
    const quat hips = pose.world[trunk.hips] * glm::conjugate(standingTurns_[trunk.hips]);
    return bend(trunk.way(from_.centres), glm::conjugate(hips) * trunk.way(pose.places));
  }
  float bendOf(const Trunk& trunk, const Pose& pose) const {
    const std::vector<vec3> places = placesOf(pose);
    const quat hips = rotationOf(pose.world[trunk.hips]) * glm::conjugate(restRotations_[trunk.hips]);
    return bend(trunk.way(to_.centres), glm::conjugate(hips) * trunk.way(places));
  }

  const Motion& given_;
  const Body& body_;
  std::optional<Motion> turned_;  // upright, where the given one is not
  Rig from_, to_;
  vec3 up_{0, 1, 0};
  std::uint32_t standing_ = MotionPose::kZero;
  bool stands_ = true;
  std::vector<quat> standingTurns_;    // of the motion's joints, in the pose that they stand in
  std::vector<std::uint32_t> source_;  // motion's joint that each of the body's follows
  TrunkSpread spread_;
  std::vector<quat> alignment_, restRotations_;
  std::uint32_t hips_ = kNone;
  float scale_ = 1;
};

}  // namespace

Result<JointPairs> matchedJoints(const Motion& motion, const Body& body, const JointMap& map) {
  return pairJoints(rigOf(motion), rigOf(body.skeleton), map, motion.name, body.name);
}

std::string describeMatch(const Retargeting& done) {
  std::string text = std::to_string(done.joints) + " joints matched, " + std::to_string(done.keys) +
                     " of the " + std::to_string(kHumanoidKeys) + " that make a person move (names: motion " +
                     (done.motionNames.empty() ? "unknown" : std::string(done.motionNames)) + ", body " +
                     (done.bodyNames.empty() ? "unknown" : std::string(done.bodyNames)) + "), " +
                     std::to_string(int(std::lround(100 * done.sureness))) + " % sure";
  if (done.trunkMissing > kTrunkFollowed)
    text += ", trunk: not followed (it bends by up to " +
            std::to_string(int(std::lround(done.trunkMissing))) + " degrees less)";
  if (!done.turnedRound.empty())
    text += ", the wrong way round: " + done.turnedRound + ", which follow joints that stand the other way";
  if (done.up != vec3(0, 1, 0))
    text += ", up is " + std::string(done.up.x + done.up.y + done.up.z < 0 ? "-" : "+") +
            (done.up.x != 0   ? "X"
             : done.up.y != 0 ? "Y"
                              : "Z");
  if (done.standingFrame != Retargeting::kZeroPose)
    text += ", compared with rest in frame " + std::to_string(done.standingFrame);
  else if (!done.stands)
    text += ", compared with rest in the zero pose";
  if (!done.stands) text += ", in which nobody stands: trunk, hands and feet may be turned wrong";
  return text;
}

Result<Retargeting> retargeted(const Motion& motion, const Body& body, const JointMap& map) {
  if (motion.frameCount == 0 || motion.joints.empty()) return badInput(motion.name + " has no frames");
  return Retargeter(motion, body).run(map);
}

Result<Clip> retarget(const Motion& motion, const Body& body, const JointMap& map) {
  auto done = retargeted(motion, body, map);
  if (!done) return done.error();
  return std::move(done->clip);
}

Motion standingStill(const Body& body) {
  Motion motion;
  motion.name = body.name;
  const auto& joints = body.skeleton.joints;
  for (const auto& joint : joints) {
    Motion::Joint still{joint.name, joint.parent, vec3(joint.restWorld[3])};
    if (joint.parent.valid()) still.offset -= vec3(joints[joint.parent.value].restWorld[3]);
    still.moves = !joint.parent.valid();
    motion.joints.push_back(still);
    motion.rotations.push_back(quat(1, 0, 0, 0));
    motion.translations.push_back(still.offset);
  }
  motion.frameCount = 1;
  return motion;
}

HumanoidNames partsOf(const Motion& motion) { return rigOf(motion).parts; }
HumanoidNames partsOf(const Skeleton& skeleton) { return rigOf(skeleton).parts; }

}  // namespace vasa
