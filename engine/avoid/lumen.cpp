#include "avoid/lumen.h"

#include <algorithm>

namespace vasa {
namespace {

constexpr float kSpare = 0.995f;  // a little more than is asked for, so that it is settled in few rounds

struct Narrower {
  const Network& network;
  std::span<const vec4> points;
  std::span<float> most;

  void point(std::uint32_t at, float factor) const {
    const float least = std::min(points[at].w, kLeastLumen * network.points()[at].w);
    most[at] = std::min(most[at], std::max(points[at].w * factor, least));
  }
  // All ends that share a ring, so that it stays one.
  void ring(NodeId id, float factor) const {
    for (const VesselEnd& end : network.ends(network.node(id))) point(network.pointOf(end), factor);
  }
  void tube(NetworkTubes::Address at, float factor, bool ringsToo) const {
    const Vessel& vessel = network.vessel(at.vessel);
    for (std::uint32_t l = at.span; l < at.span + 4; ++l) {
      const NodeId node = l == 0 ? vessel.start : l + 1 == vessel.pointCount ? vessel.end : NodeId{};
      if (!node.valid())
        point(vessel.firstPoint + l, factor);
      else if (ringsToo)
        ring(node, factor);
    }
  }
};

}  // namespace

void narrow(const Network& network, const NetworkTubes& layout, std::span<const Interference::Place> places,
            std::span<const Bezier> shape, std::span<const vec4> points, bool ringsToo,
            std::span<float> most) {
  const Narrower narrower{network, points, most};
  for (const Interference::Place& place : places) {
    const Contact& contact = place.contact;
    const float radii = shape[contact.i].at(contact.s).w + shape[contact.j].at(contact.t).w;
    const float room = radii + contact.f - place.allowed;
    const float factor = std::clamp(kSpare * room / radii, 0.0f, 1.0f);
    narrower.tube(layout.address(contact.i), factor, ringsToo);
    narrower.tube(layout.address(contact.j), factor, ringsToo);
  }
}

void narrow(const Network& network, const NetworkTubes& layout, std::span<const BoneContact> places,
            std::span<const Bezier> shape, std::span<const vec4> points, bool ringsToo,
            std::span<float> most) {
  const Narrower narrower{network, points, most};
  for (const BoneContact& place : places) {
    const float radius = shape[place.tube].at(place.s).w;
    narrower.tube(layout.address(place.tube),
                  std::max(kSpare * (radius + place.f - place.allowed) / radius, 0.0f), ringsToo);
  }
}

std::vector<NarrowPlace> narrowPlaces(const Network& network, std::span<const vec4> before,
                                      std::span<const vec4> points) {
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
