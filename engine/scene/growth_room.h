#pragma once
#include <memory>
#include <span>

#include "body/body.h"
#include "shared/growth.h"
#include "surface/tessellate.h"

namespace vasa {

/// How much room capillaries have below the skin, at rest.
class GrowthRoom {
 public:
  /// @param most  [m] of a site's reach
  GrowthRoom(const Body& body, float most);
  ~GrowthRoom();

  /// Sets the site's reach and walls for trees that grow anywhere on a span: a ball and a few planes about
  /// the section's centre that hold no vertex of the skin between them, with a margin. Each plane is laid
  /// before the nearest vertex that no other keeps out, along the skin there; the ball ends before the
  /// nearest one left.
  void measure(const PosedNetwork& rest, const shared::SweepRecord& span, shared::GrowthSite& site) const;

 private:
  struct Skin;
  std::unique_ptr<Skin> skin_;
  float most_;
};

/// measure() for all spans whose sites are to have trees, several at a time, or what an earlier run kept of
/// it (core/kept.h).
/// @param grows  one a span
/// @param sites  one a span; reach and walls are set where it grows
void measureRooms(const Body& body, float most, const PosedNetwork& rest,
                  std::span<const shared::SweepRecord> spans, std::span<const std::uint8_t> grows,
                  std::span<shared::GrowthSite> sites);

}  // namespace vasa
