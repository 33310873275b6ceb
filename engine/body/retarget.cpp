#include "body/retarget.h"

#include <algorithm>
#include <optional>

// Rotations are kept relative to rest, in world axes: Q = world · rest⁻¹. A joint that follows has
// Q_body = Q_motion · A, with A the constant turn that brings its rest pose to the motion's.
namespace vasa {
namespace {

constexpr std::size_t kLeastJoints = 6;
constexpr float kKneeCapShare = 0.6f;
constexpr float kLeastBend = 0.1f;  // sine of an elbow's bend
constexpr float kMostHingeTurn = 1.0f;
constexpr float kFloorShare = 0.05f;  // of the frames may have a foot lower than the floor, a little
const quat kIdentity(1, 0, 0, 0);

vec3 unit(vec3 v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : vec3(0);
}

// The shortest turn from one direction to another; none where either is missing.
quat turnBetween(vec3 from, vec3 to) {
  from = unit(from), to = unit(to);
  if (from == vec3(0) || to == vec3(0)) return kIdentity;
  const float cosine = glm::dot(from, to);
  if (cosine < -0.9999f) return glm::angleAxis(kPi, anyPerpendicular(from));
  return glm::normalize(quat(1 + cosine, glm::cross(from, to)));
}

quat rotationOf(const mat4& m) {
  const vec3 x = unit(vec3(m[0])), y = unit(vec3(m[1]) - glm::dot(vec3(m[1]), x) * x);
  return glm::normalize(glm::quat_cast(mat3(x, y, glm::cross(x, y))));
}

bool endsWith(std::string_view part, std::string_view end) { return part.ends_with(end); }

// What both skeletons look like to the matching: names, parents, places at rest.
struct Rig {
  std::vector<std::string> names;
  std::vector<std::uint32_t> parents;  // JointId::kNone at a root
  std::vector<vec3> centres, tips;     // a tip's end where the file has one, else the centre
  HumanoidNames parts;

  std::uint32_t partNamed(std::string_view part) const {
    const auto found = std::ranges::find(parts.of, part);
    return found == parts.of.end() ? JointId::kNone : std::uint32_t(found - parts.of.begin());
  }
};

Rig rigOf(const Motion& motion) {
  Rig rig;
  for (const Motion::Joint& joint : motion.joints) {
    rig.names.push_back(joint.name);
    rig.parents.push_back(joint.parent.value);
    rig.centres.push_back((joint.parent.valid() ? rig.centres[joint.parent.value] : vec3(0)) + joint.offset);
    rig.tips.push_back(rig.centres.back() + joint.endOffset);
  }
  rig.parts = humanoidNames(rig.names);
  return rig;
}

Rig rigOf(const Skeleton& skeleton) {
  Rig rig;
  for (const auto& joint : skeleton.joints) {
    rig.names.push_back(joint.name);
    rig.parents.push_back(joint.parent.value);
    rig.centres.push_back(vec3(joint.restWorld[3]));
  }
  rig.tips = rig.centres;
  rig.parts = humanoidNames(rig.names);
  return rig;
}

constexpr std::uint32_t kNone = JointId::kNone;

Result<std::vector<std::uint32_t>> matchJoints(const Rig& motion, const Rig& body, const JointMap& map,
                                               const std::string& motionName, const std::string& bodyName) {
  std::vector<std::uint32_t> source(body.names.size(), kNone);
  std::vector<bool> told(motion.names.size()), taken(body.names.size());
  for (const auto& [from, to] : map) {
    const auto a = std::ranges::find(motion.names, from), b = std::ranges::find(body.names, to);
    if (a == motion.names.end()) return badInput(motionName + " has no joint '" + from + "' that the joint map names");
    told[std::size_t(a - motion.names.begin())] = true;
    if (to.empty()) continue;
    if (b == body.names.end()) return badInput(bodyName + " has no joint '" + to + "' that the joint map names");
    source[std::size_t(b - body.names.begin())] = std::uint32_t(a - motion.names.begin());
    taken[std::size_t(b - body.names.begin())] = true;
  }
  const bool sameFamily = motion.parts.family == body.parts.family;
  for (std::uint32_t j = 0; j < body.names.size(); ++j) {
    if (taken[j]) continue;
    for (std::uint32_t s = 0; s < motion.names.size() && source[j] == kNone; ++s) {
      if (told[s]) continue;
      const bool samePart = !body.parts.of[j].empty() && body.parts.of[j] == motion.parts.of[s];
      if (samePart || (sameFamily && plainName(body.names[j]) == plainName(motion.names[s]))) source[j] = s;
    }
  }
  return source;
}

class Retargeter {
 public:
  Retargeter(const Motion& motion, const Body& body) : motion_(motion), body_(body), from_(rigOf(motion)), to_(rigOf(body.skeleton)) {}

  Result<Clip> run(const JointMap& map) {
    auto matched = matchJoints(from_, to_, map, motion_.name, body_.name);
    if (!matched) return matched.error();
    source_ = std::move(*matched);
    const auto count = std::size_t(std::ranges::count_if(source_, [](std::uint32_t s) { return s != kNone; }));
    hips_ = hipsOf();
    const std::string remedy = "; pair the joints in a file and give it with --joint-map";
    if (count < kLeastJoints)
      return badInput(body_.name + " and " + motion_.name + " have " + std::to_string(count) + " joints in common, fewer than " +
                      std::to_string(kLeastJoints) + remedy);
    if (hips_ == kNone) return badInput(body_.name + " has no joint that follows the hips of " + motion_.name + remedy);
    partsFromSource();
    align();
    measureScale();
    return makeClip();
  }

 private:
  // The hips, or the first joint that follows one which moves.
  std::uint32_t hipsOf() const {
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] != kNone && (to_.parts.of[j] == "hips" || from_.parts.of[source_[j]] == "hips")) return j;
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] != kNone && (motion_.joints[source_[j]].moves || from_.parents[source_[j]] == kNone)) return j;
    return kNone;
  }

  // Joints that only the map knows are the parts that their counterparts are.
  void partsFromSource() {
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] != kNone && to_.parts.of[j].empty()) to_.parts.of[j] = from_.parts.of[source_[j]];
      else if (source_[j] != kNone && from_.parts.of[source_[j]].empty()) from_.parts.of[source_[j]] = to_.parts.of[j];
  }

  // Direction of a limb's bone: to the joint that is the next part.
  static vec3 boneOf(const Rig& rig, std::uint32_t joint, std::string_view part) {
    const std::string side(part.starts_with("left") ? "left" : "right");
    std::string_view next;
    for (const auto& [own, behind] : {std::pair{"UpperArm", "LowerArm"}, {"LowerArm", "Hand"}, {"UpperLeg", "LowerLeg"}, {"LowerLeg", "Foot"}})
      if (endsWith(part, own)) next = behind;
    if (next.empty()) return vec3(0);
    const std::uint32_t end = rig.partNamed(side + std::string(next));
    return end == kNone ? vec3(0) : rig.centres[end] - rig.centres[joint];
  }

  // Along the fingers and towards the thumb; nothing where a hand has neither.
  static std::optional<mat3> handOf(const Rig& rig, std::uint32_t hand) {
    vec3 fingers(0), thumb(0);
    const std::string side(rig.parts.of[hand].starts_with("left") ? "left" : "right");
    const std::uint32_t root = rig.partNamed(side + "ThumbProximal");
    for (std::uint32_t j = hand + 1; j < rig.names.size(); ++j) {
      bool inHand = false, inThumb = false;
      for (std::uint32_t at = j; at != kNone && at >= hand; at = rig.parents[at]) inHand = inHand || at == hand, inThumb = inThumb || at == root;
      if (inHand) (inThumb ? thumb : fingers) += rig.tips[j] - rig.centres[hand];
    }
    const vec3 along = unit(fingers), aside = unit(thumb - glm::dot(thumb, along) * along);
    if (along == vec3(0) || aside == vec3(0)) return std::nullopt;
    return mat3(along, aside, glm::cross(along, aside));
  }

  quat alignmentOf(std::uint32_t j, const quat& above) const {
    const std::uint32_t s = source_[j];
    const std::string_view part = to_.parts.of[j];
    if (s == kNone || part.empty()) return above;
    if (endsWith(part, "Hand")) {
      const auto own = handOf(to_, j), wanted = handOf(from_, s);
      return own && wanted ? glm::normalize(glm::quat_cast(*wanted * glm::transpose(*own))) : above;
    }
    const vec3 own = boneOf(to_, j, part), wanted = boneOf(from_, s, part);
    if (own != vec3(0) && wanted != vec3(0)) {
      const quat turn = turnBetween(above * own, wanted) * above;
      return endsWith(part, "UpperArm") ? hingeTurn(j, turn) * turn : turn;
    }
    const bool finger = part.find("Proximal") != part.npos || endsWith(part, "Toes");
    return finger ? above : kIdentity;
  }

  // The turn about an upper arm that makes the elbow bend about the axis it is bent about at rest: no direction
  // of a bone tells how an arm is turned. None where the body's arm is straight at rest or the motion never bends.
  quat hingeTurn(std::uint32_t upper, const quat& turn) const {
    const std::string side(to_.parts.of[upper].starts_with("left") ? "left" : "right");
    const std::uint32_t lower = to_.partNamed(side + "LowerArm");
    if (lower == kNone || source_[lower] == kNone || from_.parents[source_[lower]] != source_[upper]) return kIdentity;
    const vec3 along = unit(boneOf(to_, upper, side + "UpperArm")), on = unit(boneOf(to_, lower, side + "LowerArm"));
    const vec3 sourceAlong = unit(boneOf(from_, source_[upper], side + "UpperArm")), sourceOn = unit(boneOf(from_, source_[lower], side + "LowerArm"));
    vec3 bends(0);
    for (std::uint32_t frame = 0; frame < motion_.frameCount; ++frame)
      bends += glm::cross(sourceAlong, motion_.rotation(frame, source_[lower]) * sourceOn);
    const vec3 own = glm::cross(along, on), wanted = bends / float(motion_.frameCount);
    if (glm::length(own) < kLeastBend || glm::length(wanted) < kLeastBend) return kIdentity;
    const vec3 a = unit(turn * own), b = unit(wanted - glm::dot(wanted, sourceAlong) * sourceAlong);
    const float angle = std::atan2(glm::dot(glm::cross(a, b), sourceAlong), glm::dot(a, b));
    return glm::angleAxis(std::clamp(angle, -kMostHingeTurn, kMostHingeTurn), sourceAlong);
  }

  void align() {
    alignment_.assign(source_.size(), kIdentity);
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      alignment_[j] = alignmentOf(j, to_.parents[j] == kNone ? kIdentity : alignment_[to_.parents[j]]);
  }

  static float legOf(const Rig& rig) {
    float length = 0;
    for (const std::string side : {"left", "right"}) {
      const std::uint32_t thigh = rig.partNamed(side + "UpperLeg"), knee = rig.partNamed(side + "LowerLeg"), foot = rig.partNamed(side + "Foot");
      if (thigh == kNone || knee == kNone || foot == kNone) return 0;
      length += glm::distance(rig.centres[thigh], rig.centres[knee]) + glm::distance(rig.centres[knee], rig.centres[foot]);
    }
    return length;
  }
  static float extentOf(const Rig& rig) {
    float low = rig.tips[0].y, high = low;
    for (const vec3& p : rig.tips) low = std::min(low, p.y), high = std::max(high, p.y);
    return high - low;
  }
  // Legs where both have them, else the skeletons' heights.
  void measureScale() {
    const float own = legOf(to_), theirs = legOf(from_);
    if (own > 0 && theirs > 0) scale_ = own / theirs;
    else if (extentOf(from_) > 0) scale_ = extentOf(to_) / extentOf(from_);
  }

  struct SourceFrame {
    std::vector<quat> world;
    std::vector<vec3> places;
  };
  SourceFrame sourceFrame(std::uint32_t frame) const {
    SourceFrame out;
    for (std::size_t i = 0; i < motion_.joints.size(); ++i) {
      const std::uint32_t parent = from_.parents[i];
      const quat above = parent == kNone ? kIdentity : out.world[parent];
      out.world.push_back(glm::normalize(above * motion_.rotation(frame, i)));
      out.places.push_back((parent == kNone ? vec3(0) : out.places[parent]) + above * motion_.translation(frame, i));
    }
    return out;
  }

  // Turns relative to rest of all of the body's joints.
  std::vector<quat> bodyTurns(const SourceFrame& frame) const {
    std::vector<quat> turns(source_.size(), kIdentity);
    for (std::uint32_t j = 0; j < source_.size(); ++j) {
      if (source_[j] != kNone) turns[j] = glm::normalize(frame.world[source_[j]] * alignment_[j]);
      else if (to_.parents[j] != kNone) turns[j] = turns[to_.parents[j]];
    }
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
      if (sibling) turns[j] = turns[parent] * glm::slerp(kIdentity, glm::conjugate(turns[parent]) * turns[k], kKneeCapShare);
      const bool roll = to_.parents[k] == j && endsWith(to_.parts.of[k], "Hand") && endsWith(to_.parts.of[parent], "LowerArm");
      if (!roll) continue;
      const quat turn = glm::conjugate(turns[parent]) * turns[k];
      const vec3 axis = unit(to_.centres[k] - to_.centres[j]);
      const float along = glm::dot(vec3(turn.x, turn.y, turn.z), axis);
      const quat twist(turn.w, axis * along);
      if (glm::length(twist) > 1e-6f) turns[j] = turns[parent] * glm::normalize(twist);
    }
  }

  Result<Clip> makeClip() {
    Clip clip;
    clip.name = motion_.name;
    clip.framesPerSecond = motion_.framesPerSecond;
    std::vector<JointTracks> tracks(source_.size());
    for (std::uint32_t j = 0; j < source_.size(); ++j) {
      tracks[j].joint = {j};
      restRotations_.push_back(rotationOf(body_.skeleton.joints[j].restWorld));
    }
    std::vector<vec3> hips;
    std::vector<float> lowest;
    for (std::uint32_t frame = 0; frame < motion_.frameCount; ++frame) {
      const SourceFrame source = sourceFrame(frame);
      const std::vector<quat> turns = bodyTurns(source);
      for (std::uint32_t j = 0; j < source_.size(); ++j) {
        const quat above = to_.parents[j] == kNone ? rotationOf(body_.skeleton.rootTransform) : turns[to_.parents[j]] * restRotations_[to_.parents[j]];
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
    for (std::uint32_t frame = 0; frame < motion_.frameCount; ++frame) times.push_back(float(double(frame) / double(motion_.framesPerSecond)));
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
      bool below = j == hips_;
      if (const std::uint32_t parent = to_.parents[j]; j != hips_ && parent != kNone) {
        places[j] = places[parent] + turns[parent] * (to_.centres[j] - to_.centres[parent]);
        for (std::uint32_t at = j; at != kNone && !below; at = to_.parents[at]) below = at == hips_;
      }
      const std::string_view part = to_.parts.of[j];
      if (below && (endsWith(part, "Foot") || endsWith(part, "Toes"))) least = std::min(least, places[j].y - to_.centres[j].y);
    }
    return least < 1e8f ? least : -to_.centres[hips_].y;
  }

  void placeHips(const std::vector<vec3>& hips, std::vector<float> lowest, Track<vec3>& track) const {
    const std::size_t floor = std::size_t(kFloorShare * float(lowest.size()));
    std::nth_element(lowest.begin(), lowest.begin() + std::ptrdiff_t(floor), lowest.end());
    const vec3 shift(to_.centres[hips_].x - hips[0].x, -lowest[floor], to_.centres[hips_].z - hips[0].z);
    const std::uint32_t parent = to_.parents[hips_];
    const mat4 toLocal = glm::inverse(parent == kNone ? body_.skeleton.rootTransform : body_.skeleton.joints[parent].restWorld);
    for (const vec3& place : hips) track.values.push_back(vec3(toLocal * vec4(place + shift, 1)));
  }

  const Motion& motion_;
  const Body& body_;
  Rig from_, to_;
  std::vector<std::uint32_t> source_;  // motion's joint that each of the body's follows
  std::vector<quat> alignment_, restRotations_;
  std::uint32_t hips_ = kNone;
  float scale_ = 1;
};

}  // namespace

Result<std::vector<std::uint32_t>> matchedJoints(const Motion& motion, const Body& body, const JointMap& map) {
  return matchJoints(rigOf(motion), rigOf(body.skeleton), map, motion.name, body.name);
}

Result<Clip> retarget(const Motion& motion, const Body& body, const JointMap& map) {
  if (motion.frameCount == 0 || motion.joints.empty()) return badInput(motion.name + " has no frames");
  return Retargeter(motion, body).run(map);
}

}  // namespace vasa
