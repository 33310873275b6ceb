#pragma once
#include <limits>
#include <span>
#include <vector>

#include "body/body.h"

namespace vasa {

/// The inside of a body at rest, cut into small cubes: what capillaries fill. Flesh is what lies inside the
/// skin and outside of bones and other solid meshes; lumen is flesh that a wide vessel takes, and an organ's
/// hollow.
struct Tissue {
  enum class Kind : std::uint8_t { flesh, lumen, solid };

  float cell = 0;  ///< [m] side of a cube
  vec3 low{0};     ///< corner of the grid
  ivec3 size{0};
  bool hasSkin = false;
  std::vector<std::int32_t> at;  ///< one a place of the grid, x fastest: number of its cube, -1 outside
  std::vector<ivec3> places;     ///< one a cube
  std::vector<Kind> kinds;
  std::vector<std::uint8_t> rooms;  ///< one a cube: the organ that it lies in; kCommon, kHollow

  static constexpr std::uint8_t kCommon = 0, kHollow = 255;

  std::size_t count() const { return places.size(); }
  /// Makes lumen of the flesh in a ball.
  void clear(vec3 centre, float radius);
  std::int32_t numberAt(ivec3 place) const;  ///< -1 outside
  std::int32_t numberAt(vec3 p) const { return numberAt(ivec3(glm::floor((p - low) / cell))); }
  vec3 centreOf(std::int32_t number) const { return centreOf(places[std::size_t(number)]); }
  vec3 centreOf(ivec3 place) const { return low + cell * (vec3(place) + 0.5f); }
};

/// A mesh of the body whose inside is a room of its own.
struct OrganRoom {
  const SkinnedMesh* mesh;
  float wall = 0;  ///< [m] what lies deeper is hollow, the outermost cubes never; 0: nothing is
};

/// @param cell   [m]
/// @param near   what lies within `reach` of these places is taken for the inside of a body without skin
/// Skins have holes and overlap themselves: a place is inside where a surface winds around it as two of three
/// lines through it along the axes see it. O(cubes of the box + triangles that cross them)
/// @param organs  that of number i is room i + 1, at most 254; where they overlap the first counts
Tissue tissueOf(const Body& body, float cell, std::span<const vec3> near, float reach,
                std::span<const OrganRoom> organs = {});

/// Shortest ways through the tissue from some cubes to all others, from cube to cube over faces, edges and
/// corners, in tenths of a cube's side.
struct TissueWays {
  static constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
  struct Source {
    std::int32_t cube;
    std::int32_t name;
  };
  std::vector<std::uint32_t> length;  ///< one a cube; kFar: no way leads there
  std::vector<std::int32_t> before;   ///< the next cube on the way back; itself at a source
  std::vector<std::int32_t> source;   ///< name of the source that the way comes from
};

/// @param through  one a cube: whether ways lead there
/// @param toll     [tenths of a cube's side] added where a way leaves a room for another
/// Of several sources in a cube the first counts. Dial's buckets; O(cubes)
TissueWays waysFrom(const Tissue& tissue, const std::vector<TissueWays::Source>& sources,
                    const std::vector<char>& through, std::uint32_t toll = 0);

/// How deep each cube of a part of the tissue lies in it: in tenths of a cube's side from the outermost ones,
/// which have a face that is not of the part; kFar for those outside. O(cubes)
std::vector<std::uint32_t> depthsIn(const Tissue& tissue, const std::vector<char>& part);

}  // namespace vasa
