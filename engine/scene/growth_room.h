#pragma once
#include <memory>

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

  /// Sets the site's reach and walls for trees that grow anywhere on a span: a ball and a few planes about the section's
  /// centre that hold no vertex of the skin between them, with a margin. Each plane is laid before the nearest vertex that
  /// no other keeps out, along the skin there; the ball ends before the nearest one left.
  void measure(const PosedNetwork& rest, const shared::SweepRecord& span, shared::GrowthSite& site) const;

 private:
  struct Skin;
  std::unique_ptr<Skin> skin_;
  float most_;
};

}  // namespace vasa
