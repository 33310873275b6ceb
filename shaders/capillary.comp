#version 460
// An invocation grows one capillary and writes its ribbon or thread. CPU reference: engine/growth/capillary.h, tests/reference/ribbon.h.
#extension GL_GOOGLE_include_directive : require
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
Section sectionOn(uint span, float t) {
  SweepRecord record = sweepAt(push.spans, span);
  Bezier bezier = spanAt(push.points, push.tables, record.point, record.spanClass);
  return sectionAt(bezier, chordOf(push.points, record.firstPoint, record.lastPoint), vec4Of(push.knots.knot[record.knot]), vec4Of(push.knots.knot[record.knot + 1]), t);
}

// Member by member, as the box: GPU-assisted validation takes a struct that is loaded whole for larger than it is.
GrowthStem stemAt(uint bed, uint side) {
  GrowthStem stem;
  stem.leaving = push.beds.bed[bed].stem[side].leaving;
  stem.radius = push.beds.bed[bed].stem[side].radius;
  stem.end = push.beds.bed[bed].stem[side].end;
  stem.last = push.beds.bed[bed].stem[side].last;
  stem.through = push.beds.bed[bed].stem[side].through;
  stem.own = push.beds.bed[bed].stem[side].own;
  stem.from = push.beds.bed[bed].stem[side].from;
  stem.span = push.beds.bed[bed].stem[side].span;
  stem.t = push.beds.bed[bed].stem[side].t;
  return stem;
}

BedBox boxAt(uint bed) {
  BedBox box;
  for (uint i = 0; i < 3; ++i) box.side[i] = push.beds.bed[bed].side[i];
  for (uint i = 0; i < kGrowthWalls; ++i) box.wall[i] = push.beds.bed[bed].wall[i];
  return box;
}

Bud rootOf(GrowthStem stem, uint side, mat3 axes, vec3 origin) {
  bool leaves = stem.from == kFromVessel;
  uint before = leaves ? 0 : stem.from;
  Section root = sectionOn(leaves ? stem.span : push.beds.bed[before].span, leaves ? stem.t : push.beds.bed[before].t);
  mat3 turn = axesOf(root);
  vec3 place = root.centre, direction = stem.leaving;
  if (!leaves) {
    place += turned(turn, push.beds.bed[before].centre + push.beds.bed[before].stem[side].end);
    direction = push.beds.bed[before].stem[side].through;
  }
  return Bud(within(axes, place - origin), within(axes, turned(turn, direction)), stem.radius);
}

Capillary capillaryAt(uint number, GrowthStem stem, uint side, uint levels, uint curve, bool sparse) {
  BedBox bed = boxAt(number);
  Section section = sectionOn(push.beds.bed[number].span, push.beds.bed[number].t);
  mat3 axes = axesOf(section);
  vec3 centre = section.centre + turned(axes, push.beds.bed[number].centre);
  uint symbolNumber = push.growth.growth.system[push.beds.bed[number].system].axiom;
  Capillary capillary;
  capillary.curve = stemOf(stem, rootOf(stem, side, axes, centre));
  capillary.phase = 0;
  uint key = keyOf(push.view.view.seed, number);
  Part part = Part(push.beds.bed[number].middle, vec3(1));
  vec3 entry = push.beds.bed[number].entry;
  float radius = stem.own;
  for (uint generation = 0; generation < kMostGrowthLevels; ++generation) {
    uint firstChild = push.growth.growth.symbol[symbolNumber].firstChild,
         childCount = push.growth.growth.symbol[symbolNumber].childCount;
    --levels;
    capillary.leaf = levels == 0 || childCount == 0;
    if (curve == 0 || capillary.leaf) break;
    --curve;
    bool thinned = sparse && levels == 1;
    uint branch = thinned ? 2 * curve : 0;
    if (thinned) curve = 0;
    for (; !thinned && branch + 1 < childCount; ++branch) {
      uint next = push.growth.growth.child[firstChild + branch].symbol;
      uint size = sparse ? push.growth.growth.symbol[next].sparseSize[levels] : push.growth.growth.symbol[next].treeSize[levels];
      if (curve < size) break;
      curve -= size;
    }
    GrowthChild child = push.growth.growth.child[firstChild + branch];
    vec3 before = part.centre;
    part = partOf(bed, part, entry, childCount, branch);
    entry = before;
    key = keyOf(key, branch);
    symbolNumber = child.symbol;
    GrowthSymbol own = push.growth.growth.symbol[symbolNumber];
    bool last = levels == 1 || own.childCount == 0;
    Bud bud = Bud(pointAt(capillary.curve, child.at).xyz,
                  unitOr(derivativeAt(capillary.curve, child.at).xyz, vec3(0, 0, 1)), radius * child.radius);
    vec3 end = endIn(bed, part, key, last ? 0 : side == 1 ? -kApart : kApart);
    capillary.phase += (1 - capillary.phase) * 0.5 * child.at;
    capillary.curve = drawn(own, bed, bud, end, keyOf(key, 0x100u + side));
    if (thinned) {
      float share = float(childCount) / float(sparseOf(childCount));
      capillary.curve.b0.w *= share;
      capillary.curve.b1.w *= share;
      capillary.curve.b2.w *= share;
      capillary.curve.b3.w *= share;
    }
    radius = bud.radius;
  }
  capillary.lastPhase = capillary.leaf ? 1 : capillary.phase + (1 - capillary.phase) * 0.5;
  capillary.curve.b0.xyz = centre + turned(axes, capillary.curve.b0.xyz);
  capillary.curve.b1.xyz = centre + turned(axes, capillary.curve.b1.xyz);
  capillary.curve.b2.xyz = centre + turned(axes, capillary.curve.b2.xyz);
  capillary.curve.b3.xyz = centre + turned(axes, capillary.curve.b3.xyz);
  vec4 surface = push.beds.bed[number].surface;
  vec3 outward = turned(axes, surface.xyz);
  capillary.skin = vec4(-outward, surface.w + dotOf(outward, centre));
  return capillary;
}

void main() {
  uint curve = gl_GlobalInvocationID.x;
  if (curve >= push.curveCount) return;
  GrowthJob job = jobOf(curve);
  GrowthStem stem = stemAt(job.bed, job.side);
  uint vertices = push.edges == kThreads ? kThreadVertices : 2 * (push.edges + 1);
  uint target = curve * vertices, colour = push.colours.colour[stem.span];
  if ((push.hiddenKinds >> (colour >> 24) & 1u) != 0u) {
    for (uint i = 0; i < vertices; ++i)
      writeVertex(target + i, vec4(2, 2, 2, 1), 0, 0);  // outside the picture
    return;
  }
  writeCurve(capillaryAt(job.bed, stem, job.side, job.levels, curve - job.firstCurve, job.sparse != 0u), colour, target);
}
