#pragma once
#include <span>

#include "make_human/bone_form.h"
#include "make_human/layout.h"

namespace vasa::human {

/// A part of the body that small vessels grow through, from a row of growth.csv.
struct Region {
  enum class Shape {
    ellipsoid,  ///< around a place, half axes along the body's axes
    flesh,      ///< within a distance of a line through places
    heart,      ///< on the heart's surface
    organ,      ///< within an organ
  };
  std::string name;  ///< with its side
  Shape shape = Shape::ellipsoid;
  std::vector<vec3> places;
  vec3 size{0};  ///< [m] half axes, or the distance in x
  const BoneForm* organ = nullptr;
  bool mirrored = false;                ///< the right one of a pair of organs
  float inner = 0;                      ///< an ellipsoid's hollow, as a share of its size
  float leastDepth = 0, mostDepth = 1;  ///< [m] below the skin, or the organ's surface
  std::vector<int> leaders;             ///< vessels that send branches out, by number
  std::vector<int> companions;          ///< whose branches go beside them; may be empty
  float share = 1;                      ///< of all that grows, relative
  float reach = 0.06f;                  ///< [m] longest branch
  float tip = 0.4e-3f;                  ///< [m] radius at a branch's end

  /// Whether p lies in the region, bones and other vessels not regarded.
  bool contains(vec3 p, const Surroundings& around) const;
  /// Towards the region, if p has left its layer: the way to go.
  vec3 back(vec3 p, float radius, const Surroundings& around) const;
  Aabb bounds(const Surroundings& around) const;

 private:
  float depth(vec3 p, const Surroundings& around) const;
  vec3 outwards(vec3 p, const Surroundings& around) const;
};

/// Reads growth.csv. A leader or companion is named as in vessels.csv.
/// @param organs  must outlive the regions
Result<std::vector<Region>> readRegions(const std::filesystem::path& path, const VesselRows& vessels,
                                        const Rig& rig, std::span<const BoneForm> organs);

}  // namespace vasa::human
