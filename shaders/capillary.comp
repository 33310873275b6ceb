#version 460
// A thread grows one capillary and writes its ribbon. CPU reference: engine/growth/capillary.h and ribbon.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/growth.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { CapillaryPush push; };

GrowthJob jobOf(uint curve) {
  uint low = 0, high = push.jobCount - 1;
  while (low < high) {
    uint middle = (low + high + 1) / 2;
    if (push.jobs.job[middle].firstCurve <= curve) low = middle;
    else high = middle - 1;
  }
  return push.jobs.job[low];
}

// sectionOn of engine/surface/tessellate.cpp.
Section rootSection(uint sweep, float t) {
  SweepRecord record = push.sweeps.sweep[sweep];
  Bezier bezier = bezierOf(push.tables.tables.spanClass[record.spanClass], vec4Of(push.points.point[record.point]),
                           vec4Of(push.points.point[record.point + 1]), vec4Of(push.points.point[record.point + 2]),
                           vec4Of(push.points.point[record.point + 3]));
  vec3 chord = vec4Of(push.points.point[record.lastPoint]).xyz - vec4Of(push.points.point[record.firstPoint]).xyz;
  precise float at = record.from + (record.to - record.from) * t;
  if (t == 1) at = record.to;
  return sectionAt(bezier, chord, vec4Of(push.knots.knot[record.knot]), vec4Of(push.knots.knot[record.knot + 1]), at);
}

float placeOnSweep(uint sweepKey, uint sprout) {
  if ((sprout & kTipSprout) != 0u) return (sprout & kLastSprout) != 0u ? 1.0 : 0.0;
  return unitFloat(scramble(sweepKey) + sprout * 0x9e3779b9u);
}

const float kOverlap = 0.5, kPoint = 0.3;

void writeRibbon(Capillary capillary, uint rootColour, uint target) {
  GrowthView view = push.view.view;
  vec3 from = unpackUnorm4x8(rootColour).rgb, to = unpackUnorm4x8(view.capillary).rgb;
  for (uint i = 0; i <= push.edges; ++i) {
    float t = float(i) / float(push.edges);
    vec4 point = pointAt(capillary.curve, t);
    vec3 along = derivativeAt(capillary.curve, t).xyz;
    float speed = sqrt(dotOf(along, along)), beyond = i == 0 ? -kOverlap : i == push.edges ? kOverlap : 0;
    point.xyz += (speed > 0 ? beyond * point.w / speed : 0) * along;
    if (capillary.leaf && i == push.edges) point.w *= kPoint;
    vec3 toEye = view.perspective * (view.eye - point.xyz) + (1 - view.perspective) * view.eye;
    vec3 side = crossOf(along, toEye);
    float length2 = dotOf(side, side);
    side = length2 > 1e-20 ? side / sqrt(length2) : view.right;
    float depth = max(dotOf(view.depth.xyz, point.xyz) + view.depth.w, 1e-6);
    float radius = max(point.w, 0.5 * view.thinnest * (depth / view.focal));
    uint packed = packUnorm4x8(vec4(mix(from, to, phaseAt(capillary.phase, t)), point.w / radius));
    vec2 across = vec2(dotOf(side, view.right), dotOf(side, view.up));
    push.vertices.vertex[target + 2 * i] =
        CapillaryVertex(view.viewProjection * vec4(point.xyz + radius * side, 1), packed,
                        toSnorm16(across.x) | toSnorm16(across.y) << 16);
    push.vertices.vertex[target + 2 * i + 1] =
        CapillaryVertex(view.viewProjection * vec4(point.xyz - radius * side, 1), packed,
                        toSnorm16(-across.x) | toSnorm16(-across.y) << 16);
  }
}

void main() {
  uint curve = gl_GlobalInvocationID.x;
  if (curve >= push.curveCount) return;
  GrowthJob job = jobOf(curve);
  // Word by word: GPU-assisted validation takes a struct that is loaded whole for larger than it is.
  GrowthSite site = GrowthSite(push.sites.site[job.sweep].hub, push.sites.site[job.sweep].room,
                               push.sites.site[job.sweep].axis, push.sites.site[job.sweep].system);
  uint axiom = push.growth.growth.system[site.system & 0xffu].axiom;
  uint size = push.growth.growth.symbol[axiom].treeSize[job.levels];
  uint target = curve * 2 * (push.edges + 1), colour = push.colours.colour[job.sweep];
  if ((push.hiddenKinds >> (colour >> 24) & 1u) != 0u) {
    for (uint i = 0; i < 2 * (push.edges + 1); ++i)
      push.vertices.vertex[target + i] = CapillaryVertex(vec4(2, 2, 2, 1), 0, 0);  // outside the picture
    return;
  }
  uint within = curve - job.firstCurve, sprout = job.firstSprout + within / size;
  uint sweepKey = keyOf(push.view.view.seed, job.sweep);
  Section section = rootSection(job.sweep, placeOnSweep(sweepKey, sprout));
  Capillary capillary =
      capillaryAt(push.growth, site, section, sprout, keyOf(sweepKey, sprout), job.levels, within % size);
  writeRibbon(capillary, colour, target);
}
