#pragma once
#include "network/centrelines.h"

namespace vasa {

/// Joins free ends of lines to the lines they touch: traces of others start where they leave another trace,
/// but say so by place alone. An end joins the line of its kind (veins of the portal system count as veins)
/// in whose tube it lies: a first sample within the other's radius of its centre, a last one within half of
/// it, which may be a crossing. Near another line's end (within its radius) ends meet, elsewhere the end is
/// led to the nearest place of the other line, which gets a sample there. A line does not join the same other
/// one twice within its own length, nor one that hangs on the line's own side.
/// @return how many ends were joined. O(samples), a search for each free end and a look at its host's samples
/// and all joints for each that joins; stops where these come to 10^9
std::size_t joinTouchingLines(Centrelines& lines);

}  // namespace vasa
