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
  // A tube that has room for so much of its radius or of both radii.
  void tube(NetworkTubes::Address at, float room, bool ringsToo) const {
    const float factor = std::clamp(kSpare * room, 0.0f, 1.0f);
    const Vessel& vessel = network.vessel(at.vessel);
    for (std::uint32_t l = at.span; l < at.span + 4; ++l) {
      const NodeId node = l == 0 ? vessel.start : l + 1 == vessel.pointCount ? vessel.end : NodeId{};
      if (!node.valid())
        point(vessel.firstPoint + l, factor);
      else if (ringsToo)  // all ends that share a ring, so that it stays one
        for (const VesselEnd& end : network.ends(network.node(node))) point(network.pointOf(end), factor);
    }
  }
};

}  // namespace

void narrow(const Network& network, const NetworkTubes& layout, std::span<const Interference::Place> places,
            std::span<const BoneContact> bones, std::span<const Bezier> shape, std::span<const vec4> points,
            bool ringsToo, std::span<float> most) {
  const Narrower narrower{network, points, most};
  for (const Interference::Place& place : places) {
    const Contact& contact = place.contact;
    const float radii = shape[contact.i].at(contact.s).w + shape[contact.j].at(contact.t).w;
    for (const std::uint32_t tube : {contact.i, contact.j})
      narrower.tube(layout.address(tube), 1 - place.excess() / radii, ringsToo);
  }
  for (const BoneContact& bone : bones) {
    const float radius = shape[bone.tube].at(bone.s).w;
    narrower.tube(layout.address(bone.tube), 1 - (bone.allowed - bone.f) / radius, ringsToo);
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
