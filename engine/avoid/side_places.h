#pragma once
#include <array>
#include <span>

#include "collide/contact.h"
#include "curve/bezier.h"

namespace vasa {

/// Parameters of two tubes, of which the first has the lower number.
struct SidePlace {
  float s = 0, t = 0;
};

constexpr std::size_t kSidePlaces = 5;

/// The places at which two tubes are to be kept apart: where they come nearest, then those of the one nearest
/// to four spread evenly over the other. Two tubes that run side by side are near one another along all their
/// length, and held at one place only they would turn about it.
std::array<SidePlace, kSidePlaces> sidePlaces(const Contact& nearest, std::span<const Bezier> tubes);

}  // namespace vasa
