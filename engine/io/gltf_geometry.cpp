#include "io/gltf_geometry.h"

#include <algorithm>
#include <cmath>

#include "core/cancellation.h"
#include "core/ids.h"
#include "io/gltf_accessor.h"

namespace vasa::gltf {
namespace {

constexpr float kWeightTolerance =
    1e-3f;  // 8-bit weights round by up to 4 * 0.5 / 255 before they are mended

std::vector<vec3> readVectors(const Asset& asset, int accessor) {
  const auto values = readFloats(asset, accessor);
  std::vector<vec3> out(values.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return out;
}

std::vector<uvec3> trianglesOf(const std::vector<std::uint32_t>& corners, int mode) {
  std::vector<uvec3> out;
  if (corners.size() < 3) return out;
  if (mode == kTriangles) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      out.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
    return out;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    uvec3 triangle;
    if (mode == kTriangleFan)
      triangle = {corners[i + 1], corners[i + 2], corners[0]};
    else
      triangle = {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]};  // every second one is turned
    const bool stitch = triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x;
    if (!stitch) out.push_back(triangle);
  }
  return out;
}

// The strongest four of all sets, the same joint counted once.
struct Gathered {
  std::vector<std::pair<std::uint32_t, float>> parts;
  void add(std::uint32_t joint, float weight) {
    for (auto& [known, sum] : parts)
      if (known == joint) {
        sum += weight;
        return;
      }
    parts.emplace_back(joint, weight);
  }
  Geometry::Influence strongest() {
    std::stable_sort(parts.begin(), parts.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    Geometry::Influence influence;
    float sum = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(parts.size(), 4); ++i) sum += parts[i].second;
    for (std::size_t i = 0; i < std::min<std::size_t>(parts.size(), 4); ++i) {
      influence.weights[int(i)] = sum > 0 ? parts[i].second / sum : (i == 0 ? 1.0f : 0.0f);
      influence.joints[i] = influence.weights[int(i)] > 0 ? parts[i].first : 0;
    }
    return influence;
  }
};

void readInfluences(const Asset& asset, const Model::Primitive& primitive, std::size_t vertices,
                    Geometry& geometry) {
  std::vector<std::vector<std::uint32_t>> joints;
  std::vector<std::vector<float>> weights;
  for (const int accessor : primitive.joints) joints.push_back(readIntegers(asset, accessor));
  for (const int accessor : primitive.weights) weights.push_back(readFloats(asset, accessor));
  Gathered gathered;
  Checkpoints checkpoints;
  for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
    checkpoints.pass();
    gathered.parts.clear();
    float sum = 0;
    for (std::size_t set = 0; set < joints.size(); ++set)
      for (std::size_t i = 4 * vertex; i < 4 * vertex + 4; ++i) {
        gathered.add(joints[set][i], weights[set][i]);
        sum += weights[set][i];
      }
    if (!(std::abs(sum - 1) <= kWeightTolerance * float(4 * joints.size()))) ++geometry.mendedWeights;
    geometry.influences.push_back(gathered.strongest());
  }
}

std::vector<std::uint32_t> cornersOf(const Asset& asset, const Model::Primitive& primitive,
                                     std::size_t vertices) {
  if (primitive.indices >= 0) return readIntegers(asset, primitive.indices);
  std::vector<std::uint32_t> corners(vertices);
  for (std::size_t i = 0; i < vertices; ++i) corners[i] = std::uint32_t(i);
  return corners;
}

std::vector<vec3> normalsOf(const Asset& asset, const Model::Primitive& primitive, const TriangleMesh& mesh) {
  const int accessor = primitive.normal;
  std::vector<vec3> computed = vertexNormals(mesh);
  if (accessor < 0) return computed;
  std::vector<vec3> normals = readVectors(asset, accessor);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float length = glm::length(normals[i]);
    normals[i] = length > 1e-6f && std::isfinite(length) ? normals[i] / length : computed[i];
  }
  return normals;
}

// As the morph targets leave them.
std::vector<vec3> positionsOf(const Asset& asset, const Model::Primitive& primitive,
                              std::span<const float> weights) {
  std::vector<vec3> positions = readVectors(asset, primitive.position);
  for (std::size_t k = 0; k < std::min(weights.size(), primitive.targets.size()); ++k) {
    if (weights[k] == 0 || primitive.targets[k] < 0) continue;
    const std::vector<vec3> displacements = readVectors(asset, primitive.targets[k]);
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += weights[k] * displacements[v];
  }
  return positions;
}

void readVessels(const Asset& asset, const Model::Primitive& primitive, Geometry& geometry) {
  const std::size_t vertices = geometry.mesh.positions.size();
  if (primitive.vessel >= 0) {
    const Model::Accessor& accessor = asset.model.accessors[std::size_t(primitive.vessel)];
    if (accessor.type == "SCALAR" && !isFloatComponent(accessor.componentType)) {
      const std::vector<std::uint32_t> numbers = readIntegers(asset, primitive.vessel);
      geometry.vessels.insert(geometry.vessels.end(), numbers.begin(), numbers.end());
    }
  }
  geometry.vessels.resize(vertices, kNone);
}

}  // namespace

void appendPrimitive(const Asset& asset, const Model::Primitive& primitive, std::span<const float> weights,
                     bool skinned, Geometry& geometry) {
  const int position = primitive.position;
  if (position < 0 || primitive.mode < kTriangles) return;
  const std::size_t vertices = asset.model.accessors[std::size_t(position)].count;
  const TriangleMesh mesh{positionsOf(asset, primitive, weights),
                          trianglesOf(cornersOf(asset, primitive, vertices), primitive.mode)};
  const auto normals = normalsOf(asset, primitive, mesh);
  const auto base = std::uint32_t(geometry.mesh.positions.size());
  geometry.mesh.positions.insert(geometry.mesh.positions.end(), mesh.positions.begin(), mesh.positions.end());
  geometry.normals.insert(geometry.normals.end(), normals.begin(), normals.end());
  for (const uvec3& triangle : mesh.triangles) geometry.mesh.triangles.push_back(triangle + base);
  readVessels(asset, primitive, geometry);
  if (skinned) readInfluences(asset, primitive, vertices, geometry);
}

void transform(Geometry& geometry, const mat4& by) {
  if (by == mat4(1)) return;  // so that untouched data stays bit for bit
  const mat3 linear(by);
  const float determinant = glm::determinant(linear);
  for (vec3& p : geometry.mesh.positions) p = vec3(by * vec4(p, 1));
  if (determinant != 0) {
    const mat3 forNormals = glm::transpose(glm::inverse(linear));
    for (vec3& n : geometry.normals) {
      const vec3 moved = forNormals * n;
      const float length = glm::length(moved);
      if (length > 0 && std::isfinite(length)) n = moved / length;
    }
  }
  if (determinant < 0)
    for (uvec3& triangle : geometry.mesh.triangles) std::swap(triangle.y, triangle.z);
}

}  // namespace vasa::gltf
