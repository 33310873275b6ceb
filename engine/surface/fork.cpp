#include "surface/fork.h"

#include <algorithm>
#include <cassert>
#include <cmath>

// The specification of shaders/lib/fork.glsl and forks.comp: same operations in the same order.
//
// With e the unit direction, at right angles to the trunk's axis, from it to where the branch's axis pierces the wall
// (at s = centre), the hole is the set of points
//   S(s, x) = C(s) + r(s) (√(1 − x²) u(s) + x v(s)),  s = centre + h_s sin φ,  x = h_x cos φ,
// where u(s) is e carried to s by one double reflection (Wang, Jüttler, Zheng, Liu 2008) and v = T × u. A collar curve
// is the cubic Bézier polygon H, H + k (X − H), P − k' w, P with H on the hole, X on a smaller, similar hole that
// stands for the corner between wall and branch, P on the branch's ring, w along the branch's wall.
namespace vasa {
namespace {

constexpr float kTiny2 = 1e-20f;
constexpr float kRound = 0.55f;  // of a quarter circle's control polygon

float dotOf(vec3 a, vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

vec3 unitOr(vec3 a, vec3 otherwise) {
  const float size2 = dotOf(a, a);
  return size2 > kTiny2 ? a / std::sqrt(size2) : otherwise;
}

Bezier bezierAt(const PosedNetwork& network, std::uint32_t point, std::uint32_t spanClass) {
  const mat4& m = spanClassMatrices()[spanClass];
  const vec4* d = &network.points[point];
  const auto row = [&](int i) { return m[0][i] * d[0] + m[1][i] * d[1] + m[2][i] * d[2] + m[3][i] * d[3]; };
  return {{row(0), row(1), row(2), row(3)}};
}

struct Ring {
  Section section;
  vec4 derivative;  // of its vessel, d/dt
  float turn;
};

Ring ringOf(const PosedNetwork& network, const shared::ForkRing& ring) {
  const vec3 chord(network.points[ring.lastPoint] - network.points[ring.firstPoint]);
  const Bezier bezier = bezierAt(network, ring.point, ring.spanClass);
  const quat* knots = &network.knotFrames[ring.knot];
  return {sectionAt(bezier, chord, knots[0], knots[1], ring.t), bezier.derivative(ring.t), ring.turn};
}

// The end of the trunk's control polygon beside a ring; its radius stays within a factor.
vec4 innerPoint(const Ring& ring, float thirdScale) {
  const vec4 moved = vec4(ring.section.centre, ring.section.radius) + thirdScale * ring.derivative;
  return vec4(vec3(moved), std::clamp(moved.w, 0.5f * ring.section.radius, 2.0f * ring.section.radius));
}

struct Trunk {
  Bezier bezier;
  vec3 chord;

  // Without a frame yet.
  Section at(float s) const {
    const vec4 point = bezier.at(s), first = bezier.derivative(s);
    const vec3 velocity(first), acceleration(bezier.secondDerivative(s));
    Section section;
    section.centre = vec3(point);
    section.radius = std::max(point.w, 0.0f);
    section.frame.tangent = unitOr(velocity, unitOr(chord, {0, 0, 1}));
    const float speed2 = dotOf(velocity, velocity);
    if (speed2 > kTiny2) {
      const vec3& tangent = section.frame.tangent;
      section.slope = first.w / std::sqrt(speed2);
      section.curvature = (acceleration - dotOf(acceleration, tangent) * tangent) / speed2;
    }
    return section;
  }
};

// A direction carried from one section to another by double reflection, made perpendicular to the tangent there.
vec3 carried(vec3 u, vec3 from, vec3 fromTangent, vec3 to, vec3 toTangent) {
  const vec3 v1 = to - from;
  const float c1 = dotOf(v1, v1);
  vec3 tangent = fromTangent;
  if (c1 > kTiny2) {
    const float scale = 2.0f / c1;
    const float along = scale * dotOf(v1, u), alongTangent = scale * dotOf(v1, tangent);
    u = u - along * v1;
    tangent = tangent - alongTangent * v1;
  }
  const vec3 v2 = toTangent - tangent;
  const float c2 = dotOf(v2, v2);
  if (c2 > 1e-12f) {
    const float along = (2.0f / c2) * dotOf(v2, u);
    u = u - along * v2;
  }
  u = u - dotOf(u, toTangent) * toTangent;
  return unitOr(u, anyPerpendicular(toTangent));
}

void setFrame(Section& section, vec3 u) {
  section.frame.u = u;
  section.frame.v = glm::cross(section.frame.tangent, u);
}

vec2 turned(vec2 a, vec2 b) {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

// The ring's vertex nearest to a direction.
ForkSeam seamAt(const Ring& ring, vec3 direction, std::span<const vec2> directions) {
  const vec2 d(dotOf(direction, ring.section.frame.u), dotOf(direction, ring.section.frame.v));
  ForkSeam seam{0, ring.turn < 0};
  float best = -3e38f;
  for (std::uint32_t k = 0; k < directions.size(); ++k) {
    const float along = d.x * directions[k].x + d.y * directions[k].y;
    if (along > best) best = along, seam.first = k;
  }
  return seam;
}

struct Wall {
  const Trunk& trunk;
  Section middle;  // with the hole's direction as its u

  Section sectionTowards(float s) const {
    Section section = trunk.at(s);
    setFrame(section, carried(middle.frame.u, middle.centre, middle.frame.tangent, section.centre, section.frame.tangent));
    return section;
  }
};

// One curve of the collar.
struct CollarCurve {
  vec3 h, h1, p1, p;       // control polygon
  vec3 aroundH, aroundP;   // d/dφ at its ends

  SurfacePoint at(float t) const {
    const float s = 1 - t;
    const vec3 position = (s * s * s) * h + (3 * s * s * t) * h1 + (3 * s * t * t) * p1 + (t * t * t) * p;
    const vec3 along = (s * s) * (h1 - h) + (2 * s * t) * (p1 - h1) + (t * t) * (p - p1);
    const vec3 normal = glm::cross(s * aroundH + t * aroundP, along);
    return {position, unitOr(normal, {0, 0, 1})};
  }
};

}  // namespace

std::uint32_t forkWindow(const shared::ForkRecord& fork, std::uint32_t around) {
  if (fork.hasBranch == 0) return 0;
  return std::clamp(std::uint32_t(std::ceil(fork.window * float(around))), 1u, around - 1);
}

ForkSeams evaluateFork(const PosedNetwork& network, const shared::ForkRecord& fork, const ForkShape& shape,
                       std::span<SurfacePoint> vertices) {
  assert(vertices.size() == shape.vertices());
  const std::vector<vec2> columns = ringDirections(shape.a);
  const Ring a = ringOf(network, fork.a), b = ringOf(network, fork.b);
  const vec4 endA(a.section.centre, a.section.radius), endB(b.section.centre, b.section.radius);
  const Trunk trunk{{{endA, innerPoint(a, fork.scaleA / 3.0f), innerPoint(b, -(fork.scaleB / 3.0f)), endB}},
                    b.section.centre - a.section.centre};
  const vec3 tangentA = a.turn * a.section.frame.tangent, tangentB = b.turn * b.section.frame.tangent;

  // The direction of the hole, and of the column at the window's left edge.
  Wall wall{trunk, trunk.at(fork.centre)};
  const vec3 tangent = wall.middle.frame.tangent;
  vec3 towards;
  vec2 edge(1, 0);
  if (fork.hasBranch != 0) {
    const Bezier branch = bezierAt(network, fork.crossPoint, fork.crossClass);
    const vec3 out = vec3(branch.at(fork.crossT)) - wall.middle.centre;
    towards = unitOr(out - dotOf(out, tangent) * tangent, anyPerpendicular(tangent));
    const vec2 back = glm::vec2(1, -1) * ringDirections(2 * shape.a)[1];
    for (std::uint32_t i = forkWindow(fork, shape.a); i > 0; --i) edge = turned(edge, back);
  } else {
    towards = carried(a.section.frame.u, a.section.centre, tangentA, wall.middle.centre, tangent);
  }
  setFrame(wall.middle, towards);

  ForkSeams seams;
  const auto ringRow = [&](const Ring& ring, vec3 ringTangent, std::uint32_t row) {
    const std::uint32_t around = shape.rowSize(row);
    const std::vector<vec2> directions = ringDirections(around);
    const vec3 u = carried(towards, wall.middle.centre, tangent, ring.section.centre, ringTangent);
    const vec3 direction = edge.x * u + edge.y * glm::cross(ringTangent, u);
    const ForkSeam seam = seamAt(ring, direction, directions);
    for (std::uint32_t k = 0; k < around; ++k)
      vertices[shape.rowStart(row) + k] = surfacePoint(ring.section, directions[seam.direction(k, around)]);
    return seam;
  };
  seams.a = ringRow(a, tangentA, 0);
  seams.b = ringRow(b, tangentB, shared::kTrunkRows - 1);
  const float inner[] = {fork.row1, fork.centre, fork.row3};
  for (std::uint32_t row = 1; row + 1 < shared::kTrunkRows; ++row) {
    const Section section = wall.sectionTowards(inner[row - 1]);
    for (std::uint32_t k = 0; k < shape.a; ++k)
      vertices[shape.rowStart(row) + k] = surfacePoint(section, turned(edge, columns[k]));
  }
  if (fork.hasBranch == 0) return seams;

  const Ring branch = ringOf(network, fork.branch);
  const vec3 outward = branch.turn * branch.section.frame.tangent;
  const vec3 sum = towards + outward;
  const float fold = std::max(1.0f + dotOf(towards, outward), 1e-3f);
  const vec3 across = wall.middle.frame.v - (dotOf(wall.middle.frame.v, sum) / fold) * sum;  // turned with towards → outward
  const std::uint32_t around = shape.branch;
  const std::vector<vec2> directions = ringDirections(around);
  seams.branch = seamAt(branch, across, directions);
  for (std::uint32_t k = 0; k < around; ++k) {
    const vec2 polar = directions[k];
    const float x = fork.holeAround * polar.x, depth = std::sqrt(1.0f - x * x);
    const Section section = wall.sectionTowards(fork.centre + fork.holeAlong * polar.y);
    const SurfacePoint hole = surfacePoint(section, {depth, x});
    const float cornerX = x / (1.0f + shared::kFillet);
    const Section corner = wall.sectionTowards(fork.centre + (fork.holeAlong / (1.0f + shared::kFillet)) * polar.y);
    const vec3 chord = surfacePoint(corner, {std::sqrt(1.0f - cornerX * cornerX), cornerX}).position - hole.position;
    const vec3 inwards = chord - dotOf(chord, hole.normal) * hole.normal;

    const vec2 direction = directions[seams.branch.direction(k, around)];
    const SurfacePoint end = surfacePoint(branch.section, direction);
    const vec3 d = direction.x * branch.section.frame.u + direction.y * branch.section.frame.v;
    const float bend = std::max(1.0f - branch.section.radius * dotOf(branch.section.curvature, d), 0.1f);
    const vec3 ruling = unitOr(bend * outward + (branch.turn * branch.section.slope) * d, outward);
    const vec3 reach = end.position - (hole.position + inwards);
    const float rise = std::max(dotOf(reach, ruling), 0.35f * std::sqrt(dotOf(reach, reach)));

    CollarCurve curve;
    curve.h = hole.position;
    curve.h1 = hole.position + kRound * inwards;
    curve.p1 = end.position - (kRound * rise) * ruling;
    curve.p = end.position;
    const float slide = fork.holeAround * polar.y;  // -dx/dφ
    const vec3 sideways = (slide * x / depth) * section.frame.u - slide * section.frame.v;
    const vec3 velocity(trunk.bezier.derivative(fork.centre + fork.holeAlong * polar.y));
    curve.aroundH = section.radius * sideways + (fork.holeAlong * polar.x) * velocity;
    curve.aroundP = (branch.turn * branch.section.radius) *
                    (direction.x * branch.section.frame.v - direction.y * branch.section.frame.u);
    vertices[shape.rowStart(kHoleRow) + k] = hole;
    for (std::uint32_t row = 1; row < shared::kCollarRows; ++row)
      vertices[shape.rowStart(kHoleRow + row) + k] = curve.at(float(row) / float(shared::kCollarRows));
    vertices[shape.rowStart(kBranchRow) + k] = end;
  }
  return seams;
}

}  // namespace vasa
