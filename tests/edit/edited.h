#pragma once
#include <string>

#include "edit/replay.h"

namespace vasa::test {

/// A trunk of 200 mm along z (radius 5 mm, thinning to 4), an artery "side" of 60 mm that leaves it at 80 mm
/// along x (radius 2 mm), "twig" of 30 mm on that, and "far", 40 mm off in y beside the trunk and as long, of
/// 3 mm radius.
Network smallTree();

/// The journal's lines replayed onto a network.
Replay replayed(const Network& network, const std::string& journal);

/// The same where every line is to be applied; fails the test with its refusal where one is not.
Network edited(const Network& network, const std::string& journal);

/// The only line's refusal; fails the test where it was applied.
std::string refusalOf(const Network& network, const std::string& journal);

const Vessel& vesselNamed(const Network& network, const std::string& name);
std::span<const vec4> pointsOf(const Network& network, const std::string& name);

/// Radius and place at a share of a vessel's length.
vec4 at(const Network& network, const std::string& name, float share);

/// Least and greatest radius of a vessel.
float leastRadius(const Network& network, const std::string& name);
float greatestRadius(const Network& network, const std::string& name);

}  // namespace vasa::test
