// Mirrors tests/reference/ribbon.cpp. The shader has `push` (CapillaryPush of shared/growth.h).
#ifndef VASA_RIBBON
#define VASA_RIBBON
#include "lib/growth.glsl"
#include "lib/octahedral.glsl"

// A CapillaryVertex.
void writeVertex(uint i, vec4 clip, uint colour, uint across) {
  uvec4 bits = floatBitsToUint(clip);
  push.vertices.word[3 * i] = wordOf(bits.xy);
  push.vertices.word[3 * i + 1] = wordOf(bits.zw);
  push.vertices.word[3 * i + 2] = wordOf(uvec2(colour, across));
}

const float kOverlap = 0.5, kVeil = 0.025, kGrazing = 0.3, kDarkest = 0.7, kFaintest = 0.35;

// The curve where its polyline has a corner.
struct Corner {
  vec3 place, side, normal;
  float reach, thin;
  uint colour;
};

Corner cornerOf(Capillary capillary, GrowthView view, vec3 root, vec3 bed, float t) {
  vec4 point = pointAt(capillary.curve, t);
  vec3 along = derivativeAt(capillary.curve, t).xyz;
  float speed = sqrt(dotOf(along, along)), beyond = t == 0 ? -kOverlap : t == 1 ? kOverlap : 0;
  point.xyz += (speed > 0 ? beyond * point.w / speed : 0) * along;
  vec3 toEye = view.perspective * (view.eye - point.xyz) + (1 - view.perspective) * view.eye;
  vec3 side = crossOf(along, toEye);
  float length2 = dotOf(side, side);
  float depth = max(dotOf(view.depth.xyz, point.xyz) + view.depth.w, 1e-6);
  float soft = kSoftEdge * (depth / view.focal), reach = point.w + soft;
  float opacity = point.w < soft ? 4 * point.w * soft / (reach * reach) : 1.0;
  vec3 outward = -capillary.skin.xyz;
  float facing = dotOf(outward, toEye) / max(sqrt(dotOf(toEye, toEye)), 1e-9);
  float way = max(dotOf(capillary.skin.xyz, point.xyz) + capillary.skin.w, 0.0) / max(facing, kGrazing);
  float light = exp2(-way / kVeil) * clamp(facing + 1, 0.0, 1.0);
  vec3 own = mix(root, bed, mix(capillary.phase, capillary.lastPhase, t)) * (kDarkest + (1 - kDarkest) * light);
  return Corner(point.xyz, length2 > 1e-20 ? side / sqrt(length2) : view.right, outward, reach, 1 - opacity,
                packUnorm4x8(vec4(own, opacity * (kFaintest + (1 - kFaintest) * light))));
}

void writeAt(uint i, GrowthView view, Corner corner, float sign) {
  vec3 outwards = sign * corner.side;
  vec3 lit = outwards * (1 - corner.thin) + corner.normal * corner.thin;
  vec2 across = vec2(dotOf(lit, view.right), dotOf(lit, view.up));
  writeVertex(i, view.viewProjection * vec4(corner.place + corner.reach * outwards, 1), corner.colour,
              toSnorm16(across.x) | toSnorm16(across.y) << 16);
}

// writeRibbon() and writeThread().
void writeCurve(Capillary capillary, uint rootColour, uint target) {
  GrowthView view = push.view.view;
  vec3 root = unpackUnorm4x8(rootColour).rgb, bed = unpackUnorm4x8(view.capillary).rgb;
  bool thread = push.edges == kThreads;
  uint edges = thread ? (capillary.leaf ? 1 : kThreadEdges) : push.edges;
  for (uint i = 0; i <= (thread ? kThreadEdges : edges); ++i) {
    Corner corner = cornerOf(capillary, view, root, bed, float(min(i, edges)) / float(edges));
    writeAt(target + 2 * i, view, corner, 1);
    writeAt(target + 2 * i + 1, view, corner, -1);
  }
}

#endif
