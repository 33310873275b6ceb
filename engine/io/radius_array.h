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
  double unit = 0;  ///< [m] of a length of it where its name says so ("radius_mm"), else 0: as the points
};

/// Which array tells radii: MaximumInscribedSphereRadius (VMTK), else "radius", "radii", "r", else
/// "diameter", else a name that ends in one of these words, radii before diameters and least ones
/// ("MinRadius") last; capitals and accents do not count, other languages do ("rayon", "Durchmesser"), and a
/// unit behind it may be told ("Max Diameter (mm)"). Radii of curvature are none of a vessel. Of several the
/// first of the best kind.
std::optional<RadiusChoice> chooseRadius(std::span<const std::string> names);

/// What a reader says of radii that are not under VMTK's or its own name; empty where nothing is to be said.
std::string radiusRemark(const std::string& array, const RadiusChoice& choice, bool ofLines);

/// What is wrong with a radius, and what to do; empty where nothing is.
/// @param point  its number, for the message
std::string radiusFault(double radius, double metresPerUnit, std::size_t point);

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
