// Mirrors engine/growth/capillary.cpp and random.h: the same operations in the same order.
#ifndef VASA_GROWTH
#define VASA_GROWTH
#include "lib/section.glsl"
#include "shared/growth.h"

const float kGrowthTiny2 = 1e-12;
const float kLead = 0.8, kJitter = 0.9, kApart = 0.4;

// What of a bed every curve of it reads.
struct BedBox {
  vec4 side[3];
  vec4 wall[kGrowthWalls];
};

struct Part {
  vec3 centre, size;
};

struct Bud {
  vec3 place, direction;
  float radius;
};

struct Capillary {
  Bezier curve;
  float phase, lastPhase;
  bool leaf;
  vec4 skin;
};

uint scramble(uint value) {
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}
uint keyOf(uint key, uint part) { return scramble(key ^ scramble(part + 0x9e3779b9u)); }
float unitFloat(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }
float signedOf(uint key, uint n) { return 2 * unitFloat(scramble(key + n * 0x85ebca6bu)) - 1; }
vec3 signedVector(uint key, uint first) {
  return vec3(signedOf(key, first), signedOf(key, first + 1), signedOf(key, first + 2));
}

vec3 unitOr(vec3 v, vec3 otherwise) {
  float length2 = dotOf(v, v);
  return length2 > kGrowthTiny2 ? v / sqrt(length2) : otherwise;
}

Part partOf(BedBox bed, Part part, vec3 entry, uint n, uint i) {
  while (n > 1) {
    precise vec3 lengths = part.size * vec3(bed.side[0].w, bed.side[1].w, bed.side[2].w);
    uint longest = lengths.y > lengths.x ? 1 : 0;
    longest = lengths.z > lengths[longest] ? 2 : longest;
    uint near = (n + 1) / 2;
    float share = float(near) / float(n), size = part.size[longest];
    float towards = entry[longest] < part.centre[longest] ? -size : size;
    bool first = i < near;
    precise float centre = part.centre[longest] + (first ? towards * (1 - share) : -(towards * share));
    precise float left = size * (first ? share : 1 - share);
    part.centre[longest] = centre;
    part.size[longest] = left;
    i = first ? i : i - near;
    n = first ? near : n - near;
  }
  return part;
}

vec3 keptInside(BedBox bed, vec3 place) {
  float share = 1;
  for (uint i = 0; i < kGrowthWalls; ++i) {
    float along = dotOf(bed.wall[i].xyz, place);
    if (along > bed.wall[i].w) share = min(share, bed.wall[i].w / along);
  }
  return share * place;
}

vec3 endIn(BedBox bed, Part part, uint key, float apart) {
  vec3 p = part.centre + part.size * (kJitter * signedVector(key, 0) + apart * signedVector(key, 3));
  return keptInside(bed, p.x * bed.side[0].w * bed.side[0].xyz + p.y * bed.side[1].w * bed.side[1].xyz +
                             p.z * bed.side[2].w * bed.side[2].xyz);
}

vec3 strayed(GrowthSymbol symbol, BedBox bed, vec3 v, vec3 way, uint key, uint first) {
  vec3 fibre = bed.side[0].xyz;
  return unitOr(v + symbol.meander * signedVector(key, first) + (symbol.fibre * dotOf(fibre, way)) * fibre, way);
}

Bezier drawn(GrowthSymbol symbol, BedBox bed, Bud bud, vec3 end, uint key) {
  vec3 reach = end - bud.place;
  float third = sqrt(dotOf(reach, reach)) / 3;
  vec3 way = unitOr(reach, bud.direction);
  vec3 from = strayed(symbol, bed, kLead * bud.direction + way, way, key, 6);
  vec3 to = strayed(symbol, bed, way, way, key, 9);
  float thinner = symbol.taper - 1;
  return Bezier(vec4(bud.place, bud.radius),
                vec4(keptInside(bed, bud.place + third * from), bud.radius * (1 + thinner * (1.0 / 3))),
                vec4(keptInside(bed, end - third * to), bud.radius * (1 + thinner * (2.0 / 3))),
                vec4(end, bud.radius * (1 + thinner)));
}

mat3 axesOf(Section section) { return mat3(section.u, section.v, section.tangent); }
vec3 turned(mat3 axes, vec3 v) { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
vec3 within(mat3 axes, vec3 v) { return vec3(dotOf(axes[0], v), dotOf(axes[1], v), dotOf(axes[2], v)); }

Bezier stemOf(GrowthStem stem, Bud bud) {
  vec3 reach = stem.end - bud.place;
  float third = sqrt(dotOf(reach, reach)) / 3, thinner = stem.last - stem.radius;
  vec3 from = unitOr(kLead * bud.direction + unitOr(reach, bud.direction), bud.direction);
  return Bezier(vec4(bud.place, stem.radius), vec4(bud.place + third * from, stem.radius + thinner * (1.0 / 3)),
                vec4(stem.end - third * stem.through, stem.radius + thinner * (2.0 / 3)), vec4(stem.end, stem.last));
}

#endif
