// Mirrors engine/growth/capillary.cpp and random.h: the same operations in the same order.
#ifndef VASA_GROWTH
#define VASA_GROWTH
#include "lib/section.glsl"
#include "shared/growth.h"

const float kRootDepth = 0.5;
const float kGrowthTiny2 = 1e-12;
const float kWholeTurn = 6.28318530717958647692;

struct Surroundings {
  vec3 hub, axis, centre;
  float shell, reach;
  vec4 walls[kGrowthWalls];  // offsets count from the centre
};

struct Bud {
  vec3 place, direction;
  float radius, stretch;
};

struct Capillary {
  Bezier curve;
  float phase;
  bool leaf, joined;
  float farPhase;
  uint key;
  bool branches;  // its letter has some
};

uint scramble(uint value) {
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}
uint keyOf(uint key, uint part) { return scramble(key ^ scramble(part + 0x9e3779b9u)); }
float unitFloat(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }
float randomUnit(uint key, uint n) { return unitFloat(scramble(key + n * 0x85ebca6bu)); }
float randomSigned(uint key, uint n) { return 2 * randomUnit(key, n) - 1; }

float phaseAt(float phase, float t) { return phase + (1 - phase) * 0.5 * t; }

vec3 unitOr(vec3 v, vec3 otherwise) {
  float length2 = dotOf(v, v);
  return length2 > kGrowthTiny2 ? v / sqrt(length2) : otherwise;
}

vec3 sideways(vec3 outward, vec3 direction) {
  vec3 side = crossOf(outward, direction);
  float length2 = dotOf(side, side);
  return length2 > 1e-6 ? side / sqrt(length2) : anyPerpendicular(direction);
}

vec3 bent(GrowthSymbol symbol, Surroundings around, vec3 place, vec3 direction, float step, uint key, uint leg) {
  vec3 arm = place - around.hub;
  vec3 outward = unitOr(arm, direction);
  float height = dotOf(arm, outward);
  vec3 side = sideways(outward, direction), other = crossOf(direction, side);
  float turn = symbol.curl * ((key & 1u) != 0u ? 1.0 : -1.0) + symbol.meander * randomSigned(key, 2 * leg);
  vec3 v = direction + turn * side + (symbol.meander * randomSigned(key, 2 * leg + 1)) * other;
  v += (symbol.along + symbol.fibre * dotOf(around.axis, direction)) * around.axis;
  float back = clamp((around.shell - height) / (3 * step), -1.0, 1.0);
  v += (symbol.outward + symbol.hug * (back - dotOf(v, outward))) * outward;
  v = unitOr(v, direction);
  for (uint i = 0; i < kGrowthWalls; ++i) {
    vec4 wall = around.walls[i];
    float over = dotOf(wall.xyz, place + step * v - around.centre) - wall.w;
    if (over > 0) v = unitOr(v - min(over / step, 2.0) * wall.xyz, direction);
  }
  return v;
}

vec3 keptInside(Surroundings around, vec3 place) {
  vec3 arm = place - around.centre;
  float size = sqrt(dotOf(arm, arm)), share = size > around.reach ? around.reach / size : 1;
  for (uint i = 0; i < kGrowthWalls; ++i) {
    float along = dotOf(around.walls[i].xyz, arm);
    if (along > around.walls[i].w) share = min(share, around.walls[i].w / along);
  }
  return share < 1 ? around.centre + share * arm : place;
}

Bezier grown(GrowthSymbol symbol, Surroundings around, Bud bud, uint key) {
  float step = symbol.reach * bud.stretch * bud.radius * (1 + symbol.reachSpread * randomSigned(key, 0)) / 3;
  float thinner = symbol.taper - 1;
  vec3 d1 = bud.direction, p1 = keptInside(around, bud.place + step * d1);
  vec3 d2 = bent(symbol, around, p1, d1, step, key, 2), p2 = keptInside(around, p1 + step * d2);
  vec3 d3 = bent(symbol, around, p2, d2, step, key, 3), p3 = keptInside(around, p2 + step * d3);
  return Bezier(vec4(bud.place, bud.radius), vec4(p1, bud.radius * (1 + thinner * (1.0 / 3))),
                vec4(p2, bud.radius * (1 + thinner * (2.0 / 3))), vec4(p3, bud.radius * (1 + thinner)));
}

Bud budOf(GrowthChild child, Surroundings around, Bezier parent, uint key) {
  vec3 place = pointAt(parent, child.at).xyz;
  vec3 tangent = unitOr(derivativeAt(parent, child.at).xyz, vec3(0, 0, 1));
  vec3 side = sideways(unitOr(place - around.hub, tangent), tangent), other = crossOf(tangent, side);
  float pitch = child.pitch + child.pitchSpread * randomSigned(key, 10);
  float roll = child.roll + child.rollSpread * randomSigned(key, 11);
  vec3 outwards = cos(roll) * side + sin(roll) * other;
  return Bud(place, cos(pitch) * tangent + sin(pitch) * outwards, parent.b0.w * child.radius, child.stretch);
}

Bud rootBud(GrowthSystem system, Section section, uint number, bool againstFlow, uint key) {
  bool tip = (number & kTipSprout) != 0u;
  float turn = kWholeTurn * randomUnit(key, 1), pitch = system.lean;
  vec3 tangent = againstFlow ? -section.tangent : section.tangent;
  if (tip) {
    uint place = number & ~(kTipSprout | kLastSprout);
    turn = kWholeTurn * ((float(place) + 0.6 * randomUnit(key, 1)) / float(max(system.tips, 1u)));
    pitch = system.tipSpread * (0.4 + 0.6 * randomUnit(key, 2));
    tangent = (number & kLastSprout) != 0u ? section.tangent : -section.tangent;
  }
  vec3 outwards = cos(turn) * section.u + sin(turn) * section.v;
  vec3 direction = cos(pitch) * tangent + sin(pitch) * outwards;
  if (tip) return Bud(section.centre, direction, section.radius * system.tipRadius, 1);
  return Bud(section.centre + kRootDepth * section.radius * outwards, direction,
             min(section.radius * system.share, system.mostRadius) * (1 - system.shareSpread * randomUnit(key, 3)), 1);
}

vec3 inFrame(Section section, vec3 v) { return v.x * section.u + v.y * section.v + v.z * section.tangent; }

Surroundings surroundingsOf(GrowthSite site, Section section) {
  Surroundings around;
  around.hub = section.centre + inFrame(section, site.hub);
  around.axis = inFrame(section, site.axis);
  around.centre = section.centre;
  vec3 arm = section.centre - around.hub;
  around.shell = sqrt(dotOf(arm, arm));
  around.reach = site.reach;
  for (uint i = 0; i < kGrowthWalls; ++i) around.walls[i] = vec4(inFrame(section, site.wall[i].xyz), site.wall[i].w);
  return around;
}

Capillary grownAt(Growth tables, GrowthSite site, Section section, uint sprout, uint rootKey, uint levels, uint number) {
  GrowthSystem system = tables.growth.system[site.system & 0xffu];
  uint key = rootKey, symbolNumber = system.axiom;
  Bud bud = rootBud(system, section, sprout, (site.system & 0x100u) != 0u, key);
  Surroundings around = surroundingsOf(site, section);
  float phase = 0;
  for (uint generation = 0; generation < kMostGrowthLevels; ++generation) {
    GrowthSymbol symbol = tables.growth.symbol[symbolNumber];
    Bezier curve = grown(symbol, around, bud, key);
    --levels;
    bool leaf = levels == 0u || symbol.childCount == 0u;
    if (number == 0u || leaf) return Capillary(curve, phase, leaf, false, 0, key, symbol.childCount != 0u);
    --number;
    uint branch = 0;
    for (; branch + 1 < symbol.childCount; ++branch) {
      uint size = tables.growth.symbol[tables.growth.child[symbol.firstChild + branch].symbol].treeSize[levels];
      if (number < size) break;
      number -= size;
    }
    GrowthChild child = tables.growth.child[symbol.firstChild + branch];
    key = keyOf(key, branch);
    bud = budOf(child, around, curve, key);
    phase = phaseAt(phase, child.at);
    symbolNumber = child.symbol;
  }
  return Capillary(Bezier(vec4(0), vec4(0), vec4(0), vec4(0)), 0, true, false, 0, 0, false);  // not reached
}

#endif
