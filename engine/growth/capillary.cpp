#include "growth/capillary.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "growth/random.h"

// The specification of shaders/lib/growth.glsl: same operations in the same order.
//
// A curve is a walk of three steps, which are the legs of its Bézier polygon. The first goes the way that the
// branching asks for; before each of the others the direction strays (meander), turns (curl), and yields to
// its surroundings: to the limb's axis, away from or around the hub, back from the skin. Every pull is
// continuous in the curve's place, so that a moving vessel's capillaries move smoothly. Points of the polygon
// that got beyond the ball or a wall all the same are drawn in towards the centre: ball and walls bound a
// convex piece of the body, which holds the curve with them.
namespace vasa {
namespace {

using shared::GrowthChild;
using shared::GrowthSymbol;

constexpr float kRootDepth = 0.5f;      // in radii from the axis: inside of the coarsest tube of quads, too
constexpr std::uint32_t kPartners = 8;  // sprouts of the partner that are looked at
constexpr float kTiny2 = 1e-12f;

// The surroundings of a tree, in the world.
struct Surroundings {
  vec3 hub, axis, centre;
  float shell;  // [m] from the hub to the root
  float reach;
  std::array<vec4, shared::kGrowthWalls> walls;  // offsets count from the centre
};

Surroundings surroundingsOf(const shared::GrowthSite& site, const Section& section) {
  const mat3 axes(section.frame.u, section.frame.v, section.frame.tangent);
  Surroundings around{section.centre + axes * site.hub, axes * site.axis, section.centre, 0, site.reach, {}};
  around.shell = glm::distance(around.hub, section.centre);
  for (std::size_t i = 0; i < around.walls.size(); ++i)
    around.walls[i] = vec4(axes * vec3(site.wall[i]), site.wall[i].w);
  return around;
}

// A place drawn in towards the centre as far as ball and walls ask for.
vec3 keptInside(const Surroundings& around, vec3 place) {
  const vec3 arm = place - around.centre;
  const float length = glm::length(arm);
  float share = length > around.reach ? around.reach / length : 1;
  for (const vec4& wall : around.walls) {
    const float along = glm::dot(vec3(wall), arm);
    if (along > wall.w) share = std::min(share, wall.w / along);
  }
  return share < 1 ? around.centre + share * arm : place;
}

// What a curve starts from.
struct Bud {
  vec3 place, direction;
  float radius, stretch;
};

vec3 unitOr(vec3 v, vec3 otherwise) {
  const float length2 = glm::dot(v, v);
  return length2 > kTiny2 ? v / std::sqrt(length2) : otherwise;
}

// A unit vector at right angles to the unit vector `direction`, and to `outward` if that is another.
vec3 sideways(vec3 outward, vec3 direction) {
  const vec3 side = glm::cross(outward, direction);
  const float length2 = glm::dot(side, side);
  return length2 > 1e-6f ? side / std::sqrt(length2) : anyPerpendicular(direction);
}

vec3 bent(const GrowthSymbol& symbol, const Surroundings& around, vec3 place, vec3 direction, float step,
          std::uint32_t key, std::uint32_t leg) {
  const vec3 arm = place - around.hub;
  const vec3 outward = unitOr(arm, direction);
  const float height = glm::dot(arm, outward);
  const vec3 side = sideways(outward, direction), other = glm::cross(direction, side);
  const float turn = symbol.curl * (key & 1u ? 1.0f : -1.0f) + symbol.meander * signedOf(key, 2 * leg);
  vec3 v = direction + turn * side + (symbol.meander * signedOf(key, 2 * leg + 1)) * other;
  v += (symbol.along + symbol.fibre * glm::dot(around.axis, direction)) * around.axis;
  const float back = std::clamp((around.shell - height) / (3 * step), -1.0f, 1.0f);
  v += (symbol.outward + symbol.hug * (back - glm::dot(v, outward))) * outward;
  v = unitOr(v, direction);
  for (const vec4& wall : around.walls) {
    const float over = glm::dot(vec3(wall), place + step * v - around.centre) - wall.w;
    if (over > 0) v = unitOr(v - std::min(over / step, 2.0f) * vec3(wall), direction);
  }
  return v;
}

// Draws a letter as a curve; `direction` comes out as the curve's last one.
Bezier grown(const GrowthSymbol& symbol, const Surroundings& around, const Bud& bud, std::uint32_t key) {
  const float length = symbol.reach * bud.stretch * bud.radius * (1 + symbol.reachSpread * signedOf(key, 0));
  const float step = length / 3;
  Bezier curve;
  vec3 place = bud.place, direction = bud.direction;
  curve.b[0] = vec4(place, bud.radius);
  for (std::uint32_t leg = 1; leg <= 3; ++leg) {
    if (leg > 1) direction = bent(symbol, around, place, direction, step, key, leg);
    place = keptInside(around, place + step * direction);
    curve.b[leg] = vec4(place, bud.radius * (1 + (symbol.taper - 1) * (float(leg) / 3)));
  }
  return curve;
}

Bud budOf(const GrowthChild& child, const Surroundings& around, const Bezier& parent, std::uint32_t key) {
  const vec3 place(parent.at(child.at));
  const vec3 tangent = unitOr(vec3(parent.derivative(child.at)), vec3(0, 0, 1));
  const vec3 side = sideways(unitOr(place - around.hub, tangent), tangent), other = glm::cross(tangent, side);
  const float pitch = child.pitch + child.pitchSpread * signedOf(key, 10);
  const float roll = child.roll + child.rollSpread * signedOf(key, 11);
  const vec3 out = std::cos(roll) * side + std::sin(roll) * other;
  return {place, std::cos(pitch) * tangent + std::sin(pitch) * out, parent.b[0].w * child.radius,
          child.stretch};
}

std::uint32_t sproutKey(const GrowthScene& scene, Sprout sprout) {
  return keyOf(keyOf(scene.seed, scene.sites[sprout.span].key), sprout.number);
}

// Sprouts of a span follow one another by the golden section, so that any first few of them are spread
// evenly.
float placeOnSpan(const GrowthScene& scene, Sprout sprout) {
  if (sprout.number & shared::kTipSprout) return sprout.number & shared::kLastSprout ? 1.0f : 0.0f;
  const shared::GrowthSite& site = scene.sites[sprout.span];
  const float share = unitFloat(scramble(keyOf(scene.seed, site.key)) + sprout.number * 0x9e3779b9u);
  return site.stretch.x + (site.stretch.y - site.stretch.x) * share;
}

Bud rootBud(const shared::GrowthSystem& system, const Section& section, const Sprout& sprout,
            bool againstFlow, std::uint32_t key) {
  const Frame& frame = section.frame;
  const bool tip = sprout.number & shared::kTipSprout;
  float turn = 2 * kPi * unitOf(key, 1), pitch = system.lean;
  vec3 tangent = againstFlow ? -frame.tangent : frame.tangent;
  if (tip) {
    const std::uint32_t number = sprout.number & ~(shared::kTipSprout | shared::kLastSprout);
    turn = 2 * kPi * ((float(number) + 0.6f * unitOf(key, 1)) / float(std::max(system.tips, 1u)));
    pitch = system.tipSpread * (0.4f + 0.6f * unitOf(key, 2));
    tangent = sprout.number & shared::kLastSprout ? frame.tangent : -frame.tangent;
  }
  const vec3 out = std::cos(turn) * frame.u + std::sin(turn) * frame.v;
  const vec3 direction = std::cos(pitch) * tangent + std::sin(pitch) * out;
  if (tip) return {section.centre, direction, section.radius * system.tipRadius, 1};
  return {
      section.centre + kRootDepth * section.radius * out, direction,
      std::min(section.radius * system.share, system.mostRadius) * (1 - system.shareSpread * unitOf(key, 3)),
      1};
}

// The sprout of the partner that stands as far on its way as this one, or nearly.
Sprout partnerOf(const GrowthScene& scene, Sprout sprout) {
  const std::uint32_t span = scene.sites[sprout.span].partner;
  const float wanted = placeOnSpan(scene, sprout);
  Sprout best{span, 0};
  float nearest = 2;
  for (std::uint32_t k = 0; k < std::min(scene.sites[span].sprouts, kPartners); ++k) {
    const float away = std::abs(placeOnSpan(scene, {span, k}) - wanted);
    if (away < nearest) nearest = away, best.number = k;
  }
  return best;
}

Capillary grownAt(const GrowthScene& scene, Sprout sprout, std::uint32_t levels, std::uint32_t number) {
  const shared::GrowthSite& site = scene.sites[sprout.span];
  const shared::GrowthSystem& system = scene.tables.system[site.system & 0xffu];
  const Section section = rootSection(scene, sprout);
  Capillary capillary{.symbol = system.axiom, .key = sproutKey(scene, sprout)};
  Bud bud = rootBud(system, section, sprout, (site.system & 0x100u) != 0, capillary.key);
  const Surroundings around = surroundingsOf(site, section);
  for (;;) {
    const GrowthSymbol& symbol = scene.tables.symbol[capillary.symbol];
    capillary.curve = grown(symbol, around, bud, capillary.key);
    capillary.leaf = --levels == 0 || symbol.childCount == 0;
    if (number == 0 || capillary.leaf) return capillary;
    --number;
    std::uint32_t branch = 0;
    for (; branch + 1 < symbol.childCount; ++branch) {
      const std::uint32_t size =
          scene.tables.symbol[scene.tables.child[symbol.firstChild + branch].symbol].treeSize[levels];
      if (number < size) break;
      number -= size;
    }
    const GrowthChild& child = scene.tables.child[symbol.firstChild + branch];
    capillary.key = keyOf(capillary.key, branch);
    bud = budOf(child, around, capillary.curve, capillary.key);
    capillary.phase = capillary.phaseAt(child.at);
    capillary.symbol = child.symbol;
    ++capillary.generation;
  }
}

// Ends a last curve where a curve of the partner's tree of a generation less ends: one that has branches, so
// that it stays as it is.
void join(const GrowthScene& scene, Sprout sprout, std::uint32_t levels, Capillary& capillary) {
  const Sprout other = partnerOf(scene, sprout);
  const shared::GrowthSystem& system = scene.tables.system[scene.sites[other.span].system & 0xffu];
  const std::uint32_t size = scene.tables.symbol[system.axiom].treeSize[levels - 1];
  if (size == 0) return;  // their trees are not that deep
  const Capillary target = grownAt(scene, other, levels - 1, scramble(capillary.key) % size);
  if (scene.tables.symbol[target.symbol].childCount == 0) return;
  Bezier& curve = capillary.curve;
  curve.b[3] = vec4(vec3(target.curve.b[3]), curve.b[3].w);
  curve.b[2] = vec4(0.5f * (vec3(curve.b[2]) + vec3(curve.b[3])), curve.b[2].w);
  capillary.joined = true;
  capillary.farPhase = target.phaseAt(1);
}

}  // namespace

Section rootSection(const GrowthScene& scene, Sprout sprout) {
  return sectionOn(scene.network, scene.spans[sprout.span], placeOnSpan(scene, sprout));
}

Capillary capillaryAt(const GrowthScene& scene, Sprout sprout, std::uint32_t levels, std::uint32_t number) {
  assert(levels > 0);
  Capillary capillary = grownAt(scene, sprout, levels, number);
  const bool joins =
      levels > 1 && levels == scene.joinLevels && scene.sites[sprout.span].partner != shared::kNoPartner;
  if (capillary.leaf && joins) join(scene, sprout, levels, capillary);
  return capillary;
}

}  // namespace vasa
