#pragma once
#include <string>

namespace vasa::gltf {

/// A rule of glTF that a file breaks. Thrown only between the readers of this folder; readBody and its
/// siblings (io/gltf.h) turn it into a Result with the file's name in front.
struct BrokenRule {
  std::string place;   ///< JSON pointer such as "/accessors/3/byteOffset", or a place in the GLB container
  std::string rule;    ///< what is wrong, with the value found
  std::string remedy;  ///< what to do about it
};

[[noreturn]] inline void breaks(std::string place, std::string rule, std::string remedy) {
  throw BrokenRule{std::move(place), std::move(rule), std::move(remedy)};
}

inline constexpr const char* kExportAgain = "export the file again";

}  // namespace vasa::gltf
