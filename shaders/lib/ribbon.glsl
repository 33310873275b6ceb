// Mirrors engine/growth/ribbon.cpp. The shader has `push` (CapillaryPush of shared/growth.h).
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

const float kOverlap = 0.5, kPoint = 0.3, kLeafThread = 1.25;

// The curve where its polyline's i-th corner is.
struct Corner {
  vec3 place, side;
  float halfWidth;
  uint colour;
};

Corner cornerOf(Capillary capillary, GrowthView view, vec3 from, vec3 to, uint i, uint edges, float opacity) {
  float t = float(i) / float(edges);
  vec4 point = pointAt(capillary.curve, t);
  vec3 along = derivativeAt(capillary.curve, t).xyz;
  float speed = sqrt(dotOf(along, along)), beyond = i == 0 ? -kOverlap : i == edges ? kOverlap : 0;
  point.xyz += (speed > 0 ? beyond * point.w / speed : 0) * along;
  if (capillary.leaf && !capillary.joined && i == edges) point.w *= kPoint;
  vec3 toEye = view.perspective * (view.eye - point.xyz) + (1 - view.perspective) * view.eye;
  vec3 side = crossOf(along, toEye);
  float length2 = dotOf(side, side);
  float depth = max(dotOf(view.depth.xyz, point.xyz) + view.depth.w, 1e-6);
  float halfWidth = max(point.w, 0.5 * view.thinnest * (depth / view.focal));
  return Corner(point.xyz, length2 > 1e-20 ? side / sqrt(length2) : view.right, halfWidth,
                packUnorm4x8(vec4(mix(from, to, t), opacity * (point.w / halfWidth))));
}

void writeAt(uint i, GrowthView view, Corner corner, float sign) {
  vec3 outwards = sign * corner.side;
  vec2 across = vec2(dotOf(outwards, view.right), dotOf(outwards, view.up));
  writeVertex(i, view.viewProjection * vec4(corner.place + corner.halfWidth * outwards, 1), corner.colour,
              toSnorm16(across.x) | toSnorm16(across.y) << 16);
}

// writeRibbon() and writeThread().
void writeCurve(Capillary capillary, uint rootColour, uint farColour, uint target) {
  GrowthView view = push.view.view;
  vec3 root = unpackUnorm4x8(rootColour).rgb, bed = unpackUnorm4x8(view.capillary).rgb;
  vec3 from = mix(root, bed, capillary.phase);
  vec3 to = capillary.joined ? mix(unpackUnorm4x8(farColour).rgb, bed, capillary.farPhase) : mix(root, bed, phaseAt(capillary.phase, 1));
  bool thread = push.edges == kThreads;
  uint edges = thread ? kThreadEdges : push.edges;
  float ends = capillary.leaf ? -1 : 1, opacity = thread && capillary.leaf ? kLeafThread : 1;
  for (uint i = 0; i <= edges; ++i) {
    Corner corner = cornerOf(capillary, view, from, to, i, edges, opacity);
    if (thread) {
      writeAt(target + i + 1, view, corner, i % 2 == 0 ? -1 : 1);
      if (i == 0) writeAt(target, view, corner, ends);
      if (i == edges) writeAt(target + i + 2, view, corner, -ends);
    } else {
      writeAt(target + 2 * i, view, corner, 1);
      writeAt(target + 2 * i + 1, view, corner, -1);
    }
  }
}

#endif
