#include "body/trunk.h"

#include <algorithm>
#include <array>

#include "core/ids.h"

namespace vasa {
namespace {

constexpr std::size_t kSpineNames = 3;

bool isSpine(std::string_view part) { return part == "spine" || part == "chest" || part == "upperChest"; }

// The joint that two lead back to; none where they share none.
std::uint32_t whereMeet(const Rig& rig, std::uint32_t left, std::uint32_t right) {
  for (std::uint32_t a = left; a != kNone; a = rig.parents[a])
    if (right != kNone && hangsOn(rig.parents, right, a)) return a;
  return kNone;
}

std::uint32_t armsMeet(const Rig& rig) {
  return whereMeet(rig, rig.partNamed("leftUpperArm"), rig.partNamed("rightUpperArm"));
}

// Where both legs leave the trunk, in rigs that call the hips a spine.
void findHips(Rig& rig) {
  const std::uint32_t left = rig.partNamed("leftUpperLeg"), right = rig.partNamed("rightUpperLeg");
  if (rig.partNamed("hips") != kNone || left == kNone || right == kNone) return;
  if (const std::uint32_t hips = whereMeet(rig, rig.parents[left], rig.parents[right]); hips != kNone)
    rig.parts.of[hips] = humanoidPart("hips");
}

// The joint before one that hangs on `top` itself.
std::uint32_t firstOn(const Rig& rig, std::uint32_t joint, std::uint32_t top) {
  while (joint != kNone && rig.parents[joint] != top) joint = rig.parents[joint];
  return joint;
}

// What goes on beyond the shoulders: up to the last joint that is called a head, or a spine, too; else
// towards the highest one.
void findHead(Rig& rig) {
  const std::uint32_t chest = armsMeet(rig), hips = rig.partNamed("hips");
  if (rig.partNamed("neck") != kNone || chest == kNone || hips == kNone) return;
  const vec3 up = rig.centres[chest] - rig.centres[hips];
  std::uint32_t head = rig.partNamed("head"), highest = kNone;
  float most = 0;
  for (auto j = std::uint32_t(rig.names.size()); j-- > 0;) {
    const std::uint32_t first = firstOn(rig, j, chest);
    if (first == kNone || hangsOn(rig.parents, rig.partNamed("leftUpperArm"), first) ||
        hangsOn(rig.parents, rig.partNamed("rightUpperArm"), first))
      continue;
    if (head == kNone && isSpine(rig.parts.of[j])) head = j;
    if (const float rise = glm::dot(rig.tips[j] - rig.centres[chest], up); rise > most)
      most = rise, highest = j;
  }
  if (head == kNone && highest != kNone) {
    const std::uint32_t neck = firstOn(rig, highest, chest);
    head = neck == highest ? neck : firstOn(rig, highest, neck);
  }
  const std::uint32_t neck = firstOn(rig, head, chest);
  if (neck == kNone) return;
  rig.parts.of[head] = humanoidPart("head");
  if (neck != head) rig.parts.of[neck] = humanoidPart("neck");
}

void findSpine(Rig& rig) {
  const std::vector<std::uint32_t> joints = findTrunk(rig).joints;
  const auto named =
      std::size_t(std::ranges::count_if(joints, [&](std::uint32_t j) { return isSpine(rig.parts.of[j]); }));
  if (named >= std::min(joints.size(), kSpineNames)) return;
  for (std::string_view& part : rig.parts.of)
    if (isSpine(part)) part = {};
  nameSpine(joints, rig.parts.of);
}

// The highest joint of the trunk, and what the trunk ends at.
std::uint32_t topOf(const Rig& rig, std::vector<std::uint32_t>& ends) {
  if (const std::uint32_t neck = rig.partNamed("neck"); neck != kNone) {
    ends = {neck};
    return rig.parents[neck];
  }
  if (const std::uint32_t chest = armsMeet(rig); chest != kNone) {
    ends = {rig.partNamed("leftUpperArm"), rig.partNamed("rightUpperArm")};
    return chest;
  }
  if (const std::uint32_t head = rig.partNamed("head"); head != kNone) {
    ends = {head};
    return rig.parents[head];
  }
  for (const char* part : {"upperChest", "chest", "spine"})
    if (const std::uint32_t joint = rig.partNamed(part); joint != kNone) {
      ends = {joint};
      return joint;
    }
  return kNone;
}

}  // namespace

vec3 Trunk::end(std::span<const vec3> places) const {
  vec3 sum(0);
  for (const std::uint32_t joint : ends) sum += places[joint];
  return sum / float(ends.size());
}

Trunk findTrunk(const Rig& rig) {
  Trunk trunk;
  trunk.hips = rig.partNamed("hips");
  const std::uint32_t top = topOf(rig, trunk.ends);
  if (!trunk.known()) return trunk;
  const auto carriesLegs = [&](std::uint32_t joint) {
    return std::ranges::any_of(std::array{"hips", "leftUpperLeg", "rightUpperLeg"}, [&](const char* part) {
      const std::uint32_t below = rig.partNamed(part);
      return below != kNone && hangsOn(rig.parents, below, joint);
    });
  };
  std::uint32_t joint = top;
  for (; joint != kNone && !carriesLegs(joint); joint = rig.parents[joint]) trunk.joints.push_back(joint);
  if (joint == kNone) trunk.joints.clear();
  std::ranges::reverse(trunk.joints);

  float length = 0;
  vec3 before = rig.centres[trunk.hips];
  for (const std::uint32_t j : trunk.joints) {
    length += glm::distance(before, rig.centres[j]);
    trunk.shares.push_back(length);
    before = rig.centres[j];
  }
  length += glm::distance(before, trunk.end(rig.centres));
  for (float& share : trunk.shares) share = length > 0 ? share / length : 0;
  return trunk;
}

int uprightAxis(const Rig& rig) {
  const Trunk trunk = findTrunk(rig);
  if (!trunk.known()) return 1;
  const vec3 way = glm::abs(trunk.way(rig.centres));
  return way.y >= std::max(way.x, way.z) ? 1 : way.x > way.z ? 0 : 2;
}

void nameTrunk(Rig& rig) {
  findHips(rig);
  findHead(rig);
  findSpine(rig);
}

}  // namespace vasa
