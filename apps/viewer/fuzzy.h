#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vasa::viewer {

/// How well a name answers what somebody types; more is better, nothing where it does not. Every word typed
/// has to be in the name, in any order, its letters one after another with others between them: "femrl" finds
/// "left femoral artery", and so does "art fem". Letters at the beginnings of words and letters in a row
/// count most, gaps and the name's own length against it. Case does not matter; ae and oe are found by e, too
/// ("celiac", "coeliac").
std::optional<float> fuzzyScore(std::string_view typed, std::string_view name);

/// The names that answer, best first; equally good ones as they come. O(names · letters²)
std::vector<std::uint32_t> fuzzySearch(std::string_view typed, std::span<const std::string_view> names);

}  // namespace vasa::viewer
