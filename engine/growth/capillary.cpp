#include "growth/capillary.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "growth/random.h"

// The specification of shaders/lib/growth.glsl: same operations in the same order.
//
// All happens in the axes of the section that the bed moves with, from the bed's centre. A curve leaves the
// way its parent goes there, half turned to where it is bound, and comes there nearly straight; both strays
// are random (meander) or along the bed (fibre). Points of its polygon beyond a wall are drawn in towards the
// centre: walls bound a convex piece of the tissue, which holds the curve with them.
//
// Which part of the box a branch has is decided in the box' own measure, where no pose and no rounding of one
// changes it.
namespace vasa {
namespace {

using shared::GrowthBed;
using shared::GrowthChild;
using shared::GrowthStem;
using shared::GrowthSymbol;

constexpr float kTiny2 = 1e-12f;
constexpr float kLead = 0.8f;    // of the parent's direction beside the way's, at a curve's begin
constexpr float kJitter = 0.9f;  // of half a part: how far its middle strays
constexpr float kApart = 0.4f;   // of half a part: from there to where artery and vein branch

vec3 unitOr(vec3 v, vec3 otherwise) {
  const float length2 = glm::dot(v, v);
  return length2 > kTiny2 ? v / std::sqrt(length2) : otherwise;
}

vec3 signedVector(std::uint32_t key, std::uint32_t first) {
  return {signedOf(key, first), signedOf(key, first + 1), signedOf(key, first + 2)};
}

// A part of a bed's box, in half sides of the box.
struct Part {
  vec3 centre, size;
};

// The i-th of n equal parts, the first ones on the side of `entry`. Cut across the longest side, again and
// again.
Part partOf(const GrowthBed& bed, Part part, vec3 entry, std::uint32_t n, std::uint32_t i) {
  while (n > 1) {
    int longest = 0;
    for (int a = 1; a < 3; ++a)
      if (part.size[a] * bed.side[a].w > part.size[longest] * bed.side[longest].w) longest = a;
    const std::uint32_t near = (n + 1) / 2;
    const float share = float(near) / float(n), size = part.size[longest];
    const float towards = entry[longest] < part.centre[longest] ? -size : size;
    if (i < near) {
      part.centre[longest] += towards * (1 - share);
      part.size[longest] = size * share;
      n = near;
    } else {
      part.centre[longest] -= towards * share;
      part.size[longest] = size * (1 - share);
      i -= near;
      n -= near;
    }
  }
  return part;
}

// A place drawn in towards the centre as far as the walls ask for.
vec3 keptInside(const GrowthBed& bed, vec3 place) {
  float share = 1;
  for (const vec4& wall : bed.wall) {
    const float along = glm::dot(vec3(wall), place);
    if (along > wall.w) share = std::min(share, wall.w / along);
  }
  return share * place;
}

vec3 inBox(const GrowthBed& bed, vec3 p) {
  return p.x * bed.side[0].w * vec3(bed.side[0]) + p.y * bed.side[1].w * vec3(bed.side[1]) +
         p.z * bed.side[2].w * vec3(bed.side[2]);
}

// Where the curve to a part ends: leaves of both trees at one place, others to one side of it or the other.
vec3 endIn(const GrowthBed& bed, const Part& part, std::uint32_t key, float apart) {
  return keptInside(bed, inBox(bed, part.centre + part.size * (kJitter * signedVector(key, 0) +
                                                               apart * signedVector(key, 3))));
}

// What a curve starts from.
struct Bud {
  vec3 place, direction;
  float radius;
};

vec3 strayed(const GrowthSymbol& symbol, const GrowthBed& bed, vec3 v, vec3 way, std::uint32_t key,
             std::uint32_t first) {
  const vec3 fibre(bed.side[0]);
  return unitOr(v + symbol.meander * signedVector(key, first) + (symbol.fibre * glm::dot(fibre, way)) * fibre,
                way);
}

Bezier drawn(const GrowthSymbol& symbol, const GrowthBed& bed, const Bud& bud, vec3 end, std::uint32_t key) {
  const vec3 reach = end - bud.place;
  const float third = std::sqrt(glm::dot(reach, reach)) / 3;
  const vec3 way = unitOr(reach, bud.direction);
  const vec3 from = strayed(symbol, bed, kLead * bud.direction + way, way, key, 6),
             to = strayed(symbol, bed, way, way, key, 9);
  const float thinner = symbol.taper - 1;
  Bezier curve;
  curve.b[0] = vec4(bud.place, bud.radius);
  curve.b[1] = vec4(keptInside(bed, bud.place + third * from), bud.radius * (1 + thinner * (1.0f / 3)));
  curve.b[2] = vec4(keptInside(bed, end - third * to), bud.radius * (1 + thinner * (2.0f / 3)));
  curve.b[3] = vec4(end, bud.radius * (1 + thinner));
  return curve;
}

mat3 axesOf(const Section& section) { return {section.frame.u, section.frame.v, section.frame.tangent}; }

vec3 within(const mat3& axes, vec3 v) {
  return {glm::dot(axes[0], v), glm::dot(axes[1], v), glm::dot(axes[2], v)};
}

// Where the stem begins, in the bed's measure.
Bud rootOf(const GrowthScene& scene, const GrowthStem& stem, std::uint32_t side, const mat3& axes,
           vec3 origin) {
  if (stem.from == shared::kFromVessel) {
    const Section root = sectionOn(scene.network, scene.spans[stem.span], stem.t);
    return {within(axes, root.centre - origin), within(axes, axesOf(root) * stem.leaving), stem.radius};
  }
  const GrowthBed& before = scene.beds[stem.from];
  const Section section = sectionOn(scene.network, scene.spans[before.span], before.t);
  const mat3 turn = axesOf(section);
  const vec3 place = section.centre + turn * (before.centre + before.stem[side].end);
  return {within(axes, place - origin), within(axes, turn * before.stem[side].through), stem.radius};
}

// From the root to the stem's end.
Bezier stemOf(const GrowthStem& stem, const Bud& bud) {
  const vec3 reach = stem.end - bud.place;
  const float third = std::sqrt(glm::dot(reach, reach)) / 3, thinner = stem.last - stem.radius;
  const vec3 from = unitOr(kLead * bud.direction + unitOr(reach, bud.direction), bud.direction);
  Bezier curve;
  curve.b[0] = vec4(bud.place, stem.radius);
  curve.b[1] = vec4(bud.place + third * from, stem.radius + thinner * (1.0f / 3));
  curve.b[2] = vec4(stem.end - third * stem.through, stem.radius + thinner * (2.0f / 3));
  curve.b[3] = vec4(stem.end, stem.last);
  return curve;
}

}  // namespace

vec3 bedCentre(const PosedNetwork& network, std::span<const shared::SweepRecord> spans,
               const GrowthBed& bed) {
  const Section section = sectionOn(network, spans[bed.span], bed.t);
  return section.centre + axesOf(section) * bed.centre;
}

Capillary capillaryAt(const GrowthScene& scene, std::uint32_t number, BedSide bedSide, std::uint32_t levels,
                      std::uint32_t curve, bool sparse) {
  assert(levels > 0);
  const GrowthBed& bed = scene.beds[number];
  const std::uint32_t side = bedSide == BedSide::vein;
  const GrowthStem& stem = bed.stem[side];
  const Section section = sectionOn(scene.network, scene.spans[bed.span], bed.t);
  const mat3 axes = axesOf(section);
  const vec3 centre = section.centre + axes * bed.centre;
  Capillary capillary{.symbol = scene.tables.system[bed.system].axiom};
  Bezier& drawnCurve = capillary.curve;
  drawnCurve = stemOf(stem, rootOf(scene, stem, side, axes, centre));
  std::uint32_t key = keyOf(scene.seed, number);  // of the part: the same for both trees
  Part part{bed.middle, vec3(1)};
  vec3 entry = bed.entry;
  float radius = stem.own;
  for (;;) {
    const GrowthSymbol& symbol = scene.tables.symbol[capillary.symbol];
    capillary.leaf = --levels == 0 || symbol.childCount == 0;
    if (curve == 0 || capillary.leaf) break;
    --curve;
    std::uint32_t branch = 0;
    if (sparse && levels == 1)
      branch = 2 * std::exchange(curve, 0);
    else
      for (; branch + 1 < symbol.childCount; ++branch) {
        const GrowthSymbol& next = scene.tables.symbol[scene.tables.child[symbol.firstChild + branch].symbol];
        const std::uint32_t size = treeSize(next, levels, sparse);
        if (curve < size) break;
        curve -= size;
      }
    const GrowthChild& child = scene.tables.child[symbol.firstChild + branch];
    const vec3 before = part.centre;
    part = partOf(bed, part, entry, symbol.childCount, branch);
    entry = before;
    key = keyOf(key, branch);
    const GrowthSymbol& own = scene.tables.symbol[child.symbol];
    const bool last = levels == 1 || own.childCount == 0;
    const Bud bud{vec3(drawnCurve.at(child.at)), unitOr(vec3(drawnCurve.derivative(child.at)), vec3(0, 0, 1)),
                  radius * child.radius};
    const vec3 end = endIn(bed, part, key, last ? 0 : side ? -kApart : kApart);
    capillary.phase += (1 - capillary.phase) * 0.5f * child.at;
    drawnCurve = drawn(own, bed, bud, end, keyOf(key, 0x100u + side));
    if (sparse && levels == 1)
      for (vec4& b : drawnCurve.b)
        b.w *= float(symbol.childCount) / float(shared::sparseOf(symbol.childCount));
    radius = bud.radius;
    capillary.symbol = child.symbol;
    ++capillary.generation;
  }
  capillary.lastPhase = capillary.leaf ? 1 : capillary.phase + (1 - capillary.phase) * 0.5f;
  for (vec4& b : drawnCurve.b) b = vec4(centre + axes * vec3(b), b.w);
  const vec3 outward = axes * vec3(bed.surface);
  capillary.skin = vec4(-outward, bed.surface.w + glm::dot(outward, centre));
  return capillary;
}

}  // namespace vasa
