#version 460
// A thread a fork, a workgroup a group: its vertices row by row, then those of its triangles that may be seen, if the
// template has room for the group. What a thread writes has its place by the threads before it in the group.
// CPU references: engine/surface/fork.h, fork_smooth.h, fork_stump.h, fork_template.h, visible.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/picture_place.glsl"
#include "lib/ring.glsl"

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

// A ball around the fork, with room to spare for the collars' control points, lies outside one side of the picture. By the
// rings, which have to be loaded anyway: a CPU device compiles each load as a loop over lanes.
bool outOfView(ForkRecord fork) {
  Section a = rings[0].section, b = rings[1].section;
  vec3 centre = 0.5 * (a.centre + b.centre);
  float reach = distance(centre, a.centre) + a.radius + b.radius;
  for (uint i = 0; i < kMostBranches; ++i) {
    Section branch = rings[2 + i].section;
    if (i < fork.branchCount) reach = max(reach, distance(centre, branch.centre) + branch.radius);
  }
  for (uint i = 0; i < 5; ++i) {
    vec4 plane = view.planes[i];
    if (dot(plane.xyz, centre) + plane.w < -1.8 * reach) return true;
  }
  return false;
}

// One loop for all of them: a device compiles what is called once for each place that calls it.
void evaluateRings(ForkRecord fork, ForkShape shape) {
  for (uint part = 0; part < 2 + fork.branchCount; ++part) {
    setRing(part, ringOf(push.points, push.knots, push.tables, ringOfPart(fork, part)));
    uint around = part == 0 ? shape.a : part == 1 ? shape.b : part == 2 ? shape.branch[0] : shape.branch[1];
    setDirections(part, stepAt(push.tables, around), around);
  }
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

// Vertices as they are written, and instead of the rest of their normals their places on the picture.
void pack(uint vertices) {
  for (uint k = 0; k < vertices; ++k) {
    SurfacePoint point = cornerOf(k);
    uvec2 rest = uvec2(floatBitsToUint(point.position.z), packOctahedral(point.normal));
    corners[k] = CornerWords(wordOf(point.position.xy), wordOf(rest), wordOf(placeOf(point.position)));
  }
}

vec2 placeAt(uint vertex) { return vec2Of(corners[vertex & 255u].c); }

// Leaves those triangles in the list that may be seen. Once a fork is as it stays: to look at every step of its smoothing
// would take more loops than a device may allow (tests/render/loop_budget_test.cpp).
void keepSeen() {
  PictureGrid grid = gridOf(view);
  uint kept = 0;
  triangles = 0;
  for (uint i = 0; i < pieces; ++i) {
    uint quad = list[i], a = quad & 255u, d = quad >> 24;
    uint seen = seenOfQuad(placeAt(a), placeAt(quad >> 8), placeAt(quad >> 16), placeAt(d), grid) & (a == d ? 1u : 3u);
    if (seen == 1) quad = quad & 0xffffffu | a << 24;
    if (seen == 2) quad = quad >> 8 & 0xffff00u | a << 24 | a;
    if (seen != 0) list[kept++] = quad;
    triangles += uint(bitCount(seen));
  }
  pieces = kept;
}

// Vertices that the triangles need, a bit each, and how many lie before every word of them.
const uint kVertexWords = (kMostForkVertices + 31) / 32;
uint needed[kVertexWords], firsts[kVertexWords];

// @return how many
uint chooseVertices(uint all) {
  for (uint i = 0; i < pieces && push.keepAll == 0; ++i)
    [[dont_unroll]] for (uint rest = list[i], c = 0; c < 4; ++c, rest >>= 8) {
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
    for (uint bits = needed[w]; bits != 0; bits &= bits - 1) {
      CornerWords words = corners[32 * w + uint(findLSB(bits))];
      vertices.vertex[vertex++] = Word2(words.a, words.b);
    }
  UintsOut colours = push.blockColours;
  for (uint k = 0; k < blocks; ++k) colours.value[block + k] = colour;
}

void writeTriangles(uint vertex, uint target) {
  UintsOut indices = push.indices;
  for (uint i = 0; i < pieces; ++i) {
    uint quad = list[i], count = (quad & 255u) == quad >> 24 ? 3 : 6;
    [[dont_unroll]] for (uint c = 0; c < count; ++c) {
      uint corner = c < 3 ? c : c == 3 ? 0 : c - 2;
      indices.value[target++] = vertex + placeOfVertex(quad >> (8 * corner) & 255u);
    }
  }
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
  pieces = triangles = 0;
  for (uint w = 0; w < kVertexWords; ++w) needed[w] = 0;
  if (begin < undoneFork() && item < push.filling.state.forkEnd) {
    colour = push.colours.value[item];
    view = viewAt(push.view);
    if ((view.hiddenKinds >> (colour >> 24) & 1u) == 0u) {
      ForkRecord fork = push.forks.fork[item];
      ForkShape shape = shapeOf(fork);
      evaluateRings(fork, shape);
      if (push.keepAll != 0 || !outOfView(fork)) build(fork, shape);
      uint all = rowStart(shape, kTrunkRows + fork.branchCount * kBranchRows);
      if (triangles != 0) pack(all);
      if (push.keepAll == 0) keepSeen();
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
