#pragma once
#include <memory>
#include <optional>

#include "body/binding.h"

namespace vasa {

/// Binds networks that were made out of a bound one by edits. Arcs stay those that the first network asked
/// for: points that are where they were keep their stations to the bit, and others cost what they alone cost.
class Rebinder {
 public:
  /// @param body  read, not kept. @param spines  of the first network's binding
  Rebinder(const Body& body, SpineSet spines);
  ~Rebinder();
  Rebinder(const Rebinder&) = delete;
  Rebinder& operator=(const Rebinder&) = delete;

  /// A vessel of the edited network and what it was: its points in the bound network, none for a vessel whose
  /// points are others now.
  struct Kept {
    std::uint32_t firstPoint = 0, pointCount = 0;
    std::optional<std::uint32_t> before;  ///< its first point in the bound network
  };
  /// @param points  of the edited network at rest [m]; @param vessels  all of it, in order
  /// O(other points · joints + all points)
  Binding rebind(const Binding& bound, std::span<const vec4> points, std::span<const Kept> vessels) const;

 private:
  struct Fields;
  std::unique_ptr<const Fields> fields_;
};

}  // namespace vasa
