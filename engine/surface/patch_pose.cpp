#include <algorithm>

#include "surface/fork.h"
#include "surface/octahedral.h"
#include "surface/patch.h"
#include "surface/reference.h"
#include "surface/tessellate.h"

// The specification of shaders/patches.comp: same operations in the same order.
namespace vasa {
namespace {

vec3 centreOf(const PosedNetwork& network, std::uint32_t seam) {
  const shared::ForkRing& ring = network.table.patches.seams[seam].ring;
  return vec3(bezierAt(network, ring.point, ring.spanClass).at(ring.t));
}

// How a direction moves with a ring, at its own size.
struct Turn {
  vec3 across, beside, third;  // the patch's frame at rest
  vec3 posedAcross, posedBeside, posedThird;
  vec3 swing;  // from its outward direction to the ring's, by the frame's turn alone
  float cosine, share;

  vec3 framed(vec3 d) const {
    return dotOf(d, across) * posedAcross + dotOf(d, beside) * posedBeside + dotOf(d, third) * posedThird;
  }
  vec3 of(vec3 d) const {
    const vec3 f = framed(d);
    return cosine * f + glm::cross(swing, f) + (share * dotOf(swing, f)) * swing;
  }
};

Turn turnOf(const PosedNetwork& network, const shared::PatchSeam& seam, vec3 outward) {
  const vec3 a = centreOf(network, seam.firstSeam), b = centreOf(network, seam.firstSeam + 1);
  const vec3 c = centreOf(network, seam.firstSeam + 2);
  Turn turn;
  turn.across = seam.across;
  turn.beside = seam.beside;
  turn.third = glm::cross(seam.across, seam.beside);
  const vec3 along = b - a, side = c - a;
  turn.posedAcross = unitOr(along, seam.across);
  const vec3 level = side - dotOf(side, turn.posedAcross) * turn.posedAcross;
  turn.posedBeside = unitOr(level, anyPerpendicular(turn.posedAcross));
  turn.posedThird = glm::cross(turn.posedAcross, turn.posedBeside);
  const vec3 framed = turn.framed(seam.outward);
  turn.swing = glm::cross(framed, outward);
  turn.cosine = dotOf(framed, outward);
  turn.share = 1.0f / std::max(1.0f + turn.cosine, 1e-3f);
  return turn;
}

shared::JointRows jointOf(const shared::PatchSeam& seam, const Section& section, const Turn& turn) {
  const float scale = section.radius / seam.radius;
  const auto moved = [&](vec3 d) {
    return turn.of(scale * d + ((1.0f - scale) * dotOf(seam.outward, d)) * seam.outward);
  };
  const vec3 x = moved({1, 0, 0}), y = moved({0, 1, 0}), z = moved({0, 0, 1});
  const vec3 t = section.centre - (seam.centre.x * x + seam.centre.y * y + seam.centre.z * z);
  return {vec4(x.x, y.x, z.x, t.x), vec4(x.y, y.y, z.y, t.y), vec4(x.z, y.z, z.z, t.z)};
}

// How many of the ring's edges lie beside the loop before its vertex k.
std::uint32_t edgesBefore(const PatchTable& table, const shared::PatchSeam& seam, std::uint32_t k,
                          std::uint32_t around) {
  if (k == seam.loopCount) return around;
  return std::min(std::uint32_t(table.shares[seam.loop + k] * float(around) + 0.5f), around);
}

std::vector<uvec3> stripOf(const PatchTable& table, const shared::PatchSeam& seam, const ForkSeam& order,
                           std::uint32_t around) {
  std::vector<uvec3> triangles;
  std::uint32_t before = 0;
  for (std::uint32_t k = 0; k < seam.loopCount; ++k) {
    const std::uint32_t loop = seam.loop + k, next = seam.loop + (k + 1) % seam.loopCount;
    std::uint32_t at = seam.vertex + order.direction(before % around, around);
    for (const std::uint32_t after = edgesBefore(table, seam, k + 1, around); before < after; ++before) {
      const std::uint32_t to = seam.vertex + order.direction((before + 1) % around, around);
      triangles.push_back({loop, to, at});
      at = to;
    }
    triangles.push_back({loop, next, at});
  }
  return triangles;
}

}  // namespace

PosedSeam poseSeam(const PosedNetwork& network, std::uint32_t index, std::uint32_t around) {
  const PatchTable& table = network.table.patches;
  const shared::PatchSeam& seam = table.seams[index];
  const vec3 chord(network.points[seam.ring.lastPoint] - network.points[seam.ring.firstPoint]);
  const quat* knots = &network.knotFrames[seam.ring.knot];
  const Section section = sectionAt(bezierAt(network, seam.ring.point, seam.ring.spanClass), chord, knots[0],
                                    knots[1], seam.ring.t);
  const Turn turn = turnOf(network, seam, seam.ring.turn * section.frame.tangent);
  PosedSeam posed{.joint = jointOf(seam, section, turn), .ring = {}, .strip = {}};
  const vec3 start = turn.of(seam.start);
  const vec2 wanted(dotOf(start, section.frame.u), dotOf(start, section.frame.v));
  const std::vector<vec2> directions = ringDirections(around);
  for (const vec2 direction : directions) posed.ring.push_back(surfacePoint(section, direction));
  posed.strip = stripOf(table, seam, {nearestOf(directions, wanted), seam.ring.turn < 0}, around);
  return posed;
}

SurfacePoint poseVertex(const shared::SkinVertex& vertex, std::span<const shared::JointRows> seams) {
  const std::uint32_t joints[] = {vertex.joints01 & 0xffffu, vertex.joints01 >> 16, vertex.joints23 & 0xffffu,
                                  vertex.joints23 >> 16};
  shared::JointRows m{vec4(0), vec4(0), vec4(0)};
  for (int i = 0; i < 4; ++i) {
    if (vertex.weights[i] == 0) continue;
    const shared::JointRows& joint = seams[joints[i]];
    m.row0 += vertex.weights[i] * joint.row0;
    m.row1 += vertex.weights[i] * joint.row1;
    m.row2 += vertex.weights[i] * joint.row2;
  }
  const vec4 place(vertex.x, vertex.y, vertex.z, 1), normal(unpackOctahedral(vertex.normal), 0);
  const vec3 turned(glm::dot(m.row0, normal), glm::dot(m.row1, normal), glm::dot(m.row2, normal));
  return {vec3(glm::dot(m.row0, place), glm::dot(m.row1, place), glm::dot(m.row2, place)),
          unitOr(turned, {0, 0, 1})};
}

}  // namespace vasa
