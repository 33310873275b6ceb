#include "network/patch_chunk.h"

#include <cmath>

#include "math/aabb.h"

namespace vasa {
namespace {

constexpr int kFinest = -22;  // steps of a coordinate below 4 m are exact in a float

void write(const ForkPatch& patch, PortableWriter& out) {
  out.raw(std::uint8_t(patch.rings.size()));
  for (const PatchRing& ring : patch.rings) {
    out.number(ring.vessel.value);
    out.raw(ring.parameter);
    out.raw(ring.centre);
    out.raw(ring.outward);
    out.raw(ring.radius);
    out.number(ring.vertices);
  }
  Aabb box;
  for (const vec3& p : patch.positions) box.add(p);
  int exponent = kFinest;
  while (std::ldexp(kGridSteps - 1, exponent) < box.size()) ++exponent;
  const float step = std::ldexp(1.0f, exponent);
  vec3 origin;
  for (int axis = 0; axis < 3; ++axis) origin[axis] = std::round(box.low[axis] / step) * step;
  out.number(patch.positions.size());
  out.raw(origin);
  out.raw(std::int8_t(exponent));
  for (std::size_t i = 0; i < patch.positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      out.raw(std::uint16_t(
          std::clamp(std::round((patch.positions[i][axis] - origin[axis]) / step), 0.0f, kGridSteps)));
    for (std::size_t k = 0; k < patch.rings.size(); ++k) out.raw(patch.weights[i][k]);
  }
  out.number(patch.triangles.size());
  for (const uvec3& t : patch.triangles)
    for (int k = 0; k < 3; ++k) out.number(t[k]);
}

std::uint32_t index(PortableReader& in) {
  return std::uint32_t(std::min<std::uint64_t>(in.number(), 0xfffffffe));
}

ForkPatch read(PortableReader& in) {
  ForkPatch patch;
  patch.rings.resize(
      std::min<std::size_t>(in.raw<std::uint8_t>(), ForkPatch::kMostRings + 1));  // too many is a fault
  for (PatchRing& ring : patch.rings) {
    ring.vessel = {index(in)};
    ring.parameter = in.raw<float>();
    ring.centre = in.raw<vec3>();
    ring.outward = in.raw<vec3>();
    ring.radius = in.raw<float>();
    ring.vertices = std::min<std::uint32_t>(index(in), ForkPatch::kMostVertices);
  }
  patch.positions.resize(in.count(6 + patch.rings.size()));
  patch.weights.resize(patch.positions.size());
  const vec3 origin = in.raw<vec3>();
  const float step = std::ldexp(1.0f, in.raw<std::int8_t>());
  for (std::size_t i = 0; i < patch.positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      patch.positions[i][axis] = origin[axis] + step * float(in.raw<std::uint16_t>());
    for (std::size_t k = 0; k < patch.rings.size(); ++k) {
      const auto weight = in.raw<std::uint8_t>();
      if (k < ForkPatch::kMostRings) patch.weights[i][k] = weight;
    }
  }
  patch.triangles.resize(in.count(3));
  for (uvec3& t : patch.triangles)
    for (int k = 0; k < 3; ++k) t[k] = index(in);
  return patch;
}

}  // namespace

PortableWriter patchPayload(std::span<const ForkPatch> patches) {
  PortableWriter out;
  out.number(patches.size());
  for (const ForkPatch& patch : patches) write(patch, out);
  return out;
}

bool readPatches(std::span<const std::byte> payload, std::vector<ForkPatch>& patches) {
  PortableReader in(payload);
  for (std::size_t left = in.count(30); left && in.ok(); --left) patches.push_back(read(in));
  return in.ok() && in.empty();
}

}  // namespace vasa
