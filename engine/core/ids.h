#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace vasa {

constexpr std::uint32_t kNone = 0xffffffffu;  ///< what an index holds that leads nowhere

/// A typed 32-bit index: a vessel's number cannot be mistaken for a node's.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kNone = vasa::kNone;
  std::uint32_t value = kNone;

  constexpr bool valid() const { return value != kNone; }
  constexpr auto operator<=>(const Id&) const = default;
};

using VesselId = Id<struct VesselTag>;
using NodeId = Id<struct NodeTag>;
using JointId = Id<struct JointTag>;

}  // namespace vasa

template <class Tag>
struct std::hash<vasa::Id<Tag>> {
  std::size_t operator()(vasa::Id<Tag> id) const noexcept { return id.value; }
};
