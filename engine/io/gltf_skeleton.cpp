#include "io/gltf_skeleton.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/gltf_accessor.h"
#include "io/gltf_binding.h"
#include "io/gltf_rule.h"

namespace vasa::gltf {
namespace {

float size(const mat4& m) { return difference(m, mat4(0)); }

bool invertible(const mat4& m) {
  const float determinant = std::abs(glm::determinant(mat3(m)));
  return std::isfinite(determinant) && determinant > 1e-12f;
}

std::vector<bool> animatedNodes(const Model& model) {
  std::vector<bool> animated(model.nodes.size());
  for (const auto& animation : model.animations)
    for (const auto& channel : animation.channels)
      if (channel.node >= 0 && channel.path != Model::Path::other) animated[std::size_t(channel.node)] = true;
  return animated;
}

// Where nothing is skinned, rigid pieces hang on one another: a node is a joint unless it only holds a mesh
// at its parent's place.
bool turnsOnItsOwn(const Model::Node& node) {
  return !node.children.empty() || !node.matrix.empty() || node.transform.translation != vec3(0);
}

class Members {
 public:
  Members(const Model& model, const NodeTree& tree) : tree_(tree), is_(model.nodes.size()) {
    for (const auto& skin : model.skins)
      for (const int joint : skin.joints) is_[std::size_t(joint)] = true;
    const auto animated = animatedNodes(model);
    // Children before parents: whether something that counts lies below.
    std::vector<bool> carries(is_.size());
    for (auto it = tree.order.rbegin(); it != tree.order.rend(); ++it) {
      const auto i = std::size_t(*it);
      const auto& node = model.nodes[i];
      if (is_[i] || (node.mesh >= 0 && node.skin < 0)) carries[i] = true;
      if (carries[i] && (animated[i] || (model.skins.empty() && turnsOnItsOwn(node)))) is_[i] = true;
      if (carries[i] && tree.parent[i] >= 0) carries[std::size_t(tree.parent[i])] = true;
    }
    fillGaps();
    if (!rootsAgree()) addAllAncestors();
  }
  bool has(int node) const { return is_[std::size_t(node)]; }
  /// Of the nodes above all root joints.
  mat4 above() const {
    for (const int node : tree_.order)
      if (has(node)) return worldAbove(node);
    return tree_.space;
  }

 private:
  bool isRoot(int node) const {
    return has(node) && (tree_.parent[std::size_t(node)] < 0 || !has(tree_.parent[std::size_t(node)]));
  }
  mat4 worldAbove(int node) const {
    const int parent = tree_.parent[std::size_t(node)];
    return parent < 0 ? tree_.space : tree_.world[std::size_t(parent)];
  }
  void fillGaps() {
    // For each node, whether a joint lies above it and below it.
    std::vector<bool> above(is_.size()), below(is_.size());
    for (const int node : tree_.order) {
      const int parent = tree_.parent[std::size_t(node)];
      if (parent >= 0) above[std::size_t(node)] = above[std::size_t(parent)] || has(parent);
    }
    for (auto it = tree_.order.rbegin(); it != tree_.order.rend(); ++it) {
      const int parent = tree_.parent[std::size_t(*it)];
      if (parent >= 0 && (has(*it) || below[std::size_t(*it)])) below[std::size_t(parent)] = true;
    }
    for (std::size_t i = 0; i < is_.size(); ++i)
      if (above[i] && below[i]) is_[i] = true;
  }
  bool rootsAgree() const {
    const mat4 first = above();
    for (const int node : tree_.order)
      if (isRoot(node) && difference(worldAbove(node), first) > 1e-6f * std::max(1.0f, size(first)))
        return false;
    return true;
  }
  void addAllAncestors() {
    for (auto it = tree_.order.rbegin(); it != tree_.order.rend(); ++it)
      if (has(*it) && tree_.parent[std::size_t(*it)] >= 0)
        is_[std::size_t(tree_.parent[std::size_t(*it)])] = true;
  }
  const NodeTree& tree_;
  std::vector<bool> is_;
};

// T R S of a matrix without shear; columns of the linear part are the scaled axes.
JointTransform decompose(const mat4& m, const std::string& place) {
  JointTransform out;
  out.translation = vec3(m[3]);
  mat3 axes(m);
  for (int i = 0; i < 3; ++i) out.scale[i] = glm::length(axes[i]);
  if (glm::determinant(axes) < 0) out.scale.x = -out.scale.x;
  for (int i = 0; i < 3; ++i) axes[i] = out.scale[i] != 0 ? axes[i] / out.scale[i] : vec3(0);
  out.rotation = glm::normalize(glm::quat_cast(axes));
  if (!(difference(out.matrix(), m) <= 1e-4f * std::max(1.0f, size(m))))
    breaks(place, "the matrix of a joint must be a translation, a rotation and a scale, without shear",
           "export joints with translation, rotation and scale");
  return out;
}

JointTransform restOf(const Model::Node& node, const mat4& local, int index) {
  if (!node.matrix.empty()) return decompose(local, "/nodes/" + std::to_string(index) + "/matrix");
  return node.transform;
}

std::vector<mat4> inverseBinds(const Asset& asset, const Model::Skin& skin) {
  std::vector<mat4> out(skin.joints.size(), mat4(1));
  if (skin.inverseBindMatrices < 0) return out;
  const auto values = readFloats(asset, skin.inverseBindMatrices, skin.joints.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    for (int k = 0; k < 16; ++k) out[i][k / 4][k % 4] = values[16 * i + std::size_t(k)];
  return out;
}

// One a skin: whether a mesh that it moves has integers for positions.
std::vector<bool> packedSkins(const Model& model) {
  std::vector<bool> packed(model.skins.size());
  for (const auto& node : model.nodes) {
    if (node.skin < 0 || node.mesh < 0) continue;
    for (const auto& primitive : model.meshes[std::size_t(node.mesh)].primitives)
      if (primitive.position >= 0 &&
          !isFloatComponent(model.accessors[std::size_t(primitive.position)].componentType))
        packed[std::size_t(node.skin)] = true;
  }
  return packed;
}

// Influences number joints in 16 bits.
void checkJointCount(std::size_t count) {
  if (count > 65535) breaks("/skins", "need more than 65535 joints", "use fewer joints");
}

constexpr float kSameBinding = 1e-4f;  // of the skeleton's size: exporters write matrices with rounding

class Binder {
 public:
  explicit Binder(Skeleton& skeleton) : skeleton_(skeleton), bound_(skeleton.joints.size()) {}

  BodySkeleton::Skin bind(std::vector<JointId> joints, const std::vector<mat4>& matrices) {
    BodySkeleton::Skin skin{std::move(joints), mat4(1)};
    if (const auto shared = restIsBinding(skin.joints, matrices)) {
      skin.bake = *shared;
      for (JointId& joint : skin.joints) claim(joint, glm::inverse(at(joint).restWorld));
      return skin;
    }
    for (std::size_t i = 0; i < skin.joints.size(); ++i) claim(skin.joints[i], matrices[i]);
    return skin;
  }

  /// Joints that no skin binds carry meshes rigidly.
  void bindTheRest() {
    for (std::size_t i = 0; i < bound_.size(); ++i)
      if (!bound_[i] && invertible(skeleton_.joints[i].restWorld))
        skeleton_.joints[i].inverseBind = glm::inverse(skeleton_.joints[i].restWorld);
  }

 private:
  Skeleton::Joint& at(JointId id) { return skeleton_.joints[id.value]; }

  std::optional<mat4> restIsBinding(const std::vector<JointId>& joints, const std::vector<mat4>& matrices) {
    float extent = 0;
    for (const JointId joint : joints) {
      if (!invertible(at(joint).restWorld)) return std::nullopt;
      extent = std::max(extent, size(at(joint).restWorld));
    }
    const mat4 first = at(joints[0]).restWorld * matrices[0];
    if (!invertible(first)) return std::nullopt;
    for (std::size_t i = 1; i < joints.size(); ++i)
      if (!(difference(at(joints[i]).restWorld * matrices[i], first) <= kSameBinding * extent))
        return std::nullopt;
    // A transform that is only rounding must not disturb the file's own coordinates.
    return difference(first, mat4(1)) <= kSameBinding * extent ? mat4(1) : first;
  }

  // Gives the joint this matrix; where another skin has given it a different one, the joint becomes its
  // double.
  void claim(JointId& joint, const mat4& matrix) {
    if (bound_[joint.value] && difference(at(joint).inverseBind, matrix) > kSameBinding * size(matrix)) {
      joint = doubled(joint, matrix);
      return;
    }
    if (!bound_[joint.value]) at(joint).inverseBind = matrix;
    bound_[joint.value] = true;
  }

  JointId doubled(JointId joint, const mat4& matrix) {
    Skeleton::Joint twin = at(joint);
    twin.name += " (second binding)";
    twin.parent = joint;
    twin.rest = {};
    twin.inverseBind = matrix;
    checkJointCount(skeleton_.joints.size() + 1);
    skeleton_.joints.push_back(twin);  // after its parent, as the order demands
    bound_.push_back(true);
    return {std::uint32_t(skeleton_.joints.size() - 1)};
  }

  Skeleton& skeleton_;
  std::vector<bool> bound_;
};

}  // namespace

BodySkeleton buildSkeleton(const Asset& asset, const NodeTree& tree) {
  const auto& model = asset.model;
  const Members members(model, tree);
  BodySkeleton out;
  Skeleton& skeleton = out.skeleton;
  skeleton.rootTransform = members.above();
  out.jointOfNode.resize(model.nodes.size());
  for (const int node : tree.order) {
    if (!members.has(node)) continue;
    const auto i = std::size_t(node);
    Skeleton::Joint joint;
    joint.name = model.nodes[i].name.empty() ? "node " + std::to_string(node) : model.nodes[i].name;
    // Its table says what a joint is, whatever it is called.
    if (const auto bone = model.humanoid.find(node); bone != model.humanoid.end()) joint.name = bone->second;
    if (tree.parent[i] >= 0) joint.parent = out.jointOfNode[std::size_t(tree.parent[i])];
    joint.rest = restOf(model.nodes[i], tree.local[i], node);
    const vec3 scale = glm::abs(joint.rest.scale);
    if (!(std::min({scale.x, scale.y, scale.z}) > 0))
      breaks("/nodes/" + std::to_string(node),
             "the joint's scale is 0 at rest, which flattens all that it moves",
             "give it a scale other than 0");
    joint.restWorld =
        (joint.parent.valid() ? skeleton.joints[joint.parent.value].restWorld : skeleton.rootTransform) *
        joint.rest.matrix();
    out.jointOfNode[i] = {std::uint32_t(skeleton.joints.size())};
    skeleton.joints.push_back(std::move(joint));
  }
  checkJointCount(skeleton.joints.size());
  const std::vector<bool> packed = packedSkins(model);
  std::vector<BoundSkin> bound;
  for (const auto& skin : model.skins) {
    bound.push_back({{}, inverseBinds(asset, skin), packed[bound.size()]});
    for (const int node : skin.joints) bound.back().joints.push_back(out.jointOfNode[std::size_t(node)]);
  }
  const Skeleton asFile = skeleton;
  if (restAtBinding(skeleton, bound)) {
    out.packedAndPosed = largestSkin(bound)->packed;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      const mat4& before = asFile.joints[j].restWorld;
      out.fileRest.push_back(asFile.joints[j].rest);
      out.fileToRest.push_back(invertible(before) ? skeleton.joints[j].restWorld * glm::inverse(before)
                                                  : mat4(1));
    }
  }
  Binder binder(skeleton);
  for (BoundSkin& skin : bound) out.skins.push_back(binder.bind(std::move(skin.joints), skin.inverseBinds));
  binder.bindTheRest();
  return out;
}

}  // namespace vasa::gltf
