#include "body/kept_binding.h"

#include <array>
#include <bit>

#include "body/body_key.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "core/kept.h"
#include "network/network_key.h"

namespace vasa {
namespace {

constexpr const char* kKind = "binding";

}  // namespace

std::uint64_t boundKey(const Body& body, const Network& network) {
  const std::array keys{bodyKey(body), networkKey(network)};
  return hashOf(std::span<const std::uint64_t>(keys));
}

// Of the spines only what binding settles: the rest follows from the skeleton.
std::optional<Bound> findBound(std::uint64_t key, const Body& body) {
  const auto kept = findKept(kKind, key);
  auto spines = kept ? deriveSpines(body.skeleton, body.name) : Result<SpineSet>(SpineSet{});
  if (!kept || !spines) return {};
  ByteReader in(*kept);
  Bound bound{{std::move(*spines), 0, {}, {}, {}}, 0, 0};
  for (SpineJoint& joint : bound.binding.spines.joints) {
    std::uint8_t spreads = 0;
    if (!in.take(joint.arc) || !in.take(spreads)) return {};
    joint.spreadsTwist = spreads != 0;
  }
  using Raw = std::array<std::uint16_t, 3>;
  static_assert(sizeof(Raw) == sizeof(BindingRecord));
  std::vector<Raw> records, axialBones;
  if (!in.take(bound.behind) || !in.take(bound.outside) || !in.take(bound.binding.pointCount) ||
      !in.takeAll(records) || !in.takeAll(bound.binding.firstRecord) || !in.takeAll(axialBones))
    return {};
  const auto unpack = [](const std::vector<Raw>& from, std::vector<BindingRecord>& to) {
    to.reserve(from.size());
    for (const Raw& raw : from) to.push_back(std::bit_cast<BindingRecord>(raw));
  };
  unpack(records, bound.binding.records);
  unpack(axialBones, bound.binding.axialBones);
  return bound;
}

void keepBound(std::uint64_t key, const Bound& bound) {
  ByteWriter out;
  for (const SpineJoint& joint : bound.binding.spines.joints) {
    out.add(joint.arc);
    out.add(std::uint8_t(joint.spreadsTwist));
  }
  out.add(bound.behind);
  out.add(bound.outside);
  out.add(bound.binding.pointCount);
  out.addAll(std::span<const BindingRecord>(bound.binding.records));
  out.addAll(std::span<const std::uint32_t>(bound.binding.firstRecord));
  out.addAll(std::span<const BindingRecord>(bound.binding.axialBones));
  keep(kKind, key, out.bytes());
}

}  // namespace vasa
