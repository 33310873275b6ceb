#pragma once
#include <span>
#include <string>
#include <vector>

namespace vasa {

/// The names that were most likely meant, best first: those with the fewest letters to change, drop, add or
/// swap (Damerau 1964), a third of the letters at most, or that hold all the words of what was written. Upper
/// and lower case are alike. O(names · letters²)
std::vector<std::string> nearestNames(const std::string& written, std::span<const std::string> names,
                                      std::size_t most);

/// A question for a message: "did you mean walk?", "did you mean walk, run or "fast run"?"; where nothing is
/// like it, `otherwise`.
std::string didYouMean(const std::string& written, std::span<const std::string> names,
                       const std::string& otherwise = {});

}  // namespace vasa
