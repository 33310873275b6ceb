#pragma once
#include <vector>

#include "mesh/slice.h"

namespace vasa {

/// Sections at right angles to a rough axis: area centroid and sqrt(area / pi) of the slices, in two passes
/// (the second slices at right angles to what the first found). Slices that catch a neighbour, a side branch
/// or a tear are left out: those whose radius or centre does not agree with their neighbours'.
/// @param rough  centres with radius estimates, in order
/// @param leastSpacing  [m]
/// @returns      sections about every 0.6 radii, but no closer than leastSpacing; fewer than two where the
/// surface gives none
std::vector<vec4> reslice(Slicer& slicer, const std::vector<vec4>& rough, float leastSpacing);

/// Goes on from the last section by slices until the surface ends, and appends what it meets; the last one
/// appended is the flat end. Stops as well where the tube widens or narrows abruptly.
/// @param sections  at least 2
/// @param limit     [m] do not go further than this
void extendToEnd(Slicer& slicer, std::vector<vec4>& sections, float limit);

/// The polyline with its centres and radii averaged with their neighbours' `rounds` times; ends stay.
void smoothSections(std::vector<vec4>& sections, int rounds);

}  // namespace vasa
