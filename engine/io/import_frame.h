#pragma once
#include <string_view>
#include <utility>

#include "math/types.h"

namespace vasa {

/// How a file without units of its own (OBJ, STL, SWC, VTP) lies in the world: house units are metres, +Y up.
struct ImportFrame {
  enum class Up { y, z };
  double metresPerUnit = 1;  ///< > 0; 0.001 for millimetres
  Up up = Up::y;

  /// Z up, facing -Y, becomes Y up, facing +Z.
  vec3 toHouse(dvec3 p) const {
    const dvec3 turned = up == Up::z ? dvec3(p.x, p.z, -p.y) : p;
    return vec3(turned * metresPerUnit);
  }
  /// The other way.
  dvec3 toFile(vec3 p) const {
    const dvec3 q = dvec3(p) / metresPerUnit;
    return up == Up::z ? dvec3(q.x, -q.z, q.y) : q;
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

/// Coordinates beyond this many metres are taken for a wrong unit or a damaged file.
constexpr double kLargestImportedCoordinate = 1e6;

}  // namespace vasa
