#include "viewer/carried_shape.h"

#include <map>
#include <optional>

#include "curve/arc_length.h"
#include "curve/bspline.h"
#include "curve/fit.h"

namespace vasa::viewer {
namespace {

// What a vessel is over all edits: its number in the base, or the name that it was added under.
using Identity = std::pair<std::uint32_t, std::string>;

Identity identityOf(const Document& document, std::uint32_t vessel) {
  if (document.origins.empty()) return {vessel, ""};
  const VesselId origin = document.origins[vessel];
  if (origin.valid()) return {origin.value, ""};
  return {VesselId{}.value, document.scene.network.vessels()[vessel].name};
}

}  // namespace

CarriedShape::CarriedShape(std::shared_ptr<const Document> document, const FrameMaker& maker)
    : document_(std::move(document)) {
  const auto posed = maker.posedPoints(), points = maker.points();
  for (std::size_t p = 0; p < points.size(); ++p)
    aside_.emplace_back(glm::inverse(maker.rotations()[p]) * vec3(points[p] - posed[p]),
                        points[p].w / posed[p].w);
}

std::vector<vec4> CarriedShape::laidOn(const Document& edited, const FrameMaker& maker) const {
  const Network &before = document_->scene.network, &after = edited.scene.network;
  std::map<Identity, std::uint32_t> known;
  for (std::uint32_t v = 0; v < before.vessels().size(); ++v) known[identityOf(*document_, v)] = v;
  std::vector<vec4> points(maker.posedPoints().begin(), maker.posedPoints().end());
  for (std::uint32_t v = 0; v < after.vessels().size(); ++v) {
    const auto found = known.find(identityOf(edited, v));
    if (found == known.end()) continue;
    const Vessel &was = before.vessels()[found->second], &is = after.vessels()[v];
    const auto own = Network::pointsOf(was, aside_);
    std::optional<ArcLength> old, now;
    if (was.pointCount != is.pointCount) old.emplace(before.pointsOf(was)), now.emplace(after.pointsOf(is));
    for (std::uint32_t i = 0; i < is.pointCount; ++i) {
      const std::uint32_t p = is.firstPoint + i;
      vec4 aside;
      if (old && old->length() > 0 && now->length() > 0) {
        const float share = now->along(float(greville(i, is.spanCount()))) / now->length();
        aside = evaluate(own, old->parameterAt(share * old->length()));
      } else {
        aside = own[std::min(std::size_t(i), own.size() - 1)];
      }
      points[p] = vec4(vec3(points[p]) + maker.rotations()[p] * vec3(aside), points[p].w * aside.w);
    }
  }
  pinEnds(after, points);
  return points;
}

}  // namespace vasa::viewer
