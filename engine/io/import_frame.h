#pragma once
#include <string_view>
#include <utility>

#include "math/types.h"

namespace vasa {

/// How a file without units of its own (OBJ, STL, SWC, VTP) lies in the world: house units are metres, +Y up.
struct ImportFrame {
  enum class Up { y, z, zBackwards };  ///< z: facing -Y, as LPS; zBackwards: facing +Y, as RAS
  double metresPerUnit = 1;            ///< > 0; 0.001 for millimetres
  Up up = Up::y;

  /// Up becomes +Y, and what faces -Y (backwards: +Y) faces +Z.
  vec3 toHouse(dvec3 p) const {
    const double side = up == Up::zBackwards ? -1 : 1;
    const dvec3 turned = up == Up::y ? p : dvec3(side * p.x, p.z, -side * p.y);
    return vec3(turned * metresPerUnit);
  }
  /// The other way.
  dvec3 toFile(vec3 p) const {
    const double side = up == Up::zBackwards ? -1 : 1;
    const dvec3 q = dvec3(p) / metresPerUnit;
    return up == Up::y ? q : dvec3(side * q.x, -side * q.z, q.y);
  }
};

/// Lengths that files may be in [m]: "m", "cm", "mm", "in", "um"; 0 for another word.
constexpr double metresOfUnit(std::string_view name) {
  for (const auto& [unit, metres] : {std::pair<std::string_view, double>{"m", 1},
                                     {"cm", 0.01},
                                     {"mm", 0.001},
                                     {"in", 0.0254},
                                     {"um", 1e-6}})
    if (name == unit) return metres;
  return 0;
}

/// How people call a unit of so many metres.
constexpr std::string_view nameOfUnit(double metres) {
  return metres == 1       ? "metres"
         : metres == 0.01  ? "centimetres"
         : metres == 0.001 ? "millimetres"
         : metres < 0.001  ? "micrometres"
                           : "inches";
}

/// Coordinates beyond this many metres are taken for a wrong unit or a damaged file.
constexpr double kLargestImportedCoordinate = 1e6;

}  // namespace vasa
