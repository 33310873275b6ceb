#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/gltf_accessor.h"
#include "io/gltf_check.h"
#include "io/gltf_rule.h"
#include "math/types.h"

namespace vasa::gltf {
namespace {

std::string accessorPlace(int accessor) { return "/accessors/" + std::to_string(accessor); }

std::string element(std::size_t component, const ElementLayout& layout) {
  return "element " + std::to_string(component / layout.components());
}

void checkSparseOrder(const Asset& asset, int index) {
  const auto places = readSparseIndices(asset, index);
  const std::size_t count = asset.model.accessors[std::size_t(index)].count;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] >= count)
      breaks(accessorPlace(index) + "/sparse/indices",
             "refers to element " + std::to_string(places[i]) + " of " + std::to_string(count), kExportAgain);
    if (i > 0 && places[i] <= places[i - 1])
      breaks(accessorPlace(index) + "/sparse/indices",
             "must increase strictly, do not at " + std::to_string(i), kExportAgain);
  }
}

// Exporters round the bounds they write; only what is clearly outside tells of damage.
void checkBound(const Model::Accessor& accessor, int index, const std::vector<float>& values,
                bool isMinimum) {
  const auto& bounds = isMinimum ? accessor.least : accessor.most;
  if (bounds.empty()) return;
  const ElementLayout layout = elementLayout(accessor);
  if (accessor.normalised) return;  // bounds are of the stored integers, values are mapped already
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double bound = bounds[i % layout.components()];
    const double tolerance = 1e-3 + 1e-4 * std::abs(bound);
    const double outside = isMinimum ? bound - double(values[i]) : double(values[i]) - bound;
    if (outside > tolerance)
      breaks(accessorPlace(index) + (isMinimum ? "/min" : "/max"),
             element(i, layout) + " is " + std::to_string(values[i]) + ", outside the bound " +
                 std::to_string(bound),
             kExportAgain);
  }
}

void checkValues(const Asset& asset, int index) {
  const auto& accessor = asset.model.accessors[std::size_t(index)];
  const bool isFloat = isFloatComponent(accessor.componentType);
  if (!isStored(asset, index)) return;
  if (!isFloat && accessor.least.empty() && accessor.most.empty()) return;
  const auto values = readFloats(asset, index);
  const auto bad = std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
  if (bad != values.end())
    breaks(accessorPlace(index),
           element(std::size_t(bad - values.begin()), elementLayout(accessor)) + " is not a finite number",
           kExportAgain);
  checkBound(accessor, index, values, true);
  checkBound(accessor, index, values, false);
}

// The largest value of each accessor of integers, found once: many meshes may share one.
class Largest {
 public:
  explicit Largest(const Asset& asset) : asset_(asset) {}
  struct Place {
    std::uint32_t value = 0;
    std::size_t component = 0;
  };
  const Place& of(int accessor) {
    const auto [it, isNew] = known_.try_emplace(accessor);
    if (isNew) {
      const auto values = readIntegers(asset_, accessor);
      const auto largest = std::max_element(values.begin(), values.end());
      it->second = {*largest, std::size_t(largest - values.begin())};
    }
    return it->second;
  }

 private:
  const Asset& asset_;
  std::map<int, Place> known_;
};

void checkIndices(const Asset& asset, const Model::Primitive& primitive, const std::string& place,
                  Largest& largest) {
  if (primitive.indices < 0 || !hasData(asset, primitive.indices)) return;
  const std::size_t vertices = primitive.vertices;
  const auto& [value, component] = largest.of(primitive.indices);
  const auto bits = 8 * componentBytes(asset.model.accessors[std::size_t(primitive.indices)].componentType);
  if (value == 0xffffffffu >> (32 - bits))
    breaks(accessorPlace(primitive.indices),
           "index " + std::to_string(component) + " is " + std::to_string(value) +
               ", which asks drivers to begin a new strip",
           kExportAgain);
  if (value >= vertices)
    breaks(accessorPlace(primitive.indices),
           "index " + std::to_string(component) + " is " + std::to_string(value) + ", but " + place +
               " has " + std::to_string(vertices) + " vertices",
           kExportAgain);
}

void checkWeights(const Asset& asset, int accessor) {
  if (!hasData(asset, accessor)) return;
  const auto weights = readFloats(asset, accessor);
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] < 0)
      breaks(accessorPlace(accessor), "a weight of vertex " + std::to_string(i / 4) + " is negative",
             kExportAgain);
}

// The largest joint that a mesh is bound to, and where it says so.
struct LargestJoint {
  int accessor = -1;
  Largest::Place place;
};

LargestJoint largestJoint(const Asset& asset, const Model::Mesh& mesh, Largest& largest) {
  LargestJoint result;
  for (const auto& primitive : mesh.primitives)
    for (const int accessor : primitive.joints) {
      if (!hasData(asset, accessor)) continue;
      const auto& place = largest.of(accessor);
      if (result.accessor < 0 || place.value > result.place.value) result = {accessor, place};
    }
  return result;
}

void checkJoints(const Asset& asset, Largest& largest) {
  std::vector<LargestJoint> ofMesh;
  for (const auto& mesh : asset.model.meshes) ofMesh.push_back(largestJoint(asset, mesh, largest));
  for (const auto& node : asset.model.nodes) {
    if (node.skin < 0) continue;
    const auto& [accessor, place] = ofMesh[std::size_t(node.mesh)];
    const std::size_t joints = asset.model.skins[std::size_t(node.skin)].joints.size();
    if (accessor >= 0 && place.value >= joints)
      breaks(accessorPlace(accessor),
             "vertex " + std::to_string(place.component / 4) + " is bound to joint " +
                 std::to_string(place.value) + ", but /skins/" + std::to_string(node.skin) + " has " +
                 std::to_string(joints),
             kExportAgain);
  }
}

void checkMeshData(const Asset& asset) {
  Largest largest(asset);
  std::set<int> weights;
  for (std::size_t mesh = 0; mesh < asset.model.meshes.size(); ++mesh)
    for (std::size_t i = 0; i < asset.model.meshes[mesh].primitives.size(); ++i) {
      const auto& primitive = asset.model.meshes[mesh].primitives[i];
      checkIndices(asset, primitive, "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(i),
                   largest);
      weights.insert(primitive.weights.begin(), primitive.weights.end());
    }
  for (const int accessor : weights) checkWeights(asset, accessor);
  checkJoints(asset, largest);
}

// Whether the linear part of an affine matrix has no inverse, whatever its scale.
bool isFlat(const float* m) {
  const dvec3 x(m[0], m[1], m[2]), y(m[4], m[5], m[6]), z(m[8], m[9], m[10]);
  return std::abs(glm::dot(x, glm::cross(y, z))) <= 1e-6 * glm::length(x) * glm::length(y) * glm::length(z);
}

void checkInverseBinds(const Asset& asset) {
  for (std::size_t i = 0; i < asset.model.skins.size(); ++i) {
    const auto& skin = asset.model.skins[i];
    if (skin.inverseBindMatrices < 0 || !hasData(asset, skin.inverseBindMatrices)) continue;
    const auto values = readFloats(asset, skin.inverseBindMatrices, skin.joints.size());
    for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
      const float* m = &values[16 * joint];
      const auto off = [](float value, float wanted) { return std::abs(value - wanted) > 1e-5f; };
      if (off(m[3], 0) || off(m[7], 0) || off(m[11], 0) || off(m[15], 1))
        breaks(accessorPlace(skin.inverseBindMatrices),
               "matrix " + std::to_string(joint) + " must be affine: the last row must be 0 0 0 1",
               kExportAgain);
      if (isFlat(m))
        breaks(accessorPlace(skin.inverseBindMatrices),
               "matrix " + std::to_string(joint) + " flattens what it carries and cannot be undone",
               kExportAgain);
    }
  }
}

// Animations may be described without data. Reading one then fails, see gltf_clips.cpp.
bool hasOwnData(const Asset& asset, int accessor) {
  return isStored(asset, accessor) && hasData(asset, accessor);
}

void checkTimes(const Asset& asset, int accessor) {
  if (!hasOwnData(asset, accessor)) return;
  const auto times = readFloats(asset, accessor);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < 0)
      breaks(accessorPlace(accessor), "key time " + std::to_string(i) + " is negative", kExportAgain);
    if (i > 0 && times[i] <= times[i - 1])
      breaks(accessorPlace(accessor), "key times must increase strictly, do not at key " + std::to_string(i),
             kExportAgain);
  }
}

void checkQuaternions(const Asset& asset, int accessor, bool cubic) {
  if (!hasOwnData(asset, accessor)) return;
  const auto values = readFloats(asset, accessor);
  const bool coarse = !isFloatComponent(asset.model.accessors[std::size_t(accessor)].componentType);
  const float tolerance = coarse ? 0.02f : 0.01f;
  for (std::size_t i = 0; i < values.size() / 4; ++i) {
    if (cubic && i % 3 != 1) continue;  // tangents may have any length
    const float* q = &values[4 * i];
    const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(std::abs(length - 1) <= tolerance))
      breaks(
          accessorPlace(accessor),
          "element " + std::to_string(i) + " must be a unit quaternion, has length " + std::to_string(length),
          "normalise the rotations");
  }
}

}  // namespace

void checkData(const Asset& asset) {
  std::set<int> normals;  // any length will do, and none (io/gltf_geometry.cpp)
  for (const auto& mesh : asset.model.meshes)
    for (const auto& primitive : mesh.primitives) normals.insert(primitive.normal);
  for (int i = 0; i < int(asset.model.accessors.size()); ++i) {
    if (!hasData(asset, i)) continue;
    checkSparseOrder(asset, i);
    if (!normals.contains(i)) checkValues(asset, i);
  }
  checkMeshData(asset);
  checkInverseBinds(asset);
}

void AnimationChecks::channel(const Model::Animation& animation, const Model::Channel& channel) {
  const auto once = [](auto& known, const auto& key, const auto& check) {
    const auto [at, isNew] = known.try_emplace(key);
    if (isNew) {
      try {
        check();
      } catch (const BrokenRule& rule) {
        at->second = rule;
      }
    }
    if (at->second) throw BrokenRule(*at->second);
  };
  const auto& sampler = animation.samplers[std::size_t(channel.sampler)];
  once(times_, sampler.input, [&] { checkTimes(*asset_, sampler.input); });
  if (channel.path != Model::Path::rotation) return;
  const bool cubic = sampler.interpolation == Interpolation::cubic;
  once(rotations_, std::pair(sampler.output, cubic),
       [&] { checkQuaternions(*asset_, sampler.output, cubic); });
}

}  // namespace vasa::gltf
