#pragma once
#include "avoid/interference.h"

namespace vasa {

/// What an exact query with zero margin over a shape says.
struct Certificate {
  std::uint32_t contacts = 0;      ///< pairs of tubes that interfere: overlap, and more than they do at rest
  float depth = 0;                 ///< [m] the deepest: of overlap, or beyond the overlap at rest
  std::uint32_t restContacts = 0;  ///< pairs left out of `contacts`, because they are no deeper than at rest
  bool holds() const { return contacts == 0; }
};

/// Exact to the detector's tolerance (5e-8 m); says nothing of neighbours along the network.
/// @param places       that Interference::find() returned for the shape
/// @param interfering  if given, receives the places that count, sorted by pair
Certificate certificateOf(std::span<const Interference::Place> places,
                          std::vector<Interference::Place>* interfering = nullptr);

}  // namespace vasa
