#include "body/bone_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "body/mesh_role.h"
#include "body/point_tree.h"
#include "math/aabb.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr std::size_t kNearestPlaces = 6;
constexpr float kRigidWeight = 0.99f;  // of a vertex
constexpr float kRigidShare = 0.95f;   // of a mesh's vertices
constexpr float kReachHeights = 0.2f;  // distances beyond this part of the body's height need not be exact
constexpr float kTipShare = 0.6f;      // length of a tip's link against the one before it
// Of the links' length must have rigid vertices: else they are eyes, shoes, a hat.
constexpr float kBonesShare = 0.5f;

constexpr double kStrayWeight = 1e-3;  // of all weights: a vertex or two that were left on the root

using Links = std::vector<std::pair<vec3, vec3>>;

/// The links that each joint moves.
std::vector<Links> linksOf(const SpineSet& spines) {
  std::vector<Links> links(spines.joints.size());
  for (std::size_t i = 0; i < spines.joints.size(); ++i) {
    const SpineJoint& joint = spines.joints[i];
    if (!joint.parent.valid()) continue;
    const vec3 before = spines.joints[joint.parent.value].centre;
    if (joint.centre != before) links[joint.parent.value].emplace_back(before, joint.centre);
    if (!joint.next.valid())
      links[i].emplace_back(joint.centre, joint.centre + kTipShare * (joint.centre - before));
  }
  return links;
}

/// Joints above all that any mesh follows: a root on the floor, an armature's own node. Their links run
/// through the body, but are no part of it: what hung on them would stay where it is while the body squats.
std::vector<bool> aboveBody(const Body& body) {
  std::vector<double> weight(body.skeleton.joints.size(), 0.0);
  double whole = 0;
  for (const SkinnedMesh& mesh : body.meshes)
    for (const SkinInfluence& influence : mesh.influences)
      for (int k = 0; k < 4; ++k)
        weight[body.carrier(influence.joints[std::size_t(k)])] += double(influence.weights[k]),
            whole += double(influence.weights[k]);
  std::vector<bool> above(weight.size(), false);
  for (std::size_t j = 0; j < above.size() && whole > 0; ++j) {
    const JointId parent = body.skeleton.joints[j].parent;
    above[j] = weight[j] <= kStrayWeight * whole && (!parent.valid() || above[parent.value]);
  }
  return above;
}

float distanceToLinks(const Links& links, vec3 p) {
  float nearest = BoneField::kFar;
  for (const auto& [from, to] : links)
    nearest = std::min(nearest, glm::distance(p, glm::mix(from, to, closestOnSegment(p, from, to))));
  return nearest;
}

float lengthOf(const Links& links) {
  float length = 0;
  for (const auto& [from, to] : links) length += glm::distance(from, to);
  return length;
}

/// Whether rigid vertices, listed by joint, stand for the skeleton's bones. A few parts of it that move
/// rigidly would otherwise be the nearest "bones" of the whole body, and everything would hang on them.
bool standForBones(const std::vector<std::vector<vec3>>& points, const std::vector<Links>& links) {
  float covered = 0, whole = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const float length = lengthOf(links[i]);
    whole += length;
    if (!points[i].empty()) covered += length;
  }
  return covered >= kBonesShare * whole;
}

}  // namespace

struct BoneField::Part {
  Links links;
  std::unique_ptr<PointCloud> cloud;
  std::unique_ptr<PointTree> tree;
  Aabb box;
};

std::uint32_t soleCarrier(const SkinInfluence& influence) {
  const std::size_t k = influence.heaviest();
  return influence.weights[int(k)] >= kRigidWeight ? influence.joints[k] : kNone;
}

bool movesByRigidParts(const SkinnedMesh& mesh) {
  std::size_t rigid = 0;
  for (const SkinInfluence& influence : mesh.influences) rigid += soleCarrier(influence) != kNone;
  return rigid > 0 && float(rigid) >= kRigidShare * float(mesh.influences.size());
}

BoneField::BoneField(const Body& body, const SpineSet& spines) : parts_(spines.joints.size()) {
  std::vector<std::vector<vec3>> points(spines.joints.size());
  Aabb bounds;
  for (const SpineJoint& joint : spines.joints) bounds.add(joint.centre);
  for (const SkinnedMesh& mesh : body.meshes) {
    if (!movesByRigidParts(mesh) || !isSolid(mesh)) continue;
    fromMeshes_ = true;
    for (std::size_t v = 0; v < mesh.influences.size(); ++v)
      if (const std::uint32_t carrier = soleCarrier(mesh.influences[v]); carrier != kNone)
        points[body.carrier(carrier)].push_back(mesh.mesh.positions[v]);
  }
  std::vector<Links> links = linksOf(spines);
  fromMeshes_ = fromMeshes_ && standForBones(points, links);
  if (!fromMeshes_) {
    for (auto& list : points) list.clear();
    const std::vector<bool> above = aboveBody(body);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (!above[i]) parts_[i].links = std::move(links[i]);
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (points[i].empty()) continue;
    Part& part = parts_[i];
    for (vec3 p : points[i]) part.box.add(p), bounds.add(p);
    part.cloud = std::make_unique<PointCloud>(PointCloud{std::move(points[i])});
    part.tree = std::make_unique<PointTree>(3, *part.cloud);
    part.tree->buildIndex();
  }
  reach_ = kReachHeights * bounds.size();
}

BoneField::~BoneField() = default;

void BoneField::distances(vec3 p, std::span<float> distances) const {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    distances[i] = distanceToLinks(part.links, p);
    if (!part.tree) continue;
    const float toBox = glm::distance(p, glm::clamp(p, part.box.low, part.box.high));
    distances[i] = toBox;
    if (toBox > reach_) continue;
    std::array<std::uint32_t, kNearestPlaces> index{};
    std::array<float, kNearestPlaces> squared{};
    const std::size_t found = part.tree->knnSearch(&p.x, kNearestPlaces, index.data(), squared.data());
    float sum = 0;
    for (std::size_t k = 0; k < found; ++k) sum += 1 / std::max(squared[k] * squared[k], 1e-20f);
    distances[i] = std::pow(float(found) / sum, 0.25f);
  }
}

}  // namespace vasa
