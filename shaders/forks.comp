#version 460
// A thread a fork, a workgroup a group: its vertices row by row, then those of its triangles that may be seen. What a
// thread writes has its place by the threads before it in the group, so nothing depends on their timing.
// CPU references: engine/surface/fork.h, fork_stump.h, fork_template.h, visible.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/ring.glsl"
#include "lib/visible.glsl"

void put(uint vertex, SurfacePoint point);
vec2 stepOf(uint around);
uint seenOf(vec2 a, vec2 b, vec2 c, vec2 d);

#include "lib/fork_collar.glsl"
#include "lib/fork_stump.glsl"

const uint kGroupThreads = kGroupForks;
#include "lib/group_sum.glsl"

layout(local_size_x = kGroupForks) in;
layout(push_constant, scalar) uniform Push { ForksPush push; };

DetailView view;

void put(uint vertex, SurfacePoint point) {
  corners[vertex] = point;
  vec4 place = vec4(point.position, 1);
  places[vertex] = dot(view.planes[4], place) < 0
                       ? vec2(kBehind)
                       : vec2(dot(view.picture[0], place), dot(view.picture[1], place)) / dot(view.picture[2], place);
}

vec2 stepOf(uint around) { return stepAt(push.tables, around); }

uint seenOf(vec2 a, vec2 b, vec2 c, vec2 d) { return push.keepAll != 0 ? 3 : seenOfQuad(a, b, c, d, vec2(view.columns, view.rows), view.snap); }

// Puts the branch's hole between columns; `directions` have to be the trunk's.
void placeWindow(uint i, ForkRecord fork, ForkBranch branch, ForkShape shape, Trunk trunk, Section middle) {
  Section at = wallAt(trunk, middle, branch.centre);
  vec4 cross = pointAt(spanAt(push.points, push.tables, branch.crossPoint, branch.crossClass), branch.crossT);
  vec3 towards = levelled(at, cross.xyz);
  vec2 wanted = vec2(dotOf(towards, at.u), dotOf(towards, at.v)), halfStep = halfStepAt(push.tables, shape.a);
  precise float share = branch.window * float(shape.a) + 1.0;
  ForkWindow window;
  window.count = min(uint(ceil(share)), fork.branchCount > 1 ? shape.a / fork.branchCount : shape.a - 1);
  vec2 halfAngle = vec2(1, 0);
  for (uint c = 0; c < window.count; ++c) halfAngle = turned(halfAngle, halfStep);
  window.first = nearestOf(turned(wanted, vec2(halfAngle.x, -halfAngle.y)), shape.a);
  if (i > 0) {  // beside the first one's
    uint otherFirst = windows[0].first, least = windows[0].count, most = shape.a - window.count;
    uint behind = wrapped(window.first + shape.a - otherFirst, shape.a);
    if (behind < least) window.first = wrapped(otherFirst + (2 * behind < least ? most : least), shape.a);
    else if (behind > most) window.first = wrapped(otherFirst + most, shape.a);
  }
  window.hole = holeDirection(branch, wanted, turned(directions[window.first], halfAngle), halfAngle);
  window.wide = branch.holeAround;
  precise vec3 rows = (vec3(fork.row1, fork.row2, fork.row3) - branch.centre) / branch.holeAlong;
  window.rows = rows;
  windows[i] = window;
}

// A ball around the fork, with room to spare for the collars' control points, lies outside one side of the picture.
bool outOfView(ForkRecord fork, Ring a, Ring b) {
  vec3 centre = 0.5 * (a.section.centre + b.section.centre);
  float reach = distance(centre, a.section.centre) + a.section.radius + b.section.radius;
  for (uint i = 0; i < fork.branchCount; ++i) {
    ForkRing ring = push.branches.branch[fork.firstBranch + i].ring;
    vec4 end = pointAt(spanAt(push.points, push.tables, ring.point, ring.spanClass), ring.t);
    reach = max(reach, distance(centre, end.xyz) + end.w);
  }
  for (uint i = 0; i < 5; ++i) {
    vec4 plane = view.planes[i];
    if (dot(plane.xyz, centre) + plane.w < -1.8 * reach) return true;
  }
  return false;
}

void trunkRow(uint start, uint around, float s, Trunk trunk, Section middle) {
  Section section = wallAt(trunk, middle, s);
  for (uint k = 0; k < around; ++k) put(start + k, surfacePoint(section, directions[k]));
}

Ring branchRing(ForkBranch branch) { return ringOf(push.points, push.knots, push.tables, branch.ring); }

// @return false where the fork is not drawn
bool build(ForkRecord fork, ForkShape shape) {
  Ring a = ringOf(push.points, push.knots, push.tables, fork.a), b = ringOf(push.points, push.knots, push.tables, fork.b);
  if (push.keepAll == 0 && outOfView(fork, a, b)) return false;
  precise float thirdA = fork.scaleA / 3.0, thirdB = -(fork.scaleB / 3.0);
  precise vec3 chord = b.section.centre - a.section.centre;
  Trunk trunk = Trunk(Bezier(vec4(a.section.centre, a.section.radius), innerPoint(a, thirdA), innerPoint(b, thirdB),
                             vec4(b.section.centre, b.section.radius)), chord);
  precise vec3 tangentA = a.turn * a.section.tangent, tangentB = b.turn * b.section.tangent;
  Section bare = trunkAt(trunk, fork.row2);
  Section middle = framed(bare, carried(a.section.u, a.section.centre, tangentA, bare.centre, bare.tangent));

  setDirections(stepOf(shape.b), shape.b);
  uint first = seamAt(b, carried(middle.u, middle.centre, middle.tangent, b.section.centre, tangentB), shape.b);
  for (uint k = 0; k < shape.b; ++k)
    put(rowStart(shape, kTrunkRows - 1) + k, surfacePoint(b.section, seamDirection(b, first, k, shape.b)));
  setDirections(stepOf(shape.a), shape.a);
  for (uint k = 0; k < shape.a; ++k) {
    columns[k] = directions[k];
    put(k, surfacePoint(a.section, seamDirection(a, 0, k, shape.a)));
  }
  trunkRow(rowStart(shape, 1), shape.a, fork.row1, trunk, middle);
  trunkRow(rowStart(shape, 2), shape.a, fork.row2, trunk, middle);
  trunkRow(rowStart(shape, 3), shape.a, fork.row3, trunk, middle);
  for (uint i = 0; i < fork.branchCount; ++i)
    placeWindow(i, fork, push.branches.branch[fork.firstBranch + i], shape, trunk, middle);
  uint seams[kMostBranches];
  for (uint i = 0; i < fork.branchCount; ++i) {
    ForkBranch branch = push.branches.branch[fork.firstBranch + i];
    seams[i] = collar(branch, branchRing(branch), rowStart(shape, holeRow(i)), shape.branch[i], windows[i].hole, trunk, middle);
  }
  addForkTriangles(shape);
  if (cut) {
    addStump(shape, a, 0, tangentA, b.section.centre, 0, 1, 2);
    addStump(shape, b, first, -tangentB, a.section.centre, kTrunkRows - 1, kTrunkRows - 2, kTrunkRows - 2);
  }
  for (uint i = 0; i < fork.branchCount; ++i) {
    stumps[i] = stumps[i] || cut;
    if (!stumps[i]) continue;
    ForkBranch branch = push.branches.branch[fork.firstBranch + i];
    Ring ring = branchRing(branch);
    precise vec3 inward = -ring.turn * ring.section.tangent;
    addStump(shape, ring, seams[i], inward, wallAt(trunk, middle, branch.centre).centre, branchRow(i), branchRow(i) - 1,
             branchRow(i) - 2);
  }
  return true;
}

ForkShape shapeOf(ForkRecord fork) {
  ForkShape shape;
  shape.a = push.around.value[fork.vesselA];
  shape.b = push.around.value[fork.vesselB];
  shape.branchCount = fork.branchCount;
  for (uint i = 0; i < kMostBranches; ++i)
    shape.branch[i] = i < fork.branchCount ? push.around.value[push.branches.branch[fork.firstBranch + i].vessel] : 0;
  return shape;
}

void writeVertices(uint first, uint count, uint blocks, uint colour) {
  Vertices vertices = push.vertices;
  for (uint k = 0; k < count; ++k) vertices.vertex[first + k] = packVertex(corners[k]);
  UintsOut colours = push.blockColours;
  for (uint k = 0; k < blocks; ++k) colours.value[(first >> kBlockShift) + k] = colour;
}

void writeTriangles(uint vertex, uint target) {
  UintsOut indices = push.indices;
  for (uint i = 0; i < triangles; ++i) {
    uvec3 corner = vertex + triangleAt(i);
    indices.value[target++] = corner.x;
    indices.value[target++] = corner.y;
    indices.value[target++] = corner.z;
  }
}

void main() {
  uint local = gl_LocalInvocationID.x, group = gl_WorkGroupID.x, item = group * kGroupForks + local, vertices = 0, colour = 0;
  triangles = 0;
  if (item < push.forkCount) {
    colour = push.colours.value[push.firstFork + item];
    view = viewAt(push.view);
    if ((view.hiddenKinds >> (colour >> 24) & 1u) == 0u) {
      ForkRecord fork = push.forks.fork[push.firstFork + item];
      ForkShape shape = shapeOf(fork);
      if (!build(fork, shape)) triangles = 0;
      if (triangles != 0) vertices = rowStart(shape, kTrunkRows + fork.branchCount * kBranchRows);
    }
  }
  uint blocks = (vertices + kBlockVertices - 1) >> kBlockShift;
  uint first = group * push.verticesPerGroup + (sumBefore(local, blocks) << kBlockShift);
  writeVertices(first, vertices, blocks, colour);
  uint before = sumBefore(local, triangles), firstIndex = group * push.indicesPerGroup;
  writeTriangles(first, firstIndex + 3 * before);
  if (local == kGroupForks - 1) push.draws.draw[group] = DrawCommand(3 * (before + triangles), 1, firstIndex, 0, 0);
}
