#include "body/retarget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "body/humanoid_shape.h"
#include "body/motion_rest.h"
#include "core/nearest_names.h"

// Rotations are kept relative to a pose in which the motion's skeleton stands (its zero pose, as a rule), in
// world axes: Q = world · standing⁻¹. A joint that follows has Q_body = Q_motion · A, with A the constant
// turn that brings the body's rest pose to the motion's standing one.
namespace vasa {
namespace {

constexpr std::uint32_t kNone = JointId::kNone;
constexpr std::size_t kLeastJoints = 6;
constexpr float kKneeCapShare = 0.6f;
constexpr float kLeastBend = 0.1f;  // sine of an elbow's bend
constexpr float kMostHingeTurn = 1.0f;
constexpr float kFloorShare = 0.05f;  // of the frames may have a foot lower than the floor, a little
// Cosine of 30 degrees: trunks that differ by less stand alike, but for their bones' slant.
constexpr float kFacingDoubt = 0.87f;
constexpr std::uint32_t kFramesCompared = 12;
constexpr float kLongBone = 2.5f;                   // times the other bone of a limb: no person's
constexpr float kShortArm = 0.4f, kLongArm = 1.2f;  // of a leg, without hand and foot
constexpr int kGross = 8;                           // what no person has counts as much as this many doubts
constexpr float kAlike = 0.25f;                     // the share by which the bones of both sides may differ
constexpr float kWordsSure = 0.95f, kShapeSure = 0.8f;  // a known convention: 1
constexpr float kGoodAngle = 10, kLostAngle = 60;  // [degrees] between limbs: as good as right, and wrong
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

// The joint that two lead back to; none where they share none.
std::uint32_t whereMeet(const Rig& rig, std::uint32_t left, std::uint32_t right) {
  for (std::uint32_t a = left; a != kNone; a = rig.parents[a])
    for (std::uint32_t b = right; b != kNone; b = rig.parents[b])
      if (a == b) return a;
  return kNone;
}

// Where both legs leave the trunk, in rigs that call the hips a spine.
void findHips(Rig& rig) {
  const std::uint32_t left = rig.partNamed("leftUpperLeg"), right = rig.partNamed("rightUpperLeg");
  if (rig.partNamed("hips") != kNone || left == kNone || right == kNone) return;
  if (const std::uint32_t hips = whereMeet(rig, rig.parents[left], rig.parents[right]); hips != kNone)
    rig.parts.of[hips] = humanoidPart("hips");
}

// What goes on beyond the shoulders, in rigs that call neck and head a spine, too.
void findHead(Rig& rig) {
  const std::uint32_t left = rig.partNamed("leftUpperArm"), right = rig.partNamed("rightUpperArm");
  if (rig.partNamed("neck") != kNone || rig.partNamed("head") != kNone || left == kNone || right == kNone)
    return;
  const std::uint32_t chest = whereMeet(rig, left, right);
  if (chest == kNone) return;
  for (auto top = std::uint32_t(rig.names.size()); top-- > 0;) {
    const std::string_view own = rig.parts.of[top];
    if (own != "spine" && own != "chest" && own != "upperChest") continue;
    std::uint32_t first = top;
    while (first != kNone && rig.parents[first] != chest) first = rig.parents[first];
    if (first == kNone) continue;
    rig.parts.of[top] = humanoidPart("head");
    if (first != top) rig.parts.of[first] = humanoidPart("neck");
    return;
  }
}

// Names first; where these tell little, the skeleton's shape.
void nameParts(Rig& rig) {
  rig.parts = humanoidNames(rig.names);
  findHips(rig);
  findHead(rig);
  if (humanoidKeys(rig.parts.of) >= kHumanoidKeys / 2) return;
  auto shape = humanoidShape(rig.parents, rig.centres, rig.tips);
  if (humanoidKeys(shape) > humanoidKeys(rig.parts.of)) rig.parts = {"shape", std::move(shape)};
}

void placeIn(Rig& rig, const MotionPose& pose) { rig.centres = pose.places, rig.tips = pose.tips; }

// In the first frame: a zero pose may have all bones along one line.
Rig rigOf(const Motion& motion) {
  Rig rig;
  for (const Motion::Joint& joint : motion.joints)
    rig.names.push_back(joint.name), rig.parents.push_back(joint.parent.value);
  placeIn(rig, motionPose(motion, 0));
  nameParts(rig);
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
  nameParts(rig);
  return rig;
}

std::string perhaps(const std::string& name, std::span<const std::string> names) {
  const std::string near = didYouMean(name, names);
  return near.empty() ? near : "; " + near;
}

Result<std::vector<std::uint32_t>> matchJoints(const Rig& motion, const Rig& body, const JointMap& map,
                                               const std::string& motionName, const std::string& bodyName) {
  std::vector<std::uint32_t> source(body.names.size(), kNone);
  std::vector<bool> told(motion.names.size()), taken(body.names.size());
  for (const auto& [from, to] : map) {
    const auto a = std::ranges::find(motion.names, from), b = std::ranges::find(body.names, to);
    if (a == motion.names.end())
      return badInput(motionName + " has no joint '" + from + "' that the joint map names" +
                      perhaps(from, motion.names));
    told[std::size_t(a - motion.names.begin())] = true;
    if (to.empty()) continue;
    if (b == body.names.end())
      return badInput(bodyName + " has no joint '" + to + "' that the joint map names" +
                      perhaps(to, body.names));
    source[std::size_t(b - body.names.begin())] = std::uint32_t(a - motion.names.begin());
    taken[std::size_t(b - body.names.begin())] = true;
  }
  // Shapes have no names in common that mean the same.
  const bool sameFamily = motion.parts.family == body.parts.family && motion.parts.family != "shape";
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

// Left, up and forward of a trunk: up from the hips, left as these pairs of joints lie.
std::optional<mat3> trunkOf(const Rig& rig, std::initializer_list<std::string_view> pairs) {
  const std::uint32_t from = rig.partNamed("hips");
  std::uint32_t to = kNone;
  for (const char* part : {"neck", "head", "upperChest", "chest"})
    if (to == kNone) to = rig.partNamed(part);
  vec3 left(0);
  for (const std::string_view pair : pairs) {
    const std::uint32_t a = rig.partNamed("left" + std::string(pair)),
                        b = rig.partNamed("right" + std::string(pair));
    if (a != kNone && b != kNone) left += rig.centres[a] - rig.centres[b];
  }
  if (from == kNone || to == kNone) return std::nullopt;
  const vec3 up = unit(rig.centres[to] - rig.centres[from]), side = unit(left - glm::dot(left, up) * up);
  if (up == vec3(0) || side == vec3(0)) return std::nullopt;
  return mat3(side, up, glm::cross(side, up));
}

std::optional<quat> turnOf(const std::optional<mat3>& from, const std::optional<mat3>& to) {
  if (!from || !to) return std::nullopt;
  return glm::normalize(glm::quat_cast(*to * glm::transpose(*from)));
}

// The share of what must hold between the parts of a person that does: lower bones behind upper ones, both
// sides alike, legs away from the trunk. Names alone may mean anything.
float plausibility(const Rig& rig) {
  int held = 0, asked = 0;
  float arm = 0, leg = 0;
  const auto ask = [&](bool holds, int weight = 1) { asked += weight, held += holds ? weight : 0; };
  const auto below = [&](std::uint32_t joint, std::uint32_t above) {
    while (joint != kNone && joint != above) joint = rig.parents[joint];
    return joint == above;
  };
  const auto part = [&](const char* side, const char* name) {
    return rig.partNamed(std::string(side) + name);
  };
  const std::uint32_t hips = rig.partNamed("hips"),
                      top = rig.partNamed(rig.partNamed("neck") == kNone ? "head" : "neck");
  for (const auto& limb :
       {std::array{"UpperArm", "LowerArm", "Hand"}, std::array{"UpperLeg", "LowerLeg", "Foot"}}) {
    std::array<float, 2> lengths[2] = {{0, 0}, {0, 0}};
    for (int s = 0; s < 2; ++s)
      for (std::size_t k = 0; k < 2; ++k) {
        const char* side = s ? "right" : "left";
        const std::uint32_t a = part(side, limb[k]), b = part(side, limb[k + 1]);
        if (a == kNone || b == kNone) continue;
        ask(below(b, a) && a != b);
        const vec3 bone = rig.centres[b] - rig.centres[a];
        lengths[k][std::size_t(s)] = glm::length(bone);
        if (limb[0] == std::string_view("UpperLeg") && hips != kNone && top != kNone)
          ask(glm::dot(bone, rig.centres[top] - rig.centres[hips]) < 0);
      }
    for (int s = 0; s < 2; ++s) {
      const float upper = lengths[0][std::size_t(s)], lower = lengths[1][std::size_t(s)];
      if (upper > 0 && lower > 0) ask(upper < kLongBone * lower && lower < kLongBone * upper, kGross);
      (limb[0] == std::string_view("UpperArm") ? arm : leg) += upper > 0 && lower > 0 ? upper + lower : 0;
    }
    for (const auto& [left, right] :
         {std::pair(lengths[0][0], lengths[0][1]), std::pair(lengths[1][0], lengths[1][1])})
      if (left > 0 && right > 0) ask(std::abs(left - right) < kAlike * std::max(left, right));
    const std::uint32_t l = part("left", limb[0]), r = part("right", limb[0]);
    if (l != kNone && r != kNone) ask(!below(l, r) && !below(r, l));
  }
  if (arm > 0 && leg > 0) ask(arm > kShortArm * leg && arm < kLongArm * leg, kGross);
  return asked > 0 ? float(held) / float(asked) : 1.0f;
}

class Retargeter {
 public:
  Retargeter(const Motion& motion, const Body& body)
      : given_(motion), body_(body), from_(rigOf(motion)), to_(rigOf(body.skeleton)) {}

  Result<Retargeting> run(const JointMap& map) {
    auto matched = matchJoints(from_, to_, map, given_.name, body_.name);
    if (!matched) return matched.error();
    source_ = std::move(*matched);
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
    align();
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
  // Turns the motion upright and finds the pose in which it stands.
  void stand() {
    up_ = upOf(given_, from_.parts.of);
    if (up_ != vec3(0, 1, 0)) turned_ = withUp(given_, up_);
    standing_ = standingPose(motion(), from_.parts.of);
    const MotionPose pose = motionPose(motion(), standing_);
    placeIn(from_, pose);
    standingTurns_ = pose.world;
    const auto hips =
        turnOf(trunkOf(to_, {"UpperLeg", "UpperArm"}), trunkOf(from_, {"UpperLeg", "UpperArm"}));
    const auto chest = turnOf(trunkOf(to_, {"UpperArm"}), trunkOf(from_, {"UpperArm"}));
    if (!hips || (standing_ == MotionPose::kZero && hips->w > 0 && 2 * hips->w * hips->w - 1 > kFacingDoubt))
      return;
    hipsTurn_ = *hips;
    chestTurn_ = standing_ != MotionPose::kZero && chest ? *chest : *hips;
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
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] != kNone && to_.parts.of[j].empty())
        to_.parts.of[j] = from_.parts.of[source_[j]];
      else if (source_[j] != kNone && from_.parts.of[source_[j]].empty())
        from_.parts.of[source_[j]] = to_.parts.of[j];
  }

  // Direction of a limb's bone: to the joint that is the next part.
  static vec3 boneOf(const Rig& rig, std::uint32_t joint, std::string_view part) {
    const std::string side(part.starts_with("left") ? "left" : "right");
    std::string_view next;
    for (const auto& [own, behind] : {std::pair{"UpperArm", "LowerArm"},
                                      {"LowerArm", "Hand"},
                                      {"UpperLeg", "LowerLeg"},
                                      {"LowerLeg", "Foot"}})
      if (endsWith(part, own)) next = behind;
    if (next.empty()) return vec3(0);
    const std::uint32_t end = rig.partNamed(side + std::string(next));
    return end == kNone ? vec3(0) : rig.centres[end] - rig.centres[joint];
  }

  static std::uint32_t toesOf(const Rig& rig, std::uint32_t foot) {
    return rig.partNamed(std::string(rig.parts.of[foot].starts_with("left") ? "left" : "right") + "Toes");
  }

  // Along the fingers and towards the thumb; nothing where a hand has neither.
  static std::optional<mat3> handOf(const Rig& rig, std::uint32_t hand) {
    vec3 fingers(0), thumb(0);
    const std::string side(rig.parts.of[hand].starts_with("left") ? "left" : "right");
    const std::uint32_t root = rig.partNamed(side + "ThumbProximal");
    for (std::uint32_t j = hand + 1; j < rig.names.size(); ++j) {
      bool inHand = false, inThumb = false;
      for (std::uint32_t at = j; at != kNone && at >= hand; at = rig.parents[at])
        inHand = inHand || at == hand, inThumb = inThumb || at == root;
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
    const quat trunk = part == "hips" || part == "spine" ? hipsTurn_ : chestTurn_;
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
    if (finger) return above;
    if (standing_ == MotionPose::kZero) return trunk;
    // In a frame of the motion feet need not be flat: they are as their toes tell, else as the shin has them.
    if (!endsWith(part, "Foot")) return trunk;
    const std::uint32_t ownToes = toesOf(to_, j), toes = toesOf(from_, s);
    if (ownToes == kNone || toes == kNone) return above;
    return turnBetween(above * (to_.centres[ownToes] - to_.centres[j]),
                       from_.centres[toes] - from_.centres[s]) *
           above;
  }

  // The turn about an upper arm that makes the elbow bend about the axis it is bent about at rest: no
  // direction of a bone tells how an arm is turned. None where the body's arm is straight at rest or the
  // motion never bends.
  quat hingeTurn(std::uint32_t upper, const quat& turn) const {
    const std::string side(to_.parts.of[upper].starts_with("left") ? "left" : "right");
    const std::uint32_t lower = to_.partNamed(side + "LowerArm");
    if (lower == kNone || source_[lower] == kNone || from_.parents[source_[lower]] != source_[upper])
      return kIdentity;
    const vec3 along = unit(boneOf(to_, upper, side + "UpperArm")),
               on = unit(boneOf(to_, lower, side + "LowerArm"));
    const vec3 sourceAlong = unit(boneOf(from_, source_[upper], side + "UpperArm")),
               sourceOn = unit(boneOf(from_, source_[lower], side + "LowerArm"));
    vec3 bends(0);
    const std::uint32_t foreArm = source_[lower], arm = source_[upper];
    const quat toForeArm = glm::conjugate(standingTurns_[arm]) * standingTurns_[foreArm];
    for (std::uint32_t frame = 0; frame < motion().frameCount; ++frame) {
      // The forearm's turn beyond its standing one, seen from the arm as it stands.
      const quat bend = standingTurns_[arm] * motion().rotation(frame, foreArm) * glm::conjugate(toForeArm) *
                        glm::conjugate(standingTurns_[arm]);
      bends += glm::cross(sourceAlong, bend * sourceOn);
    }
    const vec3 own = glm::cross(along, on), wanted = bends / float(motion().frameCount);
    if (glm::length(own) < kLeastBend || glm::length(wanted) < kLeastBend) return kIdentity;
    const vec3 a = unit(turn * own), b = unit(wanted - glm::dot(wanted, sourceAlong) * sourceAlong);
    const float angle = std::atan2(glm::dot(glm::cross(a, b), sourceAlong), glm::dot(a, b));
    return glm::angleAxis(std::clamp(angle, -kMostHingeTurn, kMostHingeTurn), sourceAlong);
  }

  void align() {
    alignment_.assign(source_.size(), kIdentity);
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      alignment_[j] = alignmentOf(j, to_.parents[j] == kNone ? hipsTurn_ : alignment_[to_.parents[j]]);
  }

  static float legOf(const Rig& rig) {
    float length = 0;
    for (const std::string side : {"left", "right"}) {
      const std::uint32_t thigh = rig.partNamed(side + "UpperLeg"), knee = rig.partNamed(side + "LowerLeg"),
                          foot = rig.partNamed(side + "Foot");
      if (thigh == kNone || knee == kNone || foot == kNone) return 0;
      length += glm::distance(rig.centres[thigh], rig.centres[knee]) +
                glm::distance(rig.centres[knee], rig.centres[foot]);
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
    if (own > 0 && theirs > 0)
      scale_ = own / theirs;
    else if (extentOf(from_) > 0)
      scale_ = extentOf(to_) / extentOf(from_);
  }

  // Turns relative to rest of all of the body's joints.
  std::vector<quat> bodyTurns(const MotionPose& frame) const {
    std::vector<quat> turns(source_.size(), kIdentity);
    for (std::uint32_t j = 0; j < source_.size(); ++j) {
      if (source_[j] != kNone)
        turns[j] = glm::normalize(frame.world[source_[j]] * glm::conjugate(standingTurns_[source_[j]]) *
                                  alignment_[j]);
      else if (to_.parents[j] != kNone)
        turns[j] = turns[to_.parents[j]];
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
      if (sibling)
        turns[j] =
            turns[parent] * glm::slerp(kIdentity, glm::conjugate(turns[parent]) * turns[k], kKneeCapShare);
      const bool roll = to_.parents[k] == j && endsWith(to_.parts.of[k], "Hand") &&
                        endsWith(to_.parts.of[parent], "LowerArm");
      if (!roll) continue;
      const quat turn = glm::conjugate(turns[parent]) * turns[k];
      const vec3 axis = unit(to_.centres[k] - to_.centres[j]);
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
      bool below = j == hips_;
      if (const std::uint32_t parent = to_.parents[j]; j != hips_ && parent != kNone) {
        places[j] = places[parent] + turns[parent] * (to_.centres[j] - to_.centres[parent]);
        for (std::uint32_t at = j; at != kNone && !below; at = to_.parents[at]) below = at == hips_;
      }
      const std::string_view part = to_.parts.of[j];
      if (below && (endsWith(part, "Foot") || endsWith(part, "Toes")))
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
    out.standingFrame = standing_;
    out.up = up_;
    std::vector<std::string_view> followed;
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      if (source_[j] != kNone) followed.push_back(to_.parts.of[j]), ++out.joints;
    out.keys = humanoidKeys(followed);
    double sum = 0;
    int measured = 0;
    for (const std::uint32_t frame : sampledFrames(motion(), kFramesCompared)) {
      const MotionPose source = motionPose(motion(), frame);
      const Pose pose = samplePose(body_.skeleton, out.clip, out.clip.timeOfFrame(frame));
      for (std::uint32_t j = 0; j < source_.size(); ++j) {
        const auto end = nextOf(to_, j), sourceEnd = source_[j] == kNone ? kNone : nextOf(from_, source_[j]);
        if (end == kNone || sourceEnd == kNone) continue;
        const vec3 own = unit(vec3(pose.world[end][3]) - vec3(pose.world[j][3])),
                   wanted = unit(source.places[sourceEnd] - source.places[source_[j]]);
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
    out.sureness *= 1 - std::clamp((out.meanAngle - kGoodAngle) / (kLostAngle - kGoodAngle), 0.0f, 1.0f);
  }

  // The joint at which a limb's bone ends.
  static std::uint32_t nextOf(const Rig& rig, std::uint32_t joint) {
    const std::string_view part = rig.parts.of[joint];
    for (const auto& [own, behind] : {std::pair{"UpperArm", "LowerArm"},
                                      {"LowerArm", "Hand"},
                                      {"UpperLeg", "LowerLeg"},
                                      {"LowerLeg", "Foot"}})
      if (endsWith(part, own))
        return rig.partNamed(std::string(part.starts_with("left") ? "left" : "right") + behind);
    return kNone;
  }

  const Motion& given_;
  const Body& body_;
  std::optional<Motion> turned_;  // upright, where the given one is not
  Rig from_, to_;
  vec3 up_{0, 1, 0};
  std::uint32_t standing_ = MotionPose::kZero;
  std::vector<quat> standingTurns_;  // of the motion's joints, in the pose that they stand in
  quat hipsTurn_ = kIdentity, chestTurn_ = kIdentity;  // from the body's trunk to the motion's
  std::vector<std::uint32_t> source_;                  // motion's joint that each of the body's follows
  std::vector<quat> alignment_, restRotations_;
  std::uint32_t hips_ = kNone;
  float scale_ = 1;
};

}  // namespace

Result<std::vector<std::uint32_t>> matchedJoints(const Motion& motion, const Body& body,
                                                 const JointMap& map) {
  return matchJoints(rigOf(motion), rigOf(body.skeleton), map, motion.name, body.name);
}

std::string describeMatch(const Retargeting& done) {
  std::string text = std::to_string(done.joints) + " joints matched, " + std::to_string(done.keys) +
                     " of the " + std::to_string(kHumanoidKeys) + " that make a person move (names: motion " +
                     (done.motionNames.empty() ? "unknown" : std::string(done.motionNames)) + ", body " +
                     (done.bodyNames.empty() ? "unknown" : std::string(done.bodyNames)) + "), " +
                     std::to_string(int(std::lround(100 * done.sureness))) + " % sure";
  if (done.up != vec3(0, 1, 0))
    text += ", up is " + std::string(done.up.x + done.up.y + done.up.z < 0 ? "-" : "+") +
            (done.up.x != 0   ? "X"
             : done.up.y != 0 ? "Y"
                              : "Z");
  if (done.standingFrame != Retargeting::kZeroPose)
    text += ", compared with rest in frame " + std::to_string(done.standingFrame);
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
