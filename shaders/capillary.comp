#version 460
// An invocation grows one capillary and writes its ribbon or thread. CPU reference: engine/growth/capillary.h and ribbon.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "lib/growth.glsl"
#include "lib/records.glsl"

layout(local_size_x = 64) in;
layout(push_constant, std430) uniform Push { CapillaryPush push; };
#include "lib/ribbon.glsl"

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
Section rootSection(uint span, float t) {
  SweepRecord record = sweepAt(push.spans, span);
  Bezier bezier = bezierOf(spanClassAt(push.tables, record.spanClass), vec4Of(push.points.point[record.point]),
                           vec4Of(push.points.point[record.point + 1]), vec4Of(push.points.point[record.point + 2]),
                           vec4Of(push.points.point[record.point + 3]));
  vec3 chord = vec4Of(push.points.point[record.lastPoint]).xyz - vec4Of(push.points.point[record.firstPoint]).xyz;
  return sectionAt(bezier, chord, vec4Of(push.knots.knot[record.knot]), vec4Of(push.knots.knot[record.knot + 1]), t);
}

// Word by word: GPU-assisted validation takes a struct that is loaded whole for larger than it is.
GrowthSite siteOf(uint span) {
  GrowthSite site;
  site.hub = push.sites.site[span].hub;
  site.reach = push.sites.site[span].reach;
  site.axis = push.sites.site[span].axis;
  site.system = push.sites.site[span].system;
  for (uint i = 0; i < kGrowthWalls; ++i) site.wall[i] = push.sites.site[span].wall[i];
  site.stretch = push.sites.site[span].stretch;
  site.key = push.sites.site[span].key;
  site.sprouts = push.sites.site[span].sprouts;
  site.partner = push.sites.site[span].partner;
  return site;
}

float placeOnSpan(GrowthSite site, uint siteKey, uint sprout) {
  if ((sprout & kTipSprout) != 0u) return (sprout & kLastSprout) != 0u ? 1.0 : 0.0;
  precise float place = site.stretch.x + (site.stretch.y - site.stretch.x) * unitFloat(scramble(siteKey) + sprout * 0x9e3779b9u);
  return place;
}

Capillary treeCurve(uint span, GrowthSite site, uint sprout, uint levels, uint number) {
  uint key = keyOf(push.view.view.seed, site.key);
  return grownAt(push.growth, site, rootSection(span, placeOnSpan(site, key, sprout)), sprout, keyOf(key, sprout), levels, number);
}

uint treeSize(GrowthSite site, uint levels) {
  return push.growth.growth.symbol[push.growth.growth.system[site.system & 0xffu].axiom].treeSize[levels];
}

const uint kPartners = 8;

// Ends a last curve where a curve of the partner's tree ends.
void join(GrowthSite site, uint sprout, uint levels, inout Capillary capillary) {
  GrowthSite other = siteOf(site.partner);
  uint seed = push.view.view.seed, best = 0, size = treeSize(other, levels - 1);
  float wanted = placeOnSpan(site, keyOf(seed, site.key), sprout), nearest = 2;
  for (uint k = 0; k < min(other.sprouts, kPartners); ++k) {
    float away = abs(placeOnSpan(other, keyOf(seed, other.key), k) - wanted);
    if (away < nearest) {
      nearest = away;
      best = k;
    }
  }
  if (size == 0u) return;
  Capillary target = treeCurve(site.partner, other, best, levels - 1, scramble(capillary.key) % size);
  if (!target.branches) return;
  capillary.curve.b3.xyz = target.curve.b3.xyz;
  capillary.curve.b2.xyz = 0.5 * (capillary.curve.b2.xyz + capillary.curve.b3.xyz);
  capillary.joined = true;
  capillary.farPhase = phaseAt(target.phase, 1);
}

void main() {
  uint curve = gl_GlobalInvocationID.x;
  if (curve >= push.curveCount) return;
  GrowthJob job = jobOf(curve);
  GrowthSite site = siteOf(job.span);
  uint size = treeSize(site, job.levels);
  uint vertices = push.edges == kThreads ? kThreadVertices : 2 * (push.edges + 1);
  uint target = curve * vertices, colour = push.colours.colour[job.span];
  if ((push.hiddenKinds >> (colour >> 24) & 1u) != 0u) {
    for (uint i = 0; i < vertices; ++i)
      writeVertex(target + i, vec4(2, 2, 2, 1), 0, 0);  // outside the picture
    return;
  }
  uint within = curve - job.firstCurve, sprout = job.firstSprout + within / size;
  Capillary capillary = treeCurve(job.span, site, sprout, job.levels, within % size);
  bool joins = job.levels > 1 && job.levels == push.view.view.joinLevels && site.partner != kNoPartner;
  if (capillary.leaf && joins) join(site, sprout, job.levels, capillary);
  writeCurve(capillary, colour, capillary.joined ? push.colours.colour[site.partner] : colour, target);
}
