#include "solids/solid_parts.h"

#include <map>
#include <optional>

#include "body/mesh_role.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "core/kept.h"
#include "core/parallel.h"
#include "mesh/components.h"

namespace vasa {
namespace {

constexpr const char* kKind = "bones";

}  // namespace

SolidParts::SolidParts(const Body& body) {
  for (const SkinnedMesh& mesh : body.meshes)
    if (isSolid(mesh) && !mesh.influences.empty()) add(mesh);
}

void SolidParts::add(const SkinnedMesh& mesh) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> trianglesOf;  // of each joint
  for (std::uint32_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    const SkinInfluence& influence = mesh.influences[mesh.mesh.triangles[t].x];
    trianglesOf[influence.joints[influence.heaviest()]].push_back(t);
  }
  for (const auto& [joint, triangles] : trianglesOf) parts_.push_back({joint, partOf(mesh.mesh, triangles)});
}

std::uint64_t SolidParts::key() const {
  std::uint64_t key = parts_.size();
  for (const Part& part : parts_)
    key = hashOf(std::span(part.mesh.triangles), hashOf(std::span(part.mesh.positions), key));
  return key;
}

std::vector<DistanceField> SolidParts::fields() const {
  std::vector<DistanceField> fields;
  if (const auto kept = findKept(kKind, key())) {
    ByteReader in(*kept);
    for (const Part& part : parts_) {
      auto field = DistanceField::restored(part.mesh.positions, part.mesh.triangles, {}, in);
      if (!field) break;
      fields.push_back(std::move(*field));
    }
  }
  if (fields.size() == parts_.size()) return fields;
  fields.clear();
  std::vector<std::optional<DistanceField>> made(parts_.size());
  parallelFor(parts_.size(), 1, [&](std::size_t k) {
    made[k].emplace(parts_[k].mesh.positions, parts_[k].mesh.triangles, DistanceField::Options{});
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
