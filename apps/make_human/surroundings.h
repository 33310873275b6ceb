#pragma once
#include "make_human/shape.h"
#include "make_human/solid.h"

namespace vasa::human {

/// What a vessel lies in and between, at rest. What it is made of must outlive it.
struct Surroundings {
  const Shape& skin;
  Solid bones, heart;

  /// [m] how deep p lies below the skin.
  float depth(vec3 p) const { return -skin.distance(p); }
};

}  // namespace vasa::human
