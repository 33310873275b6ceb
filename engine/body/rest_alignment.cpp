#include "body/rest_alignment.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/ids.h"

namespace vasa {
namespace {

constexpr float kLeastBend = 0.1f;  // sine of an elbow's bend
constexpr float kMostHingeTurn = 1.0f;
// Cosine of 30 degrees: zero poses whose trunks differ by less once their sides point alike stand alike, as
// bones' slant from hips to neck is each skeleton's own.
constexpr float kSlant = 0.87f;
constexpr float kHangs = 0.9f;  // cosine of 26 degrees

std::optional<quat> turnOf(const std::optional<mat3>& from, const std::optional<mat3>& to) {
  if (!from || !to) return std::nullopt;
  return glm::normalize(glm::quat_cast(*to * glm::transpose(*from)));
}

// Direction of a limb's bone; zero where it is not known.
vec3 boneOf(const Rig& rig, std::uint32_t joint, std::string_view part) {
  const vec3 from = rig.centres[joint];
  return rig.boneEnd(joint, part, rig.centres, rig.tips).value_or(from) - from;
}

// Of a foot's leg.
std::uint32_t besideFoot(const Rig& rig, std::uint32_t foot, std::string_view part) {
  return rig.partNamed((rig.parts.of[foot].starts_with("left") ? "left" : "right") + std::string(part));
}

// Whether toes go on in the shin's line, as no foot that stands does.
bool hangs(const Rig& rig, std::uint32_t foot, vec3 toToes) {
  const std::uint32_t shin = besideFoot(rig, foot, "LowerLeg");
  return shin != kNone &&
         glm::dot(directionOf(toToes), directionOf(rig.centres[foot] - rig.centres[shin])) > kHangs;
}

// Along the fingers and towards the thumb; nothing where a hand has neither.
std::optional<mat3> handOf(const Rig& rig, std::uint32_t hand) {
  vec3 fingers(0), thumb(0);
  const std::string side(rig.parts.of[hand].starts_with("left") ? "left" : "right");
  const std::uint32_t root = rig.partNamed(side + "ThumbProximal");
  for (std::uint32_t j = hand + 1; j < rig.names.size(); ++j) {
    bool inHand = false, inThumb = false;
    for (std::uint32_t at = j; at != kNone && at >= hand; at = rig.parents[at])
      inHand = inHand || at == hand, inThumb = inThumb || at == root;
    if (inHand) (inThumb ? thumb : fingers) += rig.tips[j] - rig.centres[hand];
  }
  const vec3 along = directionOf(fingers), aside = directionOf(thumb - glm::dot(thumb, along) * along);
  if (along == vec3(0) || aside == vec3(0)) return std::nullopt;
  return mat3(along, aside, glm::cross(along, aside));
}

class Alignment {
 public:
  Alignment(const Motion& motion, std::uint32_t standing, std::span<const quat> turns, const Rig& from,
            const Rig& to, std::span<const std::uint32_t> source)
      : motion_(motion), standing_(standing), standingTurns_(turns), from_(from), to_(to), source_(source) {
    const auto own = trunkOf(to_, {"UpperLeg", "UpperArm"}),
               wanted = trunkOf(from_, {"UpperLeg", "UpperArm"});
    const auto hips = turnOf(own, wanted);
    const auto chest = turnOf(trunkOf(to_, {"UpperArm"}), trunkOf(from_, {"UpperArm"}));
    if (!hips) return;
    const quat sideways = turnBetween((*own)[0], (*wanted)[0]);
    const float slant = glm::dot(sideways, *hips);  // cosine of half of what is left
    hipsTurn_ = standing_ == MotionPose::kZero && 2 * slant * slant - 1 > kSlant ? sideways : *hips;
    chestTurn_ = standing_ != MotionPose::kZero && chest ? *chest : hipsTurn_;
  }

  std::vector<quat> run() const {
    std::vector<quat> alignment(source_.size(), kIdentity);
    for (std::uint32_t j = 0; j < source_.size(); ++j)
      alignment[j] = alignmentOf(j, to_.parents[j] == kNone ? hipsTurn_ : alignment[to_.parents[j]]);
    return alignment;
  }

 private:
  quat alignmentOf(std::uint32_t j, const quat& above) const {
    const std::uint32_t s = source_[j];
    const std::string_view part = to_.parts.of[j];
    if (s == kNone || part.empty()) return above;
    const quat trunk = part == "hips" || part == "spine" ? hipsTurn_ : chestTurn_;
    if (part.ends_with("Hand")) {
      const auto own = handOf(to_, j), wanted = handOf(from_, s);
      return own && wanted ? glm::normalize(glm::quat_cast(*wanted * glm::transpose(*own))) : above;
    }
    const vec3 own = boneOf(to_, j, part);
    vec3 wanted = boneOf(from_, s, part);
    // Where nothing tells where a forearm or a shin ends: zero poses have limbs straight.
    if (wanted == vec3(0) && isLowerBone(part)) wanted = standingTurns_[s] * motion_.joints[s].offset;
    if (own != vec3(0) && wanted != vec3(0)) {
      const quat turn = turnBetween(above * own, wanted) * above;
      return part.ends_with("UpperArm") ? hingeTurn(j, turn) * turn : turn;
    }
    const bool finger = part.find("Proximal") != part.npos || part.ends_with("Toes");
    if (finger) return above;
    if (!part.ends_with("Foot")) return trunk;
    // Zero poses have feet flat, but for some whose toes hang. In a frame of the motion feet need not be
    // flat: they are as their toes tell, else as the shin has them.
    const bool zero = standing_ == MotionPose::kZero;
    const std::uint32_t ownToes = besideFoot(to_, j, "Toes"), toes = besideFoot(from_, s, "Toes");
    if (ownToes == kNone || toes == kNone) return zero ? trunk : above;
    const vec3 foot = to_.centres[ownToes] - to_.centres[j], points = from_.centres[toes] - from_.centres[s];
    if (zero && hangs(to_, j, foot) == hangs(from_, s, points)) return trunk;
    return turnBetween(above * foot, points) * above;
  }

  // The turn about an upper arm that makes the elbow bend about the axis it is bent about at rest: no
  // direction of a bone tells how an arm is turned. None where the body's arm is straight at rest or the
  // motion never bends.
  quat hingeTurn(std::uint32_t upper, const quat& turn) const {
    const std::string side(to_.parts.of[upper].starts_with("left") ? "left" : "right");
    const std::uint32_t lower = to_.partNamed(side + "LowerArm");
    if (lower == kNone || source_[lower] == kNone || from_.parents[source_[lower]] != source_[upper])
      return kIdentity;
    const vec3 along = directionOf(boneOf(to_, upper, side + "UpperArm")),
               on = directionOf(boneOf(to_, lower, side + "LowerArm"));
    const vec3 sourceAlong = directionOf(boneOf(from_, source_[upper], side + "UpperArm")),
               sourceOn = directionOf(boneOf(from_, source_[lower], side + "LowerArm"));
    vec3 bends(0);
    const std::uint32_t foreArm = source_[lower], arm = source_[upper];
    const quat toForeArm = glm::conjugate(standingTurns_[arm]) * standingTurns_[foreArm];
    for (std::uint32_t frame = 0; frame < motion_.frameCount; ++frame) {
      // The forearm's turn beyond its standing one, seen from the arm as it stands.
      const quat bend = standingTurns_[arm] * motion_.rotation(frame, foreArm) * glm::conjugate(toForeArm) *
                        glm::conjugate(standingTurns_[arm]);
      bends += glm::cross(sourceAlong, bend * sourceOn);
    }
    const vec3 own = glm::cross(along, on), wanted = bends / float(motion_.frameCount);
    if (glm::length(own) < kLeastBend || glm::length(wanted) < kLeastBend) return kIdentity;
    const vec3 a = directionOf(turn * own),
               b = directionOf(wanted - glm::dot(wanted, sourceAlong) * sourceAlong);
    const float angle = std::atan2(glm::dot(glm::cross(a, b), sourceAlong), glm::dot(a, b));
    return glm::angleAxis(std::clamp(angle, -kMostHingeTurn, kMostHingeTurn), sourceAlong);
  }

  const Motion& motion_;
  std::uint32_t standing_;
  std::span<const quat> standingTurns_;
  const Rig &from_, &to_;
  std::span<const std::uint32_t> source_;
  quat hipsTurn_ = kIdentity, chestTurn_ = kIdentity;  // from the body's trunk to the motion's
};

}  // namespace

std::vector<quat> alignRest(const Motion& motion, std::uint32_t standing, std::span<const quat> turns,
                            const Rig& from, const Rig& to, std::span<const std::uint32_t> source) {
  return Alignment(motion, standing, turns, from, to, source).run();
}

}  // namespace vasa
