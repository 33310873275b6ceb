#include "body/skin_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "body/bone_field.h"
#include "body/mesh_role.h"
#include "body/point_tree.h"

namespace vasa {
namespace {

constexpr std::size_t kNearestVertices = 48;
constexpr float kFacingWay = 0.25f;   // smallest cosine between the way to a vertex and its normal
constexpr float kFieldBlur = 0.006f;  // of the body's height, added to distances before vertices are weighed

}  // namespace

struct SkinField::Vertices {
  explicit Vertices(const SkinnedMesh& skin, float blurLength)
      : cloud{skin.mesh.positions},
        tree(3, cloud),
        normals(vertexNormals(skin.mesh)),
        influences(skin.influences),
        blur(blurLength) {
    tree.buildIndex();
    for (const SkinInfluence& influence : influences)
      for (int i = 0; i < 4; ++i) {
        if (!(influence.weights[i] > 0)) continue;
        const std::size_t joint = influence.joints[std::size_t(i)];
        if (joint >= followed.size()) followed.resize(joint + 1);
        followed[joint] = true;
      }
  }

  PointCloud cloud;
  PointTree tree;
  std::vector<vec3> normals;
  std::vector<SkinInfluence> influences;
  std::vector<bool> followed;
  float blur;
};

const SkinnedMesh* skinOf(const Body& body) {
  const SkinnedMesh* skin = nullptr;
  std::pair<bool, float> largest{false, 0.0f};  // named before others, then by size
  for (const SkinnedMesh& mesh : body.meshes) {
    if (mesh.mesh.empty()) continue;
    const vec3 extent = mesh.mesh.bounds().extent();
    const MeshRole role = roleNamed(mesh.name);
    const std::pair own(role == MeshRole::skin, extent.x * extent.y * extent.z);
    // With one joint everything is rigid.
    const bool couldBend =
        body.skeleton.joints.size() > 1 || (role != MeshRole::skin && role != MeshRole::other);
    const bool rigid = couldBend && movesByRigidParts(mesh);
    if (!(own > largest) || (rigid && !mesh.name.starts_with("skin:"))) continue;
    largest = own;
    skin = &mesh;
  }
  return skin;
}

SkinField::SkinField(const Body& body) {
  const SkinnedMesh* skin = skinOf(body);
  if (skin && skin->influences.size() == skin->mesh.positions.size())
    vertices_ = std::make_unique<Vertices>(*skin, kFieldBlur * body.height());
}

SkinField::~SkinField() = default;

bool SkinField::follows(JointId joint) const {
  return vertices_ && joint.value < vertices_->followed.size() && vertices_->followed[joint.value];
}

float SkinField::shares(const SpineSet& spines, vec3 p, std::span<float> shares) const {
  std::fill(shares.begin(), shares.end(), 0.0f);
  if (!vertices_) return BoneField::kFar;
  std::array<std::uint32_t, kNearestVertices> index{};
  std::array<float, kNearestVertices> squared{};
  const std::size_t found = vertices_->tree.knnSearch(&p.x, kNearestVertices, index.data(), squared.data());
  float sum = 0, nearest = BoneField::kFar;
  for (std::size_t k = 0; k < found; ++k) {
    const float distance = std::sqrt(squared[k]);
    const vec3 way = vertices_->cloud.points[index[k]] - p;
    const float facing = distance > vertices_->blur
                             ? glm::dot(way, vertices_->normals[index[k]]) / distance - kFacingWay
                             : 1 - kFacingWay;
    if (facing <= 0) continue;
    const float far = distance + vertices_->blur, weight = facing / (far * far * far);
    const SkinInfluence& influence = vertices_->influences[index[k]];
    for (int i = 0; i < 4; ++i) shares[influence.joints[std::size_t(i)]] += weight * influence.weights[i];
    sum += weight;
    nearest = std::min(nearest, distance);
  }
  if (!(sum > 0)) return BoneField::kFar;
  for (float& share : shares) share /= sum;
  for (std::size_t j = shares.size(); j-- > 0;)
    if (const JointId parent = spines.joints[j].parent; parent.valid()) shares[parent.value] += shares[j];
  return nearest;
}

}  // namespace vasa
