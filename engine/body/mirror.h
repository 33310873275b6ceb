#pragma once
#include <string>
#include <string_view>

namespace vasa {

/// "left renal artery" <-> "right renal artery", "leftUpperLeg" <-> "rightUpperLeg".
std::string mirrored(std::string_view text);

/// Whether a name is one of a pair.
bool hasSide(std::string_view text);

}  // namespace vasa
