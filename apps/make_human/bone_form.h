#pragma once
#include <string>
#include <vector>

#include "make_human/rig.h"
#include "math/aabb.h"

namespace vasa::human {

/// A piece that a bone is made of: a tube along a curve, its cross-section an ellipse that turns with it, its
/// ends half ellipsoids or, where those would be flat, planes with a rounded rim; or an ellipsoid, which is a
/// tube of one station.
struct BonePiece {
  struct Station {
    vec3 centre{0}, across{1, 0, 0}, up{0, 0, 1};
    float width = 0, height = 0;  ///< [m] half axes along across and up
  };
  bool carve = false;              ///< taken away from what the pieces before it make
  float blend = 0;                 ///< [m] radius of the smooth union
  float cell = 0;                  ///< [m] the polygons' size here
  float square = 2;                ///< exponent of the superellipse that the section is
  std::vector<Station> stations;   ///< near one another, at least one
  float capStart = 0, capEnd = 0;  ///< [m] how far the ends are rounded beyond the first and last station
  Aabb bounds;

  /// Signed distance to first order, negative inside, never below the least half axis.
  float distance(vec3 p) const;
};

/// A bone or an organ at rest: the smooth union of its pieces.
struct BoneForm {
  std::string name;
  std::string tissue;     ///< bone, cartilage or teeth; of an organ its colour
  std::vector<int> path;  ///< joints that move it, into Rig::points, in order along it; a bone has one
  bool paired = false;    ///< this is the left one of two
  std::vector<BonePiece> pieces;

  float distance(vec3 p) const;  ///< [m] negative inside; exact near the surface to first order
  vec3 gradient(vec3 p) const;
  float cellSize(vec3 p, float reach) const;  ///< [m] how fine the polygons must be within `reach` of p
  float finestCell() const;
  Aabb bounds() const;
};

/// How the first table calls what it has a row of, and what that is made of.
struct FormColumns {
  std::string_view name = "bone", tissue = "tissue";
};

/// Reads bones.csv (a row a bone: what it is made of, the joint that moves it, where it is put) and
/// bone_forms.csv (a row a piece), or tables of organs like them. Of paired bones the left ones alone.
Result<std::vector<BoneForm>> readBoneForms(const std::filesystem::path& bones,
                                            const std::filesystem::path& forms, const Rig& rig,
                                            FormColumns columns = {});

}  // namespace vasa::human
