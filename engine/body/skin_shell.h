#pragma once
#include <optional>

#include "body/body.h"
#include "mesh/triangle_tree.h"
#include "mesh/winding_number.h"

namespace vasa {

/// A body's skin at rest as the boundary between inside and outside. Skins have holes (eyes, mouth) and
/// overlap themselves (an arm against the chest); inside is where the surface winds around a place.
class SkinShell {
 public:
  /// @param mesh  closed but for small holes, outward
  explicit SkinShell(TriangleMesh mesh);
  SkinShell(const SkinShell&) = delete;
  SkinShell& operator=(const SkinShell&) = delete;

  struct Place {
    vec3 nearest{0};
    vec3 normal{0};  ///< of the surface there, outward
    std::uint32_t triangle = 0;
    float depth = 0;  ///< [m] below the surface; negative outside
  };
  /// Expected O(log n), as the next.
  Place look(vec3 p) const;
  bool contains(vec3 p) const;
  /// The nearest place, if one is nearer than `within` and the surface faces there as a unit direction does,
  /// by the least cosine.
  std::optional<vec3> facing(vec3 p, vec3 normal, float cosine, float within) const;

  const TriangleMesh& mesh() const { return mesh_; }

 private:
  TriangleMesh mesh_;
  TriangleTree tree_;
  WindingNumber winding_;
};

/// A body's mesh at rest in model space.
TriangleMesh meshAtRest(const Body& body, const SkinnedMesh& skinned);

/// The skin's mesh at rest in model space; empty where the body has none.
TriangleMesh skinAtRest(const Body& body);

}  // namespace vasa
