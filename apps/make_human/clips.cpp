#include "make_human/clips.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace vasa::human {
namespace {

constexpr float kFramesPerSecond = 30;

struct Key {
  float at = 0;   ///< share of the clip
  vec4 value{0};  ///< flexion, abduction, twist [rad], lift [m]
};

struct Motion {
  std::string name;
  float seconds = 0, rightLag = 0;
  bool loops = true, keepFeet = false;
  std::map<int, std::vector<Key>> keys;  ///< by joint number
};

/// A joint's angle that grows with another joint's.
struct Coupling {
  int joint = 0, leader = 0;  ///< by joint number
  int angle = 0, leads = 0;   ///< 0 flexion, 1 abduction, 2 twist
  float share = 0;
  float from = 0;  ///< [rad] the least that the leader's angle counts as
};

/// Cubic Hermite through the keys, slopes from the neighbours; a looping motion wraps around.
vec4 valueAt(const std::vector<Key>& keys, float at, bool loops) {
  const int count = int(keys.size());
  const auto key = [&](int i) {
    if (!loops) return keys[std::size_t(std::clamp(i, 0, count - 1))];
    const int turn = int(std::floor(float(i) / float(count)));
    Key result = keys[std::size_t(i - turn * count)];
    result.at += float(turn);
    return result;
  };
  if (loops) at -= std::floor(at - keys.front().at);
  int i = 0;
  while (i + 1 < (loops ? count + 1 : count) && key(i + 1).at <= at) ++i;
  const Key a = key(i - 1), b = key(i), c = key(i + 1), d = key(i + 2);
  const float step = c.at - b.at;
  if (step <= 0) return b.value;
  const float t = std::clamp((at - b.at) / step, 0.0f, 1.0f), t2 = t * t, t3 = t2 * t;
  // A key between equal neighbours, or at a turning point, is flat: nothing overshoots.
  const auto slope = [](const Key& before, const Key& here, const Key& after) {
    vec4 result{0};
    for (int k = 0; k < 4; ++k)
      if ((here.value[k] - before.value[k]) * (after.value[k] - here.value[k]) > 0)
        result[k] = (after.value[k] - before.value[k]) / std::max(after.at - before.at, 1e-6f);
    return result;
  };
  return (2 * t3 - 3 * t2 + 1) * b.value + (3 * t2 - 2 * t3) * c.value +
         step * ((t3 - 2 * t2 + t) * slope(a, b, c) + (t3 - t2) * slope(b, c, d));
}

quat rotationOf(const RigPoint& joint, vec3 link, vec4 value) {
  vec3 outwards = joint.right ? vec3(-1, 0, 0) : vec3(1, 0, 0);
  if (std::abs(glm::dot(outwards, link)) > 0.8f) outwards = vec3(0, 1, 0);
  const bool turnsUp = link.y > 0.8f;
  const float twist = joint.right ? -value.z : value.z;
  return glm::angleAxis(value.x, glm::normalize(glm::cross(link, joint.bendTowards))) *
         glm::angleAxis(value.y, glm::normalize(glm::cross(link, outwards))) *
         glm::angleAxis(twist, turnsUp ? vec3(0, 1, 0) : link);
}

/// Where the points of the rig are in a pose.
std::vector<vec3> posed(const Rig& rig, const std::vector<quat>& rotations) {
  std::vector<vec3> positions(rig.points.size());
  std::vector<quat> world(rig.points.size());
  for (std::size_t i = 0; i < rig.points.size(); ++i) {
    const RigPoint& point = rig.points[i];
    const quat own = point.landmark ? quat(1, 0, 0, 0) : rotations[std::size_t(point.joint)];
    if (point.parent < 0) {
      positions[i] = point.position;
      world[i] = own;
      continue;
    }
    const std::size_t parent = std::size_t(point.parent);
    positions[i] = positions[parent] + world[parent] * (point.position - rig.points[parent].position);
    world[i] = world[parent] * own;
  }
  return positions;
}

/// How the root must move for the soles to touch the floor. A sole's point is a ball that touches it at rest.
vec3 groundShift(const Rig& rig, const std::vector<vec3>& positions, bool keepFeet) {
  float lowest = 1;
  vec3 drift{0};
  for (std::size_t i = 0; i < rig.points.size(); ++i) {
    const std::string& name = rig.points[i].name;
    const bool foot = name == "LeftFoot" || name == "RightFoot";
    const bool sole = name.ends_with("Heel") || name.find("Ball") != name.npos || name.ends_with("ToeTip");
    if (sole) lowest = std::min(lowest, positions[i].y - rig.points[i].position.y);
    if (foot && keepFeet) drift += 0.5f * (rig.points[i].position - positions[i]);
  }
  return {drift.x, -lowest, drift.z};
}

/// The joints' angles at a share of the clip, by joint number; what moves at no time is not there.
std::map<int, vec4> anglesAt(const Motion& motion, const Rig& rig, std::span<const Coupling> couplings,
                             float at) {
  std::map<int, vec4> keyed;
  for (const auto& [joint, keys] : motion.keys) {
    const bool right = rig.points[std::size_t(rig.joints[std::size_t(joint)])].right;
    keyed[joint] = valueAt(keys, right ? at - motion.rightLag : at, motion.loops);
  }
  std::map<int, vec4> angles = keyed;
  for (const Coupling& coupling : couplings)
    if (const auto leader = keyed.find(coupling.leader); leader != keyed.end())
      angles.try_emplace(coupling.joint, 0).first->second[coupling.angle] +=
          coupling.share * std::max(leader->second[coupling.leads], coupling.from);
  return angles;
}

Clip sample(const Motion& motion, const Rig& rig, std::span<const Coupling> couplings) {
  Clip clip;
  clip.name = motion.name;
  clip.framesPerSecond = kFramesPerSecond;
  const int frames = int(std::lround(motion.seconds * kFramesPerSecond));
  std::map<int, std::size_t> trackOf;
  const std::map<int, vec4> moving = anglesAt(motion, rig, couplings, 0);
  for (std::size_t k = 0; k < rig.joints.size(); ++k)
    if (k == 0 || moving.contains(int(k))) {
      trackOf.emplace(int(k), clip.tracks.size());
      clip.tracks.emplace_back().joint = JointId{std::uint32_t(k)};
    }
  for (int frame = 0; frame <= frames; ++frame) {
    const float at = float(frame) / float(frames), time = float(frame) / kFramesPerSecond;
    std::vector<quat> rotations(rig.joints.size(), quat(1, 0, 0, 0));
    float lift = 0;
    for (const auto& [joint, value] : anglesAt(motion, rig, couplings, at)) {
      const int point = rig.joints[std::size_t(joint)];
      rotations[std::size_t(joint)] =
          rotationOf(rig.points[std::size_t(point)], rig.linkDirection(point), value);
      lift += value.w;
    }
    vec3 shift = groundShift(rig, posed(rig, rotations), motion.keepFeet);
    shift.y += lift;
    for (const auto& [joint, track] : trackOf) {
      clip.tracks[track].rotation.times.push_back(time);
      clip.tracks[track].rotation.values.push_back(rotations[std::size_t(joint)]);
    }
    Track<vec3>& root = clip.tracks.front().translation;
    root.times.push_back(time);
    root.values.push_back(rig.points[std::size_t(rig.joints[0])].position + shift);
  }
  clip.end = float(frames) / kFramesPerSecond;
  return clip;
}

void readKeys(Table& table, const Rig& rig, std::vector<Motion>& motions) {
  for (std::size_t r = 0; r < table.rowCount(); ++r) {
    const auto motion = std::find_if(motions.begin(), motions.end(),
                                     [&](const Motion& m) { return m.name == table.text(r, "clip"); });
    if (motion == motions.end()) return table.fault(r, "no clip of this name");
    const vec4 degrees{table.number(r, "flex_deg"), table.number(r, "abduct_deg"),
                       table.number(r, "twist_deg"), 0};
    Key key{table.number(r, "at"), glm::radians(degrees)};
    key.value.w = 1e-3f * table.numberOr(r, "up_mm", 0);
    const std::string_view name = table.text(r, "joint");
    for (Side side : sidesOf(table.text(r, "side"))) {
      const int point = rig.find(side == Side::right ? mirroredName(name) : std::string(name));
      if (point < 0 || rig.points[std::size_t(point)].landmark)
        return table.fault(r, "no joint " + quoted(name));
      std::vector<Key>& keys = motion->keys[rig.points[std::size_t(point)].joint];
      if (!keys.empty() && keys.back().at >= key.at) table.fault(r, "keys must follow one another");
      keys.push_back(key);
    }
  }
}

int angleNamed(Table& table, std::size_t row, std::string_view column) {
  constexpr std::string_view kNames[] = {"flex", "abduct", "twist"};
  const auto found = std::ranges::find(kNames, table.text(row, column));
  if (found != std::end(kNames)) return int(found - std::begin(kNames));
  table.fault(row, "an angle is flex, abduct or twist");
  return 0;
}

std::vector<Coupling> readCouplings(Table& table, const Rig& rig) {
  std::vector<Coupling> couplings;
  for (std::size_t r = 0; r < table.rowCount(); ++r)
    for (const bool right : {false, true}) {
      const auto jointNamed = [&](std::string_view column) {
        const std::string_view name = table.text(r, column);
        const int point = rig.find(right ? mirroredName(name) : std::string(name));
        if (point >= 0 && !rig.points[std::size_t(point)].landmark)
          return rig.points[std::size_t(point)].joint;
        table.fault(r, "no joint " + quoted(name));
        return 0;
      };
      Coupling coupling;
      coupling.joint = jointNamed("joint");
      coupling.leader = jointNamed("leader");
      coupling.angle = angleNamed(table, r, "angle");
      coupling.leads = angleNamed(table, r, "leads");
      coupling.share = table.number(r, "share");
      coupling.from = glm::radians(table.numberOr(r, "from_deg", -180));
      if (!right || mirroredName(table.text(r, "joint")) != table.text(r, "joint"))
        couplings.push_back(coupling);
    }
  return couplings;
}

}  // namespace

Result<std::vector<Clip>> makeClips(const std::filesystem::path& clipsPath,
                                    const std::filesystem::path& keysPath,
                                    const std::filesystem::path& couplingsPath, const Rig& rig) {
  Result<Table> clips = Table::read(clipsPath);
  if (!clips.ok()) return clips.error();
  Result<Table> keys = Table::read(keysPath);
  if (!keys.ok()) return keys.error();
  std::vector<Motion> motions;
  for (std::size_t r = 0; r < clips->rowCount(); ++r) {
    Motion motion;
    motion.name = clips->text(r, "clip");
    motion.seconds = clips->number(r, "seconds");
    motion.rightLag = clips->numberOr(r, "right_lag", 0);
    motion.loops = clips->text(r, "loops") == "yes";
    motion.keepFeet = clips->text(r, "stance") == "feet";
    motions.push_back(std::move(motion));
  }
  if (!clips->state().ok()) return clips->state().error();
  readKeys(*keys, rig, motions);
  if (!keys->state().ok()) return keys->state().error();
  Result<Table> couplingTable = Table::read(couplingsPath);
  if (!couplingTable.ok()) return couplingTable.error();
  const std::vector<Coupling> couplings = readCouplings(*couplingTable, rig);
  if (!couplingTable->state().ok()) return couplingTable->state().error();
  std::vector<Clip> result;
  result.reserve(motions.size());
  for (const Motion& motion : motions) result.push_back(sample(motion, rig, couplings));
  return result;
}

}  // namespace vasa::human
