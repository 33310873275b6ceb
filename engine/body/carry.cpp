#include "body/carry.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "body/binding.h"
#include "body/deform.h"
#include "body/retarget.h"
#include "body/skin_warp.h"
#include "body/ties.h"
#include "core/parallel.h"

namespace vasa {
namespace {

constexpr std::uint32_t kNone = JointId::kNone;

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

vec3 centreIn(const Skeleton& skeleton, std::size_t joint) {
  return vec3(skeleton.joints[joint].restWorld[3]);
}

// How far from joint a to joint b a joint sits, as a share.
float shareBetween(const Skeleton& skeleton, std::size_t a, std::size_t b, std::size_t joint) {
  const vec3 way = centreIn(skeleton, b) - centreIn(skeleton, a);
  return glm::dot(centreIn(skeleton, joint) - centreIn(skeleton, a), way) /
         std::max(glm::dot(way, way), 1e-12f);
}

// Rigs put the joints of a spine at other vertebrae, and those that only twist a limb at other places along
// it, under the same names: the former go with the trunk as a whole, the latter with the limb.
void releaseMisplaced(const Skeleton& from, const Skeleton& to, std::vector<std::uint32_t>& match) {
  constexpr float kSamePlace = 0.15f;
  const auto matched = [&](std::size_t j) { return j < match.size() && match[j] != kNone; };
  const auto release = [&](std::size_t a, std::size_t b, std::size_t j) {
    if (!matched(a) || !matched(b) || !matched(j)) return;
    const float own = shareBetween(from, a, b, j), other = shareBetween(to, match[a], match[b], match[j]);
    if (std::abs(own - other) > kSamePlace) match[j] = kNone;
  };
  std::vector<std::string> names;
  for (const auto& joint : from.joints) names.push_back(joint.name);
  const HumanoidNames parts = humanoidNames(names);
  const auto jointOf = [&](std::string_view part) {
    return std::size_t(std::ranges::find(parts.of, part) - parts.of.begin());
  };
  for (const std::string_view part : {"spine", "chest", "upperChest"})
    release(jointOf("hips"), jointOf("neck"), jointOf(part));
  for (const std::string_view side : {"left", "right"})
    for (const auto& [upper, lower] : {std::pair("LowerArm", "Hand"), std::pair("UpperArm", "LowerArm")}) {
      const std::size_t a = jointOf(std::string(side) + upper), b = jointOf(std::string(side) + lower);
      if (!matched(a) || !matched(b)) continue;
      for (JointId j = from.joints[b].parent; j.valid() && j.value != a; j = from.joints[j.value].parent)
        release(a, b, j.value);
    }
}

// How long the ways from each matched joint to the matched one before it are in all. Unlike how far apart
// joints lie, it does not change with how the arms are held at rest.
float linksLength(const Skeleton& skeleton, const Skeleton& from, std::span<const std::uint32_t> match,
                  bool matched) {
  double sum = 0;
  for (std::size_t j = 0; j < match.size(); ++j) {
    if (match[j] == kNone) continue;
    JointId before = from.joints[j].parent;
    while (before.valid() && match[before.value] == kNone) before = from.joints[before.value].parent;
    if (!before.valid()) continue;
    const auto centre = [&](std::size_t joint) {
      return dvec3(centreIn(skeleton, matched ? match[joint] : joint));
    };
    sum += glm::distance(centre(j), centre(before.value));
  }
  return float(sum);
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

class Carrier {
 public:
  Carrier(const Network& network, const Body& from, const Body& to, std::string_view name)
      : network_(network), from_(from), to_(to), name_(name) {}

  Result<CarriedNetwork> run(const JointMap& map) {
    auto pairs = matchedJoints(standingStill(to_), from_, map);
    if (!pairs) return pairs.error();
    match_ = std::move(*pairs);
    releaseLonely(from_.skeleton, match_);
    releaseMisplaced(from_.skeleton, to_.skeleton, match_);
    auto pose = retarget(standingStill(to_), from_, map);
    if (!pose) return pose.error();
    if (auto posed = poseAll(*pose); !posed) return posed.error();
    measureSizes();
    stretchAll();
    warpToSkin();
    out_.points.assign(points_.begin(), points_.begin() + std::ptrdiff_t(network_.points().size()));
    for (vec4& p : out_.points) p.w *= out_.radiusFactor;
    pushInside();
    pinEnds(network_, out_.points);
    out_.bodyHeight = to_.height();
    return std::move(out_);
  }

 private:
  // Vessels and skin are bound together, so that they move alike.
  Result<void> poseAll(const Clip& clip) {
    skin_ = skinAtRest(from_);
    std::vector<vec4> rest(network_.points().begin(), network_.points().end());
    for (const vec3& p : skin_.positions) rest.push_back(vec4(p, 0));
    std::vector<Tie> ties = tiesOf(network_);
    auto binding = bindPoints(from_, rest, name_, ties);
    if (!binding) return binding.error();
    binding_ = std::move(*binding);
    pose_ = samplePose(from_.skeleton, clip, 0);
    points_.resize(rest.size());
    Deformer(binding_).run(rest, pose_, points_);
    return {};
  }

  void measureSizes() {
    for (std::uint32_t j = 0; j < match_.size(); ++j)
      if (match_[j] != kNone)
        ++out_.jointsMatched;
      else
        out_.jointsFree.push_back(from_.skeleton.joints[j].name);
    out_.radiusFactor = linksLength(to_.skeleton, from_.skeleton, match_, true) /
                        linksLength(from_.skeleton, from_.skeleton, match_, false);
  }

  vec3 centreOf(std::uint32_t joint) const { return vec3(pose_.world[joint][3]); }
  vec3 targetOf(std::uint32_t joint) const { return vec3(to_.skeleton.joints[match_[joint]].restWorld[3]); }

  // The next matched joint along the same limb.
  std::uint32_t nextMatched(std::uint32_t joint) const {
    for (JointId next = binding_.spines.joints[joint].next; next.valid();
         next = binding_.spines.joints[next.value].next)
      if (match_[next.value] != kNone &&
          glm::distance(centreOf(next.value), centreOf(joint)) > 0.01f * out_.radiusFactor)
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
      own.centre = centreOf(j), own.target = targetOf(j);
      const std::uint32_t next = nextMatched(j);
      if (next != kNone)
        own.linear =
            turnAndStretch(centreOf(next) - own.centre, targetOf(next) - own.target, out_.radiusFactor);
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
        const float along = record.station().along, share = along <= 1 ? along : along - 1;
        limb = glm::mix(before(record.joint, p), starts ? after(record.joint, p) : limb, share);
        mean += float(record.share) / float(kWholeShare) * limb;
        starts = record.share != 0;
        left -= record.share;
      }
      point = vec4(mean, point.w);
    }
  }

  void warpToSkin() {
    TriangleMesh target = skinAtRest(to_);
    if (skin_.empty() || target.empty()) return;
    shell_ = std::make_unique<SkinShell>(std::move(target));
    for (std::size_t v = 0; v < skin_.positions.size(); ++v)
      skin_.positions[v] = vec3(points_[network_.points().size() + v]);
    SkinWarp(skin_, *shell_).run(std::span(points_).first(network_.points().size()));
  }

  // Points outside the skin, or nearer to it than their radius and than they were, are moved in; their
  // neighbours come along.
  void pushInside() {
    if (!shell_) return;
    constexpr int kRoundsInside = 3;
    constexpr float kSkinThickness = 0.0012f;  // of the body's height
    const float thickness = kSkinThickness * to_.height();
    const SkinShell before(skinAtRest(from_));
    std::vector<float> wanted(out_.points.size());
    parallelFor(wanted.size(), 32, [&](std::size_t i) {
      const float was = out_.radiusFactor * before.look(vec3(network_.points()[i])).depth;
      wanted[i] = std::min(std::min(out_.points[i].w, 4 * thickness) + thickness, was);
    });
    for (int round = 0; round < kRoundsInside; ++round) {
      std::vector<vec3> moves(out_.points.size(), vec3(0));
      parallelFor(moves.size(), 32, [&](std::size_t i) {
        const vec4& p = out_.points[i];
        const auto place = shell_->look(vec3(p));
        if (place.depth < wanted[i] - 1e-5f) moves[i] = place.nearest - wanted[i] * place.normal - vec3(p);
      });
      if (round == 0)
        out_.pushedIn =
            std::uint32_t(std::ranges::count_if(moves, [](const vec3& m) { return m != vec3(0); }));
      spreadAlongVessels(moves);
      for (std::size_t i = 0; i < moves.size(); ++i) out_.points[i] += vec4(moves[i], 0);
    }
  }

  // A neighbour moves half as far, its neighbour a quarter: no kinks.
  void spreadAlongVessels(std::vector<vec3>& moves) const {
    for (const Vessel& vessel : network_.vessels()) {
      const auto own = Network::pointsOf(vessel, std::span(moves));
      const auto follow = [&](std::size_t i, std::size_t before) {
        const vec3 half = 0.5f * own[before];
        if (glm::dot(half, half) > glm::dot(own[i], own[i])) own[i] = half;
      };
      for (std::size_t i = 1; i < own.size(); ++i) follow(i, i - 1);
      for (std::size_t i = own.size() - 1; i-- > 0;) follow(i, i + 1);
    }
  }

  const Network& network_;
  const Body &from_, &to_;
  std::string name_;
  std::vector<std::uint32_t> match_;  // of each joint of the first body
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
  SkinReport report;
  TriangleMesh skin = skinAtRest(body);
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
