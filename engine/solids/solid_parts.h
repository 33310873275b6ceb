#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "body/body.h"
#include "collide/distance_field.h"

namespace vasa {

/// What vessels must not enter: a body's solid meshes (body/mesh_role.h), cut by the joint or axial bone that
/// carries each triangle, which is the one with the largest weight at the triangle's first corner.
class SolidParts {
 public:
  explicit SolidParts(const Body& body);

  std::size_t count() const { return parts_.size(); }
  /// As influences name it.
  std::uint32_t joint(std::size_t part) const { return parts_[part].joint; }

  /// A field each, with the bricks that an earlier run filled where it kept them (core/kept.h).
  std::vector<DistanceField> fields() const;
  /// Of what the fields depend on: their name where they are kept.
  std::uint64_t key() const;
  static void keepFields(std::uint64_t key, std::span<const DistanceField* const> fields);

 private:
  struct Part {
    std::uint32_t joint = 0;
    TriangleMesh mesh;  // [m] as bound
  };
  void add(const SkinnedMesh& mesh);

  std::vector<Part> parts_;
};

}  // namespace vasa
