#pragma once
#include "convert/strand.h"

namespace vasa {

/// The sections without those at which a tube would fold, its axis bent sharper than its radius: where ends
/// were led on past a place, strands overlapped, rings were cut aslant. The sharpest bends go first. All that
/// is left out lies within a diameter of the axis that stays. First and last stay.
/// @param sections  at least 2
/// @param hosted    places that hang there: none comes to lie outside of the tube, or farther than it did
/// O(sections · (bends that fold + hosted)).
Sections withoutFolds(const Sections& sections, std::span<const vec3> hosted);

}  // namespace vasa
