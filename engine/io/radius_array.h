#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "math/types.h"

// VTK's files of centre lines tell radii under whatever name their writer likes, of points or of whole lines.
namespace vasa {

struct RadiusChoice {
  std::size_t array = 0;  ///< of the names
  double factor = 1;      ///< 0.5 where it tells diameters
};

/// Which array tells radii: MaximumInscribedSphereRadius (VMTK), else "radius", "radii", "r", or a name that
/// ends in one of the first two, else "diameter" or a name that ends so; capitals do not count. Of several
/// the first of the best kind.
std::optional<RadiusChoice> chooseRadius(std::span<const std::string> names);

/// What a reader says of radii that are not under VMTK's or its own name; empty where nothing is to be said.
std::string radiusRemark(const std::string& array, const RadiusChoice& choice, bool ofLines);

/// The remedy where no array fits: what there is, and what is looked for.
std::string missingRadius(std::span<const std::string> ofPoints, std::span<const std::string> ofLines);

/// Each point's radius from those of its lines: their mean.
/// @param ofLine  as many as lines; points of no line get 0
std::vector<double> radiiOfPoints(std::size_t points, std::span<const std::vector<std::uint32_t>> lines,
                                  std::span<const double> ofLine);

/// Points of lines whose radius is zero get that of the nearest one along lines that has one (by points
/// between them; of equally near ones the first), and where no line leads to any the mean of all.
/// @param points  (x, y, z, r)
/// @return how many got one; nothing where no point of a line has any
std::optional<std::size_t> mendRadii(std::span<const std::vector<std::uint32_t>> lines,
                                     std::span<vec4> points);

}  // namespace vasa
