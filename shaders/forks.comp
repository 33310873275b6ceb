#version 460
// A thread a fork, a workgroup a group: its vertices row by row, then those of its triangles that may be seen. What a
// thread writes has its place by the threads before it in the group, so nothing depends on their timing.
// CPU references: engine/surface/fork.h, fork_template.h, visible.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/ring.glsl"
#include "lib/visible.glsl"

void add(uint a, uint b, uint c);

#include "lib/fork_triangles.glsl"

layout(local_size_x = kGroupForks) in;
layout(push_constant, scalar) uniform Push { ForksPush push; };

shared uint trianglesOf[kGroupForks];

vec2 places[kMostForkVertices];                   // of the vertices, on the picture [samples]
uint masks[(kMostForkTriangles + 31) / 32];       // a bit a triangle: it may be seen
uint triangle, kept, target, firstVertex;
bool writing;
mat4 viewProjection;
vec2 samples;
float snap;

void add(uint a, uint b, uint c) {
  uint word = triangle >> 5, bit = 1u << (triangle & 31u);
  ++triangle;
  if (writing) {
    if ((masks[word] & bit) == 0u) return;
    push.indices.value[target++] = firstVertex + a;
    push.indices.value[target++] = firstVertex + b;
    push.indices.value[target++] = firstVertex + c;
  } else if (push.keepAll != 0 || (seenOfQuad(places[a], places[b], places[c], places[c], samples, snap) & 1u) != 0u) {
    masks[word] |= bit;
    ++kept;
  }
}

void put(uint vertex, SurfacePoint point) {
  push.vertices.vertex[firstVertex + vertex] = packVertex(point);
  vec4 clip = viewProjection * vec4(point.position, 1);
  places[vertex] = clip.z > clip.w || clip.w <= 0 ? vec2(kBehind) : (clip.xy / clip.w + 1.0) * (0.5 * samples) - 0.5;
}

void ringRow(uint start, uint around, Ring ring, vec3 ringTangent, Section middle, vec2 edge) {
  setDirections(push.tables.tables.step[around], around);
  vec3 u = carried(middle.u, middle.centre, middle.tangent, ring.section.centre, ringTangent);
  precise vec3 wanted = edge.x * u + edge.y * crossOf(ringTangent, u);
  uint first = seamAt(ring, wanted, around);
  for (uint k = 0; k < around; ++k) put(start + k, surfacePoint(ring.section, seamDirection(ring, first, k, around)));
}

void trunkRow(uint start, uint around, float s, Trunk trunk, Section middle, vec2 edge) {
  Section section = wallAt(trunk, middle, s);
  for (uint k = 0; k < around; ++k) put(start + k, surfacePoint(section, turned(edge, directions[k])));
}

void collar(ForkRecord fork, ForkShape shape, Trunk trunk, Section middle) {
  uint around = shape.branch, start = rowStart(shape, kTrunkRows);
  setDirections(push.tables.tables.step[around], around);
  Ring branch = ringOf(push.points, push.knots, push.tables, fork.branch);
  precise vec3 outward = branch.turn * branch.section.tangent;
  precise vec3 sum = middle.u + outward;
  precise float fold = max(1.0 + dotOf(middle.u, outward), 1e-3);
  precise vec3 across = middle.v - (dotOf(middle.v, sum) / fold) * sum;
  uint first = seamAt(branch, across, around);
  for (uint k = 0; k < around; ++k) {
    vec2 polar = directions[k];
    precise float x = fork.holeAround * polar.x;
    precise float depth = sqrt(1.0 - x * x);
    precise float s = fork.centre + fork.holeAlong * polar.y;
    Section section = wallAt(trunk, middle, s);
    SurfacePoint hole = surfacePoint(section, vec2(depth, x));
    precise float cornerX = x / (1.0 + kFillet);
    precise float cornerS = fork.centre + (fork.holeAlong / (1.0 + kFillet)) * polar.y;
    precise float cornerDepth = sqrt(1.0 - cornerX * cornerX);
    SurfacePoint corner = surfacePoint(wallAt(trunk, middle, cornerS), vec2(cornerDepth, cornerX));
    precise vec3 chord = corner.position - hole.position;
    precise vec3 inwards = chord - dotOf(chord, hole.normal) * hole.normal;

    vec2 direction = seamDirection(branch, first, k, around);
    SurfacePoint end = surfacePoint(branch.section, direction);
    vec3 d = ringDirection(branch.section, direction);
    precise float bend = max(1.0 - branch.section.radius * dotOf(branch.section.curvature, d), 0.1);
    precise vec3 along = bend * outward + (branch.turn * branch.section.slope) * d;
    vec3 ruling = unitOr(along, outward);
    precise vec3 reach = end.position - (hole.position + inwards);
    precise float rise = max(dotOf(reach, ruling), 0.35 * sqrt(dotOf(reach, reach)));
    precise float slide = fork.holeAround * polar.y;
    precise vec3 sideways = (slide * x / depth) * section.u - slide * section.v;
    vec3 velocity = derivativeAt(trunk.bezier, s).xyz;
    precise vec3 h1 = hole.position + kRound * inwards, p1 = end.position - (kRound * rise) * ruling;
    precise vec3 aroundH = section.radius * sideways + (fork.holeAlong * polar.x) * velocity;
    precise vec3 aroundP = (branch.turn * branch.section.radius) *
                           (direction.x * branch.section.v - direction.y * branch.section.u);
    CollarCurve curve = CollarCurve(hole.position, h1, p1, end.position, aroundH, aroundP);
    put(start + k, hole);
    for (uint row = 1; row < kCollarRows; ++row)
      put(start + row * around + k, collarAt(curve, float(row) / float(kCollarRows)));
    put(start + kCollarRows * around + k, end);
  }
}

// A ball around the fork, with room to spare for the collar's control points, lies outside one side of the picture.
bool outOfView(ForkRecord fork, Ring a, Ring b) {
  vec4 end = vec4(b.section.centre, b.section.radius);
  if (fork.hasBranch != 0) end = pointAt(spanAt(push.points, push.tables, fork.branch.point, fork.branch.spanClass), fork.branch.t);
  vec3 centre = 0.5 * (a.section.centre + b.section.centre);
  float reach = max(distance(centre, end.xyz) + end.w, distance(centre, a.section.centre) + a.section.radius + b.section.radius);
  for (uint i = 0; i < 5; ++i) {
    vec4 plane = push.view.view.planes[i];
    if (dot(plane.xyz, centre) + plane.w < -1.8 * reach) return true;
  }
  return false;
}

// @return false where the fork is not drawn
bool build(ForkRecord fork, ForkShape shape) {
  Ring a = ringOf(push.points, push.knots, push.tables, fork.a), b = ringOf(push.points, push.knots, push.tables, fork.b);
  if (push.keepAll == 0 && outOfView(fork, a, b)) return false;
  precise float thirdA = fork.scaleA / 3.0, thirdB = -(fork.scaleB / 3.0);
  precise vec3 chord = b.section.centre - a.section.centre;
  Trunk trunk = Trunk(Bezier(vec4(a.section.centre, a.section.radius), innerPoint(a, thirdA), innerPoint(b, thirdB),
                             vec4(b.section.centre, b.section.radius)), chord);
  precise vec3 tangentA = a.turn * a.section.tangent, tangentB = b.turn * b.section.tangent;
  Section bare = trunkAt(trunk, fork.centre);
  vec3 towards = carried(a.section.u, a.section.centre, tangentA, bare.centre, bare.tangent);
  vec2 edge = vec2(1, 0);
  if (fork.hasBranch != 0) {
    vec4 cross = pointAt(spanAt(push.points, push.tables, fork.crossPoint, fork.crossClass), fork.crossT);
    towards = levelled(bare.centre, bare.tangent, cross.xyz);
    vec2 back = vec2(1, -1) * push.tables.tables.halfStep[shape.a];
    for (uint i = 0; i < shape.window; ++i) edge = turned(edge, back);
  }
  Section middle = framed(bare, towards);
  ringRow(rowStart(shape, 4), shape.b, b, tangentB, middle, edge);
  ringRow(0, shape.a, a, tangentA, middle, edge);
  trunkRow(rowStart(shape, 1), shape.a, fork.row1, trunk, middle, edge);
  trunkRow(rowStart(shape, 2), shape.a, fork.centre, trunk, middle, edge);
  trunkRow(rowStart(shape, 3), shape.a, fork.row3, trunk, middle, edge);
  if (fork.hasBranch != 0) collar(fork, shape, trunk, middle);
  return true;
}

ForkShape shapeOf(ForkRecord fork) {
  ForkShape shape = ForkShape(push.around.value[fork.vesselA], push.around.value[fork.vesselB],
                              push.around.value[fork.vesselBranch], 0);
  if (fork.hasBranch != 0) {
    precise float columns = fork.window * float(shape.a);
    shape.window = clamp(uint(ceil(columns)), 1u, shape.a - 1);
  }
  return shape;
}

void main() {
  uint local = gl_LocalInvocationID.x, group = gl_WorkGroupID.x, item = group * kGroupForks + local;
  bool shown = item < push.forkCount;
  ForkShape shape = ForkShape(0, 0, 0, 0);
  triangle = kept = 0;
  writing = false;
  if (shown) shown = (push.view.view.hiddenKinds >> (push.colours.value[push.firstFork + item] >> 24) & 1u) == 0u;
  if (shown) {
    ForkRecord fork = push.forks.fork[push.firstFork + item];
    shape = shapeOf(fork);
    viewProjection = push.view.view.viewProjection;
    samples = vec2(push.view.view.columns, push.view.view.rows);
    snap = push.view.view.snap;
    firstVertex = item << push.vertexShift;
    for (uint i = 0; i < masks.length(); ++i) masks[i] = 0u;
    shown = build(fork, shape);
  }
  if (shown) addForkTriangles(shape);
  trianglesOf[local] = kept;
  barrier();
  target = group * push.indicesPerGroup;
  for (uint k = 0; k < local; ++k) target += 3 * trianglesOf[k];
  writing = true;
  triangle = 0;
  if (kept != 0) addForkTriangles(shape);
  if (local == kGroupForks - 1)
    push.draws.draw[group] = DrawCommand(target - group * push.indicesPerGroup, 1, group * push.indicesPerGroup, 0, 0);
}
