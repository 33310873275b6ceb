#include "solids/solid_parts.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "body/mesh_role.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "core/ids.h"
#include "core/kept.h"
#include "core/parallel.h"

namespace vasa {
namespace {

constexpr const char* kKind = "bones";

}  // namespace

SolidParts::SolidParts(const Body& body) {
  for (const SkinnedMesh& mesh : body.meshes)
    if (isSolid(mesh) && !mesh.influences.empty()) add(mesh);
}

void SolidParts::add(const SkinnedMesh& mesh) {
  const auto jointOf = [&](const uvec3& triangle) -> std::uint32_t {
    const SkinInfluence& influence = mesh.influences[triangle.x];
    return influence.joints[influence.heaviest()];
  };
  std::vector<uvec3> triangles = mesh.mesh.triangles;
  std::ranges::stable_sort(triangles, {}, jointOf);
  struct Number {
    std::size_t part;
    std::uint32_t vertex;
  };
  std::vector<Number> numbers(mesh.mesh.positions.size());  // the vertex in the last part that has it
  std::uint32_t last = kNone;
  for (uvec3 triangle : triangles) {
    if (const std::uint32_t joint = jointOf(triangle); std::exchange(last, joint) != joint)
      parts_.push_back({joint, {}, {}});
    Part& part = parts_.back();
    for (int k = 0; k < 3; ++k) {
      Number& number = numbers[triangle[k]];
      if (number.part != parts_.size()) {
        number = {parts_.size(), std::uint32_t(part.positions.size())};
        part.positions.push_back(mesh.mesh.positions[triangle[k]]);
      }
      triangle[k] = number.vertex;
    }
    part.triangles.push_back(triangle);
  }
}

std::uint64_t SolidParts::key() const {
  std::uint64_t key = parts_.size();
  for (const Part& part : parts_)
    key = hashOf(std::span(part.triangles), hashOf(std::span(part.positions), key));
  return key;
}

std::vector<DistanceField> SolidParts::fields() const {
  std::vector<DistanceField> fields;
  if (const auto kept = findKept(kKind, key())) {
    ByteReader in(*kept);
    for (const Part& part : parts_) {
      auto field = DistanceField::restored(part.positions, part.triangles, {}, in);
      if (!field) break;
      fields.push_back(std::move(*field));
    }
  }
  if (fields.size() == parts_.size()) return fields;
  fields.clear();
  std::vector<std::optional<DistanceField>> made(parts_.size());
  parallelFor(parts_.size(), 1, [&](std::size_t k) {
    made[k].emplace(parts_[k].positions, parts_[k].triangles, DistanceField::Options{});
  });
  for (auto& field : made) fields.push_back(std::move(*field));
  return fields;
}

void SolidParts::keepFields(std::uint64_t key, std::span<const DistanceField* const> fields) {
  ByteWriter out;
  for (const DistanceField* field : fields) field->save(out);
  keep(kKind, key, out.bytes());
}

}  // namespace vasa
