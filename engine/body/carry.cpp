#include "body/carry.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "body/belonging.h"
#include "body/binding.h"
#include "body/deform.h"
#include "body/inside.h"
#include "body/motion_rest.h"
#include "body/retarget.h"
#include "body/rib_heads.h"
#include "body/skin_warp.h"
#include "body/ties.h"
#include "body/trunk.h"
#include "core/ids.h"
#include "core/parallel.h"

namespace vasa {
namespace {

// In a hand with more fingers than the other body's, single fingers would be drawn aside: they go with the
// palm.
void releaseLonely(const Skeleton& skeleton, std::vector<std::uint32_t>& match) {
  // Branches that end without a match are what counts: a free joint on the way to matched ones is no finger.
  std::vector<bool> leadsToMatch(match.size());
  for (std::size_t j = match.size(); j-- > 0;) {
    if (match[j] != kNone) leadsToMatch[j] = true;
    if (const JointId parent = skeleton.joints[j].parent; leadsToMatch[j] && parent.valid())
      leadsToMatch[parent.value] = true;
  }
  std::vector<int> matched(match.size(), 0), released(match.size(), 0);
  for (std::size_t j = 0; j < match.size(); ++j)
    if (skeleton.joints[j].parent.valid())
      (leadsToMatch[j] ? matched : released)[skeleton.joints[j].parent.value]++;
  for (std::size_t j = 0; j < match.size(); ++j)
    if (const JointId parent = skeleton.joints[j].parent;
        parent.valid() && released[parent.value] > matched[parent.value])
      match[j] = kNone;
}

// The joints that stand for the pelvis. Rigs put that of the hips anywhere between femoral heads and lumbar
// spine, and helpers beside it: a pelvis is where its legs hang on it.
struct Pelvis {
  std::vector<std::size_t> joints;  // hips, and what lies between them and a leg
  std::size_t left = 0, right = 0;  // upper legs

  Pelvis(const Skeleton& skeleton, std::span<const std::uint32_t> match) {
    const HumanoidNames parts = partsOf(skeleton);
    const std::size_t hips = partNamed(parts.of, "hips");
    left = partNamed(parts.of, "leftUpperLeg"), right = partNamed(parts.of, "rightUpperLeg");
    if (std::max({hips, left, right}) >= match.size() || match[left] == kNone || match[right] == kNone)
      return;
    for (const std::size_t leg : {left, right})
      for (JointId j = skeleton.joints[leg].parent; j.valid() && j.value >= hips;
           j = skeleton.joints[j.value].parent)
        joints.push_back(j.value);
  }
  void settle(std::vector<vec3>& centres) const {
    for (const std::size_t joint : joints) centres[joint] = 0.5f * (centres[left] + centres[right]);
  }
};

constexpr float kPullBlur = 0.02f;  // of the body's height: about the distance between two ribs

// How far from joint a to joint b a joint sits, as a share.
float shareBetween(std::span<const vec3> centres, std::size_t a, std::size_t b, std::size_t joint) {
  const vec3 way = centres[b] - centres[a];
  return glm::dot(centres[joint] - centres[a], way) / std::max(glm::dot(way, way), 1e-12f);
}

// Releases joints between the two ends of a chain until no part of it is stretched or squeezed by more than
// kMostUneven beside the whole of it.
// @param own, other  the first body's joints, and those matched with them
void releaseUneven(const Skeleton& from, std::span<const vec3> own, std::span<const vec3> other,
                   std::size_t first, std::size_t last, std::vector<std::uint32_t>& match) {
  constexpr float kMostUneven = 1.15f;
  struct Stop {
    std::size_t joint;
    float own, other;
  };
  std::vector<Stop> stops;
  for (JointId j{std::uint32_t(last)}; j.valid(); j = from.joints[j.value].parent) {
    if (match[j.value] != kNone)
      stops.push_back(
          {j.value, shareBetween(own, first, last, j.value), shareBetween(other, first, last, j.value)});
    if (j.value == first) break;
  }
  while (stops.size() > 2) {
    std::size_t worst = 0;
    float most = std::log(kMostUneven);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const float here = stops[i].own - stops[i + 1].own, there = stops[i].other - stops[i + 1].other;
      const float uneven = here > 0 && there > 0 ? std::abs(std::log(there / here)) : 1e9f;
      if (uneven > most) most = uneven, worst = i + 1;
    }
    if (worst == 0) return;
    // Of the part's two ends the one that is farther from its place; the chain's own ends stay.
    const auto off = [&](std::size_t i) {
      return i == 0 || i + 1 == stops.size() ? -1.0f : std::abs(stops[i].own - stops[i].other);
    };
    const std::size_t gone = off(worst) > off(worst - 1) ? worst : worst - 1;
    match[stops[gone].joint] = kNone;
    stops.erase(stops.begin() + std::ptrdiff_t(gone));
  }
}

// Rigs put the joints of a spine at other vertebrae, those that only twist a limb at other places along it,
// and that of a palm at the wrist or the knuckles, under the same names: they go with the trunk, the limb or
// the hand as a whole.
void releaseMisplaced(const Skeleton& from, std::span<const vec3> own, std::span<const vec3> other,
                      std::vector<std::uint32_t>& match) {
  const HumanoidNames parts = partsOf(from);
  const auto release = [&](const std::string& start, const std::string& end) {
    const std::uint32_t a = partNamed(parts.of, start), b = partNamed(parts.of, end);
    if (a < match.size() && b < match.size() && match[a] != kNone && match[b] != kNone)
      releaseUneven(from, own, other, a, b, match);
  };
  release("hips", "neck"), release("neck", "head");
  for (const std::string side : {"left", "right"})
    release(side + "LowerArm", side + "Hand"), release(side + "UpperArm", side + "LowerArm");
  for (std::size_t finger = 0; finger < match.size(); ++finger) {
    const JointId palm = from.joints[finger].parent;
    const JointId hand = palm.valid() ? from.joints[palm.value].parent : palm;
    const auto onPalm = [&](const Skeleton::Joint& joint) { return joint.parent == palm; };
    if (hand.valid() && parts.of[hand.value].ends_with("Hand") && match[finger] != kNone &&
        match[hand.value] != kNone && std::ranges::count_if(from.joints, onPalm) > 1)
      releaseUneven(from, own, other, hand.value, finger, match);
  }
}

// How long the ways from each matched joint to the matched one before it are in all. Unlike how far apart
// joints lie, it does not change with how the arms are held at rest.
float linksLength(std::span<const vec3> centres, const Skeleton& from, std::span<const std::uint32_t> match) {
  double sum = 0;
  for (std::size_t j = 0; j < match.size(); ++j) {
    if (match[j] == kNone) continue;
    JointId before = from.joints[j].parent;
    while (before.valid() && match[before.value] == kNone) before = from.joints[before.value].parent;
    if (!before.valid()) continue;
    sum += glm::distance(dvec3(centres[j]), dvec3(centres[before.value]));
  }
  return float(sum);
}

// How far the skin of a joint and of what hangs on it reaches from the joint [m].
float skinReach(const Body& body, std::size_t joint) {
  std::vector<bool> own(body.skeleton.joints.size());
  for (std::size_t j = joint; j < own.size(); ++j) {
    const JointId parent = body.skeleton.joints[j].parent;
    own[j] = j == joint || (parent.valid() && own[parent.value]);
  }
  float reach = 0;
  for (const SkinnedMesh& skinned : body.meshes) {
    const TriangleMesh mesh = meshAtRest(body, skinned);
    for (const uvec3& triangle : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        if (const SkinInfluence& by = skinned.influences[triangle[k]]; own[by.joints[by.heaviest()]])
          reach = std::max(reach, glm::distance(mesh.positions[triangle[k]],
                                                vec3(body.skeleton.joints[joint].restWorld[3])));
  }
  return reach;
}

// x -> target + linear (x - centre)
struct Stretch {
  vec3 centre{0}, target{0};
  mat3 linear{1};
  vec3 operator()(vec3 x) const { return target + linear * (x - centre); }
};

mat3 turnAndStretch(vec3 from, vec3 to, float across) {
  const float length = glm::length(from), wanted = glm::length(to);
  if (!(length > 0) || !(wanted > 0)) return mat3(across);
  const vec3 a = from / length, b = to / wanted;
  const mat3 stretch = across * mat3(1) + (wanted / length - across) * glm::outerProduct(a, a);
  const float cosine = glm::dot(a, b);
  if (cosine < -0.99f) return stretch;
  return mat3_cast(glm::normalize(quat(1 + cosine, glm::cross(a, b)))) * stretch;
}

constexpr float kWholeLimb = 0.75f;  // of the other body's limb; what is shorter is a stump

class Carrier {
 public:
  Carrier(const Network& network, const Body& from, const Body& to, std::string_view name)
      : network_(network), from_(from), to_(to), name_(name) {}

  Result<CarriedNetwork> run(const JointMap& map) {
    auto pairs = matchedJoints(standingStill(to_), from_, map);
    if (!pairs) return pairs.error();
    match_ = std::move(pairs->source);
    findMissing();
    releaseLonely(from_.skeleton, match_);
    findCentres();
    releaseMisplaced(from_.skeleton, own_, other_, match_);
    auto pose = retargeted(standingStill(to_), from_, map);
    if (!pose) return pose.error();
    if (auto posed = poseAll(pose->clip); !posed) return posed.error();
    layDown(pose->up);
    namePressed();
    measureSizes();
    stretchAll();
    followRibs();
    warpToSkin();
    out_.points.assign(points_.begin(), points_.begin() + std::ptrdiff_t(network_.points().size()));
    for (vec4& p : out_.points) p.w *= out_.radiusFactor;
    pushInside();
    pinEnds(network_, out_.points);
    out_.bodyHeight = to_.height();
    return std::move(out_);
  }

 private:
  void findCentres() {
    const Pelvis pelvis(from_.skeleton, match_);
    own_.clear(), other_.clear();
    for (std::size_t j = 0; j < match_.size(); ++j) {
      own_.emplace_back(from_.skeleton.joints[j].restWorld[3]);
      other_.emplace_back(match_[j] == kNone ? vec3(0) : vec3(to_.skeleton.joints[match_[j]].restWorld[3]));
    }
    pelvis.settle(own_), pelvis.settle(other_);
  }

  // Vessels and skin are bound together, so that they move alike.
  Result<void> poseAll(const Clip& clip) {
    skin_ = skinAtRest(from_);
    std::vector<vec4> rest(network_.points().begin(), network_.points().end());
    for (const vec3& p : skin_.positions) rest.push_back(vec4(p, 0));
    headsWanted_ = ribHeads(to_);
    if (!headsWanted_.empty())
      for (const vec3& p : ribHeads(from_)) rest.push_back(vec4(p, 0));
    std::vector<Tie> ties = tiesOf(network_);
    // Among the skin's points a few vessels would not be noticed.
    const auto spines = deriveSpines(from_.skeleton, from_.name);
    if (!spines) return spines.error();
    if (auto belongs = checkBelongs(from_, *spines, network_.points(), name_); !belongs)
      return belongs.error();
    auto binding = bindPoints(from_, rest, name_, ties);
    if (!binding) return binding.error();
    binding_ = std::move(*binding);
    pose_ = samplePose(from_.skeleton, clip, 0);
    points_.resize(rest.size());
    Deformer(binding_).run(rest, pose_, points_);
    return {};
  }

  void findMissing() {
    const HumanoidNames parts = partsOf(from_.skeleton);
    missing_.assign(match_.size(), false);
    findCentres();
    const float size = linksLength(other_, from_.skeleton, match_) /
                       std::max(linksLength(own_, from_.skeleton, match_), 1e-6f);
    // Without joints of its own a limb may be there all the same, moved by its upper part's alone.
    const auto isOfOneBone = [&](const std::string& upper) {
      const std::uint32_t part = partNamed(parts.of, upper);
      if (part >= match_.size() || match_[part] == kNone) return false;
      const float reach = skinReach(from_, part);
      return reach > 0 && skinReach(to_, match_[part]) > kWholeLimb * size * reach;
    };
    const auto look = [&](const std::string& limb, const std::string& upper,
                          std::initializer_list<std::string> told) {
      bool known = false;
      std::vector<bool> own(match_.size());
      for (std::size_t j = 0; j < match_.size(); ++j) {
        const JointId parent = from_.skeleton.joints[j].parent;
        if (std::ranges::find(told, parts.of[j]) != told.end()) {
          if (match_[j] != kNone) return;
          known = own[j] = true;
        }
        own[j] = own[j] || (parent.valid() && own[parent.value]);
      }
      if (!known || isOfOneBone(upper)) return;
      out_.limbsMissing.push_back(limb);
      for (std::size_t j = 0; j < own.size(); ++j) missing_[j] = missing_[j] || own[j];
    };
    look("head", "neck", {"neck", "head"});
    for (const std::string side : {"left", "right"}) {
      look(side + " arm", side + "UpperArm", {side + "LowerArm", side + "Hand"});
      look(side + " leg", side + "UpperLeg", {side + "LowerLeg", side + "Foot"});
    }
  }

  void namePressed() {
    if (out_.limbsMissing.empty()) return;
    const std::vector<Station> stations = mainStations(binding_);
    for (const Vessel& vessel : network_.vessels()) {
      std::size_t count = 0;
      for (std::uint32_t i = 0; i < vessel.pointCount; ++i)
        count += missing_[stations[vessel.firstPoint + i].joint.value];
      if (4 * count >= vessel.pointCount) out_.vesselsPressed.push_back(vessel.name);
    }
  }

  // A motion is told upright; the other body may lie at rest.
  void layDown(vec3 up) {
    if (up == vec3(0, 1, 0)) return;
    const mat3 turn = glm::transpose(uprightTurn(up));
    for (vec4& point : points_) point = vec4(turn * vec3(point), point.w);
    for (mat4& joint : pose_.world) joint = mat4(turn) * joint;
  }

  void measureSizes() {
    for (std::uint32_t j = 0; j < match_.size(); ++j)
      if (match_[j] != kNone)
        ++out_.jointsMatched;
      else
        out_.jointsFree.push_back(from_.skeleton.joints[j].name);
    out_.radiusFactor =
        linksLength(other_, from_.skeleton, match_) / linksLength(own_, from_.skeleton, match_);
    for (const mat4& joint : pose_.world) posed_.emplace_back(joint[3]);
    Pelvis(from_.skeleton, match_).settle(posed_);
  }

  // The next matched joint along the same limb.
  std::uint32_t nextMatched(std::uint32_t joint) const {
    for (JointId next = binding_.spines.joints[joint].next; next.valid();
         next = binding_.spines.joints[next.value].next)
      if (match_[next.value] != kNone &&
          glm::distance(posed_[next.value], posed_[joint]) > 0.01f * out_.radiusFactor)
        return next.value;
    return kNone;
  }

  std::vector<Stretch> stretches() const {
    std::vector<Stretch> all(match_.size());
    for (std::uint32_t j = 0; j < match_.size(); ++j) {
      const JointId parent = from_.skeleton.joints[j].parent;
      if (match_[j] == kNone) {
        if (parent.valid()) all[j] = all[parent.value];
        continue;
      }
      Stretch& own = all[j];
      own.centre = posed_[j], own.target = other_[j];
      const std::uint32_t next = nextMatched(j);
      if (next != kNone)
        own.linear = turnAndStretch(posed_[next] - own.centre, other_[next] - own.target, out_.radiusFactor);
      else
        own.linear = mat3(out_.radiusFactor);
    }
    return all;
  }

  // Each point's shares of the joints, from its binding: between the bone before a joint and the joint's own.
  void stretchAll() {
    const std::vector<Stretch> all = stretches();
    const auto after = [&](std::uint32_t joint, vec3 p) { return all[joint](p); };
    const auto before = [&](std::uint32_t joint, vec3 p) {
      const JointId parent = from_.skeleton.joints[joint].parent;
      return parent.valid() ? all[parent.value](p) : all[joint](p);
    };
    std::size_t r = 0;
    for (vec4& point : points_) {
      const vec3 p(point);
      vec3 mean(0), limb(0);
      bool starts = true;
      for (std::uint32_t left = kWholeShare; left > 0; ++r) {
        const BindingRecord& record = binding_.records[r];
        // Beyond the arc all is the joint's own: between two bodies at rest there is no twist to spread.
        const float share = std::min(record.station().along, 1.0f);
        limb = glm::mix(before(record.joint, p), starts ? after(record.joint, p) : limb, share);
        mean += float(record.share) / float(kWholeShare) * limb;
        starts = record.share != 0;
        left -= record.share;
      }
      point = vec4(mean, point.w);
    }
  }

  // People of one height differ by vertebrae in where a chest ends. Where the bones of both tell the heads of
  // their ribs, these come to lie at one another's height, and what is around them goes with the nearest
  // ones; the joints of limbs, pelvis and neck stay. How a back is curved the joints and the skin tell.
  void followRibs() {
    const std::size_t first = network_.points().size() + skin_.positions.size();
    if (headsWanted_.empty() || points_.size() - first != headsWanted_.size()) return;
    struct Pull {
      vec3 place, move;
    };
    const Rig rig = rigOf(to_.skeleton);
    const Trunk trunk = findTrunk(rig);
    const vec3 up = glm::normalize(trunk.way(rig.centres));
    const auto height = [&](vec3 p) { return glm::dot(p, up); };
    std::vector<Pull> pulls;
    for (std::size_t k = 0; k < headsWanted_.size(); ++k) {
      const vec3 place(points_[first + k]);
      pulls.push_back({place, height(headsWanted_[k] - place) * up});
    }
    const float lowest = height(std::ranges::min(headsWanted_, {}, height));
    for (std::size_t j = 0; j < match_.size(); ++j) {
      const bool amongRibs =
          std::ranges::find(trunk.joints, match_[j]) != trunk.joints.end() && height(other_[j]) > lowest;
      if (match_[j] != kNone && !amongRibs) pulls.push_back({other_[j], vec3(0)});
    }
    const float blur = kPullBlur * to_.height();
    parallelFor(first, 64, [&](std::size_t i) {
      vec3 sum(0);
      float weights = 0;
      for (const Pull& pull : pulls) {
        const vec3 way = pull.place - vec3(points_[i]);
        const float near = 1 / (glm::dot(way, way) + blur * blur);
        sum += near * near * pull.move, weights += near * near;
      }
      points_[i] += vec4(sum / weights, 0);
    });
  }

  void warpToSkin() {
    TriangleMesh target = skinAtRest(to_);
    if (skin_.empty() || target.empty()) return;
    shell_ = std::make_unique<SkinShell>(std::move(target));
    for (std::size_t v = 0; v < skin_.positions.size(); ++v)
      skin_.positions[v] = vec3(points_[network_.points().size() + v]);
    const float height = shell_->mesh().bounds().extent()[uprightAxis(rigOf(to_.skeleton))];
    SkinWarp(skin_, *shell_, height).run(std::span(points_).first(network_.points().size()));
  }

  void pushInside() {
    if (!shell_) return;
    const SkinShell before(skinAtRest(from_));
    std::vector<float> depths(out_.points.size());
    parallelFor(depths.size(), 32, [&](std::size_t i) {
      depths[i] = out_.radiusFactor * before.look(vec3(network_.points()[i])).depth;
    });
    out_.pushedIn = moveInside(network_, depths, *shell_, to_.height(), out_.points);
  }

  const Network& network_;
  const Body &from_, &to_;
  std::string name_;
  std::vector<std::uint32_t> match_;  // of each joint of the first body
  std::vector<vec3> own_, other_;     // centres of the first body's joints, of those matched with them ...
  std::vector<vec3> posed_;           // ... and of the first body's as the other one stands
  std::vector<vec3> headsWanted_;     // of the second body's ribs; none where bones do not tell
  std::vector<bool> missing_;         // which of them belong to limbs that the other body lacks
  Binding binding_;
  Pose pose_;
  TriangleMesh skin_;
  std::vector<vec4> points_;  // of the network, then of the skin
  std::unique_ptr<SkinShell> shell_;
  CarriedNetwork out_;
};

}  // namespace

Result<CarriedNetwork> carryNetwork(const Network& network, const Body& from, const Body& to,
                                    std::string_view name, const JointMap& map) {
  return Carrier(network, from, to, name).run(map);
}

SkinReport measureOutside(const Network& network, std::span<const vec4> points, const Body& body) {
  return measureOutside(network, points, skinAtRest(body));
}

SkinReport measureOutside(const Network& network, std::span<const vec4> points, TriangleMesh skin) {
  SkinReport report;
  if (skin.empty()) return report;
  const SkinShell shell(std::move(skin));
  constexpr int kPerSpan = 4;
  std::vector<SkinReport::VesselShare> all(network.vessels().size());
  std::vector<double> far(all.size(), 0);
  parallelFor(all.size(), 1, [&](std::size_t v) {
    const Vessel& vessel = network.vessels()[v];
    const auto own = Network::pointsOf(vessel, points);
    all[v].vessel = {std::uint32_t(v)};
    for (std::uint32_t i = 0; i < kPerSpan * vessel.spanCount(); ++i) {
      const vec3 a(evaluate(own, float(i) / kPerSpan)), b(evaluate(own, float(i + 1) / kPerSpan));
      const double length = glm::distance(a, b);
      const float depth = shell.look(0.5f * (a + b)).depth;
      all[v].length += length;
      if (depth >= 0) continue;
      all[v].outside += length;
      all[v].farthest = std::max(all[v].farthest, -depth);
      if (depth < -0.005f) far[v] += length;
    }
  });
  for (std::size_t v = 0; v < all.size(); ++v) {
    report.length += all[v].length, report.outside += all[v].outside, report.outside5mm += far[v];
    if (all[v].outside > 0) report.vessels.push_back(all[v]);
  }
  std::ranges::stable_sort(report.vessels, std::greater{}, &SkinReport::VesselShare::outside);
  return report;
}

}  // namespace vasa
