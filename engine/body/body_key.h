#pragma once
#include <cstdint>

namespace vasa {

struct Body;

/// A hash of all that a body is, clips included: what is kept of it (core/kept.h) is found by that. O(size),
/// some milliseconds.
std::uint64_t bodyKey(const Body& body);

}  // namespace vasa
