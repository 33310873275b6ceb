#pragma once
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

/// Coordinates beyond this many metres are taken for a wrong unit or a damaged file.
constexpr double kLargestImportedCoordinate = 1e6;

}  // namespace vasa
