#include "surface/fork.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "surface/fork_smooth.h"
#include "surface/fork_stump.h"
#include "surface/reference.h"

// The specification of shaders/lib/fork.glsl and forks.comp: same operations in the same order.
//
// With u(s) a direction of ring a carried to the trunk's middle and from there to s, each time by one double
// reflection (Wang, Jüttler, Zheng, Liu 2008), v = T × u, and (c, d) the hole's direction in that frame, the
// hole is
//   S(s, x) = C(s) + r(s) (c' u(s) + d' v(s)),  (c', d') = (c, d) turned by (√(1 − x²), x),
//   s = centre + h_s sin φ,  x = h_x cos φ.
// A collar curve is the cubic Bézier polygon H, H + k (X − H), P − k' w, P with H on the hole, X on a
// smaller, similar hole that stands for the corner between wall and branch, P on the branch's ring, w along
// the branch's wall.
namespace vasa {
namespace {

constexpr float kRound = 0.55f;  // of a quarter circle's control polygon
constexpr float kDense = 0.4f;   // rows of the collar beside the hole, against even ones

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

// A direction carried from one section to another by double reflection, made perpendicular to the tangent
// there.
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

vec2 turned(vec2 a, vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }

ForkSeam seamAt(const Ring& ring, vec3 direction, std::span<const vec2> directions) {
  const vec2 d(dotOf(direction, ring.section.frame.u), dotOf(direction, ring.section.frame.v));
  return {nearestOf(directions, d), ring.turn < 0};
}

struct Wall {
  const Trunk& trunk;
  Section middle;

  Section sectionAt(float s) const {
    Section section = trunk.at(s);
    setFrame(section, carried(middle.frame.u, middle.centre, middle.frame.tangent, section.centre,
                              section.frame.tangent));
    return section;
  }
};

// (cos, sin) of half the angle of so many columns.
vec2 halfAngleOf(std::uint32_t columns, std::uint32_t around) {
  const vec2 half = ringDirections(2 * around)[1];
  vec2 angle(1, 0);
  for (std::uint32_t i = 0; i < columns; ++i) angle = turned(angle, half);
  return angle;
}

vec2 against(vec2 a) { return {a.x, -a.y}; }

// Where the hole's middle lies, in the trunk's frame: as wanted, or the nearest direction that keeps it in
// its window.
vec2 holeDirection(const shared::ForkBranch& branch, vec2 wanted, vec2 windowMiddle, vec2 windowHalf) {
  const vec2 off = turned(wanted, against(windowMiddle));
  // Cos and sin of how far it may be off.
  const vec2 room = turned(windowHalf, {branch.holdCos, -branch.holdSin});
  if (room.y <= 0) return windowMiddle;
  if (off.x >= room.x) return wanted;
  return turned(windowMiddle, {room.x, off.y < 0 ? -room.y : room.y});
}

// Denser towards the hole, where the curve turns.
float collarParameter(std::uint32_t row) {
  const float share = float(row) / float(shared::kCollarRows);
  return share * (kDense + (1.0f - kDense) * share);
}

// One curve of the collar.
struct CollarCurve {
  vec3 h, h1, p1, p;      // control polygon
  vec3 aroundH, aroundP;  // d/dφ at its ends

  SurfacePoint at(float t) const {
    const float s = 1 - t;
    const vec3 position = (s * s * s) * h + (3 * s * s * t) * h1 + (3 * s * t * t) * p1 + (t * t * t) * p;
    const vec3 along = (s * s) * (h1 - h) + (2 * s * t) * (p1 - h1) + (t * t) * (p - p1);
    const vec3 normal = glm::cross(s * aroundH + t * aroundP, along);
    return {position, unitOr(normal, {0, 0, 1})};
  }
};

// A branch's hole and collar.
class Collar {
 public:
  Collar(const Wall& wall, const shared::ForkBranch& branch, vec2 direction, const Ring& ring)
      : wall_(wall), branch_(branch), direction_(direction), ring_(ring) {}

  ForkSeam write(const ForkShape& shape, std::uint32_t index, std::span<SurfacePoint> vertices) const {
    const std::uint32_t around = shape.branch[index];
    const std::vector<vec2> directions = ringDirections(around);
    const ForkSeam seam = seamAt(ring_, across(), directions);
    for (std::uint32_t k = 0; k < around; ++k) {
      const vec2 direction = directions[seam.direction(k, around)];
      const SurfacePoint end = surfacePoint(ring_.section, direction);
      SurfacePoint hole;
      const CollarCurve curve = curveAt(directions[k], direction, end, hole);
      vertices[shape.rowStart(holeRow(index)) + k] = hole;
      for (std::uint32_t row = 1; row < shared::kCollarRows; ++row)
        vertices[shape.rowStart(holeRow(index) + row) + k] = curve.at(collarParameter(row));
      vertices[shape.rowStart(branchRow(index)) + k] = end;
    }
    return seam;
  }

 private:
  // The hole's first direction, turned as the branch is turned away from the wall.
  vec3 across() const {
    const Section at = wall_.sectionAt(branch_.centre);
    const vec3 towards = direction_.x * at.frame.u + direction_.y * at.frame.v;
    const vec3 side = direction_.x * at.frame.v - direction_.y * at.frame.u;
    const vec3 outward = ring_.turn * ring_.section.frame.tangent;
    const vec3 sum = towards + outward;
    const float fold = std::max(1.0f + dotOf(towards, outward), 1e-3f);
    return side - (dotOf(side, sum) / fold) * sum;
  }

  CollarCurve curveAt(vec2 polar, vec2 direction, const SurfacePoint& end, SurfacePoint& hole) const {
    const Section& branch = ring_.section;
    const vec3 outward = ring_.turn * branch.frame.tangent;
    const float x = branch_.holeAround * polar.x, depth = std::sqrt(1.0f - x * x);
    const float s = branch_.centre + branch_.holeAlong * polar.y;
    const Section section = wall_.sectionAt(s);
    hole = surfacePoint(section, turned(direction_, {depth, x}));
    const float cornerX = branch_.cornerAround * x, cornerDepth = std::sqrt(1.0f - cornerX * cornerX);
    const float cornerS = branch_.centre + (branch_.cornerAlong * branch_.holeAlong) * polar.y;
    const SurfacePoint corner =
        surfacePoint(wall_.sectionAt(cornerS), turned(direction_, {cornerDepth, cornerX}));
    const vec3 chord = corner.position - hole.position;
    const vec3 inwards = chord - dotOf(chord, hole.normal) * hole.normal;

    const vec3 d = direction.x * branch.frame.u + direction.y * branch.frame.v;
    const float bend = std::max(1.0f - branch.radius * dotOf(branch.curvature, d), 0.1f);
    const vec3 ruling = unitOr(bend * outward + (ring_.turn * branch.slope) * d, outward);
    const vec3 reach = end.position - (hole.position + inwards);
    const float rise = std::max(dotOf(reach, ruling), 0.35f * std::sqrt(dotOf(reach, reach)));

    CollarCurve curve;
    curve.h = hole.position;
    curve.h1 = hole.position + kRound * inwards;
    curve.p1 = end.position - (kRound * rise) * ruling;
    curve.p = end.position;
    const float slide = -(branch_.holeAround * polar.y);  // dx/dφ
    const vec2 sideways = turned(direction_, {-(slide * x / depth), slide});
    const vec3 velocity(wall_.trunk.bezier.derivative(s));
    curve.aroundH = section.radius * (sideways.x * section.frame.u + sideways.y * section.frame.v) +
                    (branch_.holeAlong * polar.x) * velocity;
    curve.aroundP =
        (ring_.turn * branch.radius) * (direction.x * branch.frame.v - direction.y * branch.frame.u);
    return curve;
  }

  const Wall& wall_;
  const shared::ForkBranch& branch_;
  vec2 direction_;
  const Ring& ring_;
};

}  // namespace

std::uint32_t windowColumns(const shared::ForkBranch& branch, std::uint32_t branchCount,
                            std::uint32_t around) {
  const auto wanted = std::uint32_t(std::ceil(branch.window * float(around) + 1.0f));
  return std::min(wanted, branchCount > 1 ? around / branchCount : around - 1);
}

ForkLayout evaluateFork(const PosedNetwork& network, const shared::ForkRecord& fork, const ForkShape& shape,
                        std::span<SurfacePoint> vertices, const ForkSteps* fixed, bool turns) {
  assert(vertices.size() == shape.vertices());
  ForkStumps stumps;
  const std::vector<vec2> columns = ringDirections(shape.a), ringB = ringDirections(shape.b);
  const Ring a = ringOf(network, fork.a), b = ringOf(network, fork.b);
  const vec4 endA(a.section.centre, a.section.radius), endB(b.section.centre, b.section.radius);
  const Trunk trunk{{{endA, innerPoint(a, fork.scaleA / 3.0f), innerPoint(b, -(fork.scaleB / 3.0f)), endB}},
                    b.section.centre - a.section.centre};
  const vec3 tangentA = a.turn * a.section.frame.tangent, tangentB = b.turn * b.section.frame.tangent;
  Wall wall{trunk, trunk.at(fork.row2)};
  const vec3 tangent = wall.middle.frame.tangent;
  setFrame(wall.middle, carried(a.section.frame.u, a.section.centre, tangentA, wall.middle.centre, tangent));

  ForkLayout layout;
  layout.a = {0, a.turn < 0};
  for (std::uint32_t k = 0; k < shape.a; ++k)
    vertices[k] = surfacePoint(a.section, columns[layout.a.direction(k, shape.a)]);
  const float inner[] = {fork.row1, fork.row2, fork.row3};
  for (std::uint32_t row = 1; row + 1 < shared::kTrunkRows; ++row) {
    const Section section = wall.sectionAt(inner[row - 1]);
    for (std::uint32_t k = 0; k < shape.a; ++k)
      vertices[shape.rowStart(row) + k] = surfacePoint(section, columns[k]);
  }
  layout.b =
      seamAt(b, carried(wall.middle.frame.u, wall.middle.centre, tangent, b.section.centre, tangentB), ringB);
  for (std::uint32_t k = 0; k < shape.b; ++k)
    vertices[shape.rowStart(shared::kTrunkRows - 1) + k] =
        surfacePoint(b.section, ringB[layout.b.direction(k, shape.b)]);

  for (std::uint32_t i = 0; i < fork.branchCount; ++i) {
    const shared::ForkBranch& branch = network.table.branches[fork.firstBranch + i];
    const Section at = wall.sectionAt(branch.centre);
    const vec3 out =
        vec3(bezierAt(network, branch.crossPoint, branch.crossClass).at(branch.crossT)) - at.centre;
    const vec3 towards = unitOr(out - dotOf(out, at.frame.tangent) * at.frame.tangent, at.frame.u);
    const vec2 wanted(dotOf(towards, at.frame.u), dotOf(towards, at.frame.v));
    ForkWindow& window = layout.window[i];
    window.count = windowColumns(branch, fork.branchCount, shape.a);
    const vec2 half = halfAngleOf(window.count, shape.a);
    window.first = nearestOf(columns, turned(wanted, against(half)));
    if (i > 0) {  // beside the first one's
      const ForkWindow& other = layout.window[0];
      const std::uint32_t behind = (window.first + shape.a - other.first) % shape.a;
      const std::uint32_t least = other.count, most = shape.a - window.count;
      // Out of reach on either side: to the nearer one.
      if (behind < least)
        window.first = (other.first + (2 * behind < other.count ? most : least)) % shape.a;
      else if (behind > most)
        window.first = (other.first + most) % shape.a;
    }
    const vec2 direction = holeDirection(branch, wanted, turned(columns[window.first], half), half);
    window.hole = direction;
    window.wide = branch.holeAround;
    window.rows = (vec3(fork.row1, fork.row2, fork.row3) - branch.centre) / branch.holeAlong;
    const Ring ring = ringOf(network, branch.ring);
    layout.branch[i] = Collar(wall, branch, direction, ring).write(shape, i, vertices);
    stumps.branch[i] = {ring.section, -ring.turn * ring.section.frame.tangent, at.centre};
  }
  if (fixed) {
    layout.steps = *fixed;
    smoothParts(shape, layout, vertices);
  } else {
    layout.steps = smoothFolds(shape, layout, vertices, turns);
    stumps.a = {a.section, tangentA, b.section.centre};
    stumps.b = {b.section, -tangentB, a.section.centre};
    stumps.replaceFolds(shape, layout, vertices, turns);
  }
  return layout;
}

}  // namespace vasa
