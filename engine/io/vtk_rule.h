#pragma once
#include <cstddef>
#include <string>
#include <utility>

namespace vasa::vtk {

constexpr std::size_t kMaximumBytes = std::size_t(1) << 28;  ///< of a file

/// The first rule that a file does not keep to: thrown by readers of VTK's files, legacy and XML.
struct BrokenRule {
  std::string place, rule;
};
[[noreturn]] inline void breaks(std::string place, std::string rule) {
  throw BrokenRule{std::move(place), std::move(rule)};
}

}  // namespace vasa::vtk
