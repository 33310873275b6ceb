#include "convert/span_limit.h"

#include <algorithm>
#include <limits>

namespace vasa {
namespace {

// For nothing, to all elements together: a coarse vessel of thirty triangles asks for four a triangle. They
// take half a second to fit.
constexpr std::size_t kFreeSpans = 500;

}  // namespace

std::size_t spansToldBy(std::size_t triangles, std::size_t elements) {
  return kFreeSpans / elements + triangles;
}

std::uint32_t spanLimit(std::vector<std::uint32_t> wanted, std::size_t allowed) {
  std::ranges::sort(wanted);
  std::size_t left = allowed;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::size_t share = left / (wanted.size() - i);  // of those that ask for as much or more
    if (wanted[i] > share) return std::uint32_t(std::max<std::size_t>(share, 1));
    left -= wanted[i];
  }
  return std::numeric_limits<std::uint32_t>::max();
}

}  // namespace vasa
