#version 460
// A thread a fork, a workgroup a group: its vertices row by row, then those of its triangles that may be seen, if the
// template has room for the group. What a thread writes has its place by the threads before it in the group.
// CPU references: engine/surface/fork.h, fork_smooth.h, fork_stump.h, fork_template.h, visible.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "lib/picture_place.glsl"
#include "lib/ring.glsl"

void put(uint vertex, SurfacePoint point);
vec2 stepOf(uint around);
vec2 halfStepOf(uint around);

#include "lib/fork.glsl"

ForkBranch branchAt(uint branch);
vec3 piercingOf(ForkBranch branch);

#include "lib/fork_build.glsl"

layout(constant_id = 1) const uint kGroupThreads = kGroupForks;
#include "lib/group_sum.glsl"
#include "lib/template_room.glsl"

layout(local_size_x_id = 1) in;
layout(push_constant, std430) uniform Push { ForksPush push; };

void put(uint vertex, SurfacePoint point) { corners[vertex] = point; }

vec2 stepOf(uint around) { return stepAt(push.tables, around); }
vec2 halfStepOf(uint around) { return halfStepAt(push.tables, around); }

ForkBranch branchAt(uint branch) { return push.branches.branch[branch]; }
vec3 piercingOf(ForkBranch branch) {
  return pointAt(spanAt(push.points, push.tables, branch.crossPoint, branch.crossClass), branch.crossT).xyz;
}

// Of the trunk's two ends, then of branches.
ForkRing ringOfPart(ForkRecord fork, uint part) {
  if (part == 0) return fork.a;
  if (part == 1) return fork.b;
  return push.branches.branch[fork.firstBranch + part - 2].ring;
}

// A ball around the fork, with room to spare for the collars' control points, lies outside one side of the picture.
bool outOfView(ForkRecord fork) {
  vec4 ends[2 + kMostBranches];
  for (uint part = 0; part < 2 + fork.branchCount; ++part) {
    ForkRing ring = ringOfPart(fork, part);
    ends[part] = pointAt(spanAt(push.points, push.tables, ring.point, ring.spanClass), ring.t);
  }
  vec3 centre = 0.5 * (ends[0].xyz + ends[1].xyz);
  float reach = distance(centre, ends[0].xyz) + ends[0].w + ends[1].w;
  for (uint part = 2; part < 2 + fork.branchCount; ++part) reach = max(reach, distance(centre, ends[part].xyz) + ends[part].w);
  for (uint i = 0; i < 5; ++i) {
    vec4 plane = view.planes[i];
    if (dot(plane.xyz, centre) + plane.w < -1.8 * reach) return true;
  }
  return false;
}

// One loop for all of them: a device compiles what is called once for each place that calls it.
void evaluateRings(ForkRecord fork) {
  for (uint part = 0; part < 2 + fork.branchCount; ++part)
    setRing(part, ringOf(push.points, push.knots, push.tables, ringOfPart(fork, part)));
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

// Leaves those triangles in the list that may be seen. Once a fork is as it stays: to look at every step of its smoothing
// would take more loops than a device may allow (tests/render/loop_budget_test.cpp).
void keepSeen(uint vertices) {
  vec2 places[kMostForkVertices];
  for (uint k = 0; k < vertices; ++k) places[k] = placeOf(corners[k].position);
  PictureGrid grid = gridOf(view);
  uint kept = 0;
  for (uint i = 0; i < triangles; ++i) {
    uint t = list[i];
    if (seenOfTriangle(places[t & 255u], places[t >> 8 & 255u], places[t >> 16], grid)) list[kept++] = t;
  }
  triangles = kept;
}

// Vertices that the triangles need, a bit each, and how many lie before every word of them.
const uint kVertexWords = (kMostForkVertices + 31) / 32;
uint needed[kVertexWords], firsts[kVertexWords];

// @return how many
uint chooseVertices(uint all) {
  for (uint i = 0; i < triangles && push.keepAll == 0; ++i)
    [[dont_unroll]] for (uint rest = list[i], c = 0; c < 3; ++c, rest >>= 8) {
      uint vertex = rest & 255u;
      needed[vertex >> 5] |= 1u << (vertex & 31u);
    }
  uint count = 0;
  for (uint w = 0; w < kVertexWords; ++w) {
    if (push.keepAll != 0) needed[w] = all >= 32 * (w + 1) ? 0xffffffffu : all > 32 * w ? (1u << (all & 31u)) - 1u : 0u;
    firsts[w] = count;
    count += uint(bitCount(needed[w]));
  }
  return count;
}

uint placeOfVertex(uint k) { return firsts[k >> 5] + uint(bitCount(needed[k >> 5] & ((1u << (k & 31u)) - 1u))); }

void writeVertices(uint block, uint blocks, uint colour) {
  Vertices vertices = push.vertices;
  uint vertex = block << kBlockShift;
  for (uint w = 0; w < kVertexWords; ++w)
    for (uint bits = needed[w]; bits != 0; bits &= bits - 1)
      vertices.vertex[vertex++] = packVertex(corners[32 * w + uint(findLSB(bits))]);
  UintsOut colours = push.blockColours;
  for (uint k = 0; k < blocks; ++k) colours.value[block + k] = colour;
}

void writeTriangles(uint vertex, uint target) {
  UintsOut indices = push.indices;
  for (uint i = 0; i < triangles; ++i)
    [[dont_unroll]] for (uint rest = list[i], c = 0; c < 3; ++c, rest >>= 8)
      indices.value[target++] = vertex + placeOfVertex(rest & 255u);
}

shared uint groupBlock, groupVertexBlocks;

// Tubes come first: without room for all of them there is none for forks.
uint undoneFork() {
  Fill filling = push.filling;
  return filling.state.undoneTube < filling.state.tubeEnd ? 0 : filling.state.undoneFork;
}

uint blockFor(uint begin, bool first, uint blocks, uint all) {
  Fill filling = push.filling;
  if (undoneFork() <= begin || atomicMin(filling.state.undoneFork, 0xffffffffu) <= begin) return kNoRoom;
  uint block = takeBlocks(filling, blocksOf(blocks, all), first, push.reserve);
  if (block == kNoRoom) atomicMin(filling.state.undoneFork, begin);
  return block;
}

void main() {
  uint local = gl_LocalInvocationID.x, group = gl_WorkGroupID.x, vertices = 0, colour = 0;
  uint begin = push.filling.state.firstFork + group * kGroupThreads, item = begin + local;
  bool first = group == 0 && push.filling.state.firstTube == push.filling.state.tubeEnd;  // of the round
  triangles = 0;
  for (uint w = 0; w < kVertexWords; ++w) needed[w] = 0;
  if (begin < undoneFork() && item < push.filling.state.forkEnd) {
    colour = push.colours.value[item];
    view = viewAt(push.view);
    if ((view.hiddenKinds >> (colour >> 24) & 1u) == 0u) {
      ForkRecord fork = push.forks.fork[item];
      ForkShape shape = shapeOf(fork);
      if (push.keepAll != 0 || !outOfView(fork)) {
        evaluateRings(fork);
        build(fork, shape);
      }
      uint all = rowStart(shape, kTrunkRows + fork.branchCount * kBranchRows);
      if (push.keepAll == 0 && triangles != 0) keepSeen(all);
      if (triangles != 0) vertices = chooseVertices(all);
    }
  }
  uint blocks = (vertices + kBlockVertices - 1) >> kBlockShift, last = kGroupThreads - 1;
  uint sums = sumBefore(local, blocks << kTriangleBits | triangles);
  uint blocksBefore = sums >> kTriangleBits, before = sums & kTriangleMask;
  if (local == last) {
    groupVertexBlocks = blocksBefore + blocks;
    groupBlock = blockFor(begin, first, blocksBefore + blocks, before + triangles);
  }
  barrier();
  uint block = groupBlock;
  if (block == kNoRoom) return;
  uint firstIndex = (block + groupVertexBlocks) * kBlockWords;
  writeVertices(block + blocksBefore, blocks, colour);
  writeTriangles(blocksBefore << kBlockShift, firstIndex + 3 * before);
  if (local == last)
    push.draws.draw[push.firstDraw + group] = DrawCommand(3 * (before + triangles), 1, firstIndex, int(block << kBlockShift), 0);
}
