#pragma once
#include <cstdint>

namespace vasa {

class Network;

/// A hash of all that a network is but for names: what is kept of it (core/kept.h) is found by that.
/// O(points).
std::uint64_t networkKey(const Network& network);

}  // namespace vasa
