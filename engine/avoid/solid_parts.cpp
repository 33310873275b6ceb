#include "avoid/solid_parts.h"

#include <map>
#include <optional>

#include "body/mesh_role.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "core/kept.h"
#include "core/parallel.h"

namespace vasa {
namespace {

constexpr const char* kKind = "bones";

std::uint32_t carrierOf(const SkinInfluence& influence) {
  std::size_t heaviest = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (influence.weights[int(k)] > influence.weights[int(heaviest)]) heaviest = k;
  return influence.joints[heaviest];
}

}  // namespace

SolidParts::SolidParts(const Body& body) {
  for (const SkinnedMesh& mesh : body.meshes)
    if (isSolid(mesh) && !mesh.influences.empty()) add(mesh);
}

void SolidParts::add(const SkinnedMesh& mesh) {
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>>
      vertices;  // of a joint: mesh's number -> part's
  std::map<std::uint32_t, Part> parts;
  for (const uvec3& triangle : mesh.mesh.triangles) {
    const std::uint32_t joint = carrierOf(mesh.influences[triangle.x]);
    Part& part = parts[joint];
    uvec3 own;
    for (int k = 0; k < 3; ++k) {
      const auto [at, fresh] = vertices[joint].try_emplace(triangle[k], std::uint32_t(part.positions.size()));
      if (fresh) part.positions.push_back(mesh.mesh.positions[triangle[k]]);
      own[k] = at->second;
    }
    part.triangles.push_back(own);
  }
  for (auto& [joint, part] : parts) part.joint = joint, parts_.push_back(std::move(part));
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
