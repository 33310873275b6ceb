#include "body/mesh_role.h"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "body/bone_field.h"
#include "core/letters.h"

namespace vasa {
MeshRole roleNamed(std::string_view name) {
  const std::string lower = lowerCase(name);
  const auto hasAny = [&](std::initializer_list<std::string_view> parts) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](std::string_view part) { return lower.find(part) != std::string::npos; });
  };
  if (lower.starts_with("skin")) return MeshRole::skin;
  if (lower.starts_with("keep-out")) return MeshRole::keepOut;
  if (hasAny({"bone", "skelet", "cartilage", "teeth"})) return MeshRole::bones;
  if (hasAny({"heart"})) return MeshRole::heart;
  if (hasAny({"skin", "body"})) return MeshRole::skin;
  if (hasAny({"organ", "brain", "lung", "liver", "kidney", "spleen", "stomach"})) return MeshRole::organs;
  return MeshRole::other;
}

bool isSolid(const SkinnedMesh& mesh) {
  switch (roleNamed(mesh.name)) {
    case MeshRole::bones:
    case MeshRole::keepOut:
      return true;
    case MeshRole::heart:
      return !lowerCase(mesh.name).starts_with("organ");
    case MeshRole::skin:
    case MeshRole::organs:
      return false;
    case MeshRole::other:
      break;
  }
  return movesByRigidParts(mesh);
}

}  // namespace vasa
