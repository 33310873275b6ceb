#include "avoid/lumen.h"

#include <algorithm>

namespace vasa {
namespace {

constexpr float kSpare = 0.995f;  // a little more than is asked for, so that it is settled in few rounds

void narrowTube(const Network& network, NetworkTubes::Address at, float factor, std::span<const vec4> points,
                std::span<float> most) {
  const Vessel& vessel = network.vessel(at.vessel);
  for (std::uint32_t l = at.span; l < at.span + 4; ++l) {
    if ((l == 0 && vessel.start.valid()) || (l + 1 == vessel.pointCount && vessel.end.valid())) continue;
    const std::uint32_t point = vessel.firstPoint + l;
    const float least = std::min(points[point].w, kLeastLumen * network.points()[point].w);
    most[point] = std::min(most[point], std::max(points[point].w * factor, least));
  }
}

}  // namespace

void narrow(const Network& network, const NetworkTubes& layout, std::span<const Interference::Place> places,
            std::span<const Bezier> shape, std::span<const vec4> points, std::span<float> most) {
  for (const Interference::Place& place : places) {
    const Contact& contact = place.contact;
    const float radii = shape[contact.i].at(contact.s).w + shape[contact.j].at(contact.t).w;
    const float room = radii + contact.f - place.allowed;
    const float factor = std::clamp(kSpare * room / radii, 0.0f, 1.0f);
    narrowTube(network, layout.address(contact.i), factor, points, most);
    narrowTube(network, layout.address(contact.j), factor, points, most);
  }
}

std::vector<NarrowPlace> narrowPlaces(const Network& network, std::span<const vec4> before, std::span<const vec4> points) {
  std::vector<NarrowPlace> found;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) {
      NarrowPlace place{{v}, span, 1};
      bool thinner = false;
      for (std::uint32_t p = vessel.firstPoint + span; p < vessel.firstPoint + span + 4; ++p) {
        if (points[p].w >= before[p].w) continue;
        thinner = true;
        place.factor = std::min(place.factor, points[p].w / network.points()[p].w);
      }
      if (thinner) found.push_back(place);
    }
  }
  return found;
}

}  // namespace vasa
