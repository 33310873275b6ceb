#pragma once
#include <cstdint>
#include <optional>

#include "body/binding.h"

namespace vasa {

/// What binding a network to a body gave.
struct Bound {
  Binding binding;
  float behind = 0;   ///< share of the vessels that stay in the rest pose (body/stillness.h)
  float outside = 0;  ///< share that lies outside the body at rest (body/belonging.h)
};

/// Of a network and a body (core/kept.h).
std::uint64_t boundKey(const Body& body, const Network& network);
/// What an earlier run kept of it; nothing where there is none.
std::optional<Bound> findBound(std::uint64_t key, const Body& body);
void keepBound(std::uint64_t key, const Bound& bound);

}  // namespace vasa
