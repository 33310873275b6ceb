#include "growth/capillary.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "growth/random.h"

// The specification of shaders/lib/growth.glsl: same operations in the same order.
//
// A curve is a walk of three steps, which are the legs of its Bézier polygon. The first goes the way that the branching
// asks for; before each of the others the direction strays (meander), turns (curl), and yields to its surroundings: to
// the limb's axis, away from or around the hub, back from the skin. Every pull is continuous in the curve's place,
// so that a moving vessel's capillaries move smoothly.
namespace vasa {
namespace {

using shared::GrowthChild;
using shared::GrowthSymbol;

constexpr float kRootDepth = 0.5f;     // in radii from the axis: inside of the coarsest tube of quads, too
constexpr float kTiny2 = 1e-12f;

// The surroundings of a tree, in the world.
struct Surroundings {
  vec3 hub, axis;
  float shell;  // [m] from the hub to the root
  float limit;  // [m] from the hub to the skin
};

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
  const float over = height + step * glm::dot(v, outward) - around.limit;
  if (over <= 0) return v;
  return unitOr(v - std::min(over / step, 2.0f) * outward, direction);
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
    place += step * direction;
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
  return {place, std::cos(pitch) * tangent + std::sin(pitch) * out, parent.b[0].w * child.radius, child.stretch};
}

std::uint32_t sproutKey(const GrowthScene& scene, Sprout sprout) {
  return keyOf(keyOf(scene.seed, sprout.sweep), sprout.number);
}

// Sprouts of a sweep follow one another by the golden section, so that any first few of them are spread evenly.
float placeOnSweep(const GrowthScene& scene, Sprout sprout) {
  if (sprout.number & shared::kTipSprout) return sprout.number & shared::kLastSprout ? 1.0f : 0.0f;
  return unitFloat(scramble(keyOf(scene.seed, sprout.sweep)) + sprout.number * 0x9e3779b9u);
}

Bud rootBud(const shared::GrowthSystem& system, const Section& section, const Sprout& sprout, bool againstFlow,
            std::uint32_t key) {
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
  return {section.centre + kRootDepth * section.radius * out, direction,
          std::min(section.radius * system.share, system.mostRadius) * (1 - system.shareSpread * unitOf(key, 3)), 1};
}

}  // namespace

Section rootSection(const GrowthScene& scene, Sprout sprout) {
  return sectionOn(scene.network, sprout.sweep, placeOnSweep(scene, sprout));
}

Capillary capillaryAt(const GrowthScene& scene, Sprout sprout, std::uint32_t levels, std::uint32_t number) {
  const shared::GrowthSite& site = scene.sites[sprout.sweep];
  const shared::GrowthSystem& system = scene.tables.system[site.system & 0xffu];
  assert(levels > 0 && number < scene.tables.symbol[system.axiom].treeSize[levels]);
  const Section section = rootSection(scene, sprout);
  const mat3 axes(section.frame.u, section.frame.v, section.frame.tangent);
  Capillary capillary{.symbol = system.axiom, .key = sproutKey(scene, sprout)};
  Bud bud = rootBud(system, section, sprout, (site.system & 0x100u) != 0, capillary.key);
  Surroundings around{section.centre + axes * site.hub, axes * site.axis, 0, 0};
  around.shell = glm::distance(around.hub, section.centre);
  around.limit = around.shell + site.room;
  for (;;) {
    const GrowthSymbol& symbol = scene.tables.symbol[capillary.symbol];
    capillary.curve = grown(symbol, around, bud, capillary.key);
    capillary.leaf = --levels == 0 || symbol.childCount == 0;
    if (number == 0 || capillary.leaf) return capillary;
    --number;
    std::uint32_t branch = 0;
    for (; branch + 1 < symbol.childCount; ++branch) {
      const std::uint32_t size = scene.tables.symbol[scene.tables.child[symbol.firstChild + branch].symbol].treeSize[levels];
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

}  // namespace vasa
