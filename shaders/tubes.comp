#version 460
// A thread a sweep, a workgroup a group. First which triangles between two rings may be seen, then, if the template has room
// for the group, the vertices that these need, ring by ring, and the triangles. What a thread writes has its place by the
// threads before it in the group.
// CPU references: engine/surface/tessellate.h, tests/reference/visible.h.
#extension GL_GOOGLE_include_directive : require
#include "lib/capped_sweep.glsl"
#include "lib/picture_ring.glsl"
#include "lib/ring.glsl"
#include "lib/strip.glsl"
#include "lib/template_room.glsl"

// Of the picture, a pixel. A constant: where the loop over them has no known end a CPU device takes a seventh longer.
layout(constant_id = 0) const uint kSamples = 1;

layout(constant_id = 1) const uint kGroupThreads = kGroupSweeps;
#include "lib/group_sum.glsl"

layout(local_size_x_id = 1) in;
layout(push_constant, std430) uniform Push { TubesPush push; };

// What may be seen of a sweep. Bits as in lib/strip.glsl.
uint masks[kMaxStrips];       // triangles of each strip
uint needed[kMaxStrips + 1];  // vertices of each ring
uint firsts[kMaxStrips + 1];  // how many vertices earlier rings need
uint seenStrips, neededRings; // bit k: any of strip or ring k

void note(uint ring, uint bits, inout uint vertices) {
  needed[ring] = bits;
  firsts[ring] = vertices;
  vertices += uint(bitCount(bits));
  if (bits != 0) neededRings |= 1u << ring;
}

// @return blocks of vertices and triangles
uint look(Item it, SweepCurve curve) {
  DetailView detail = viewAt(push.view);
  PictureView view = PictureView(detail.picture[0], detail.picture[1], detail.picture[2], detail.planes[4],
                                 PictureGrid(vec2(detail.columns, detail.rows), detail.snap, kSamples));
  uint vertices = 0, triangles = 0, above = 0;
  PictureRing last;
  seenStrips = neededRings = 0;
  for (uint ring = 0; ring < it.rings; ++ring) {
    Section section = ringSection(curve, innerRing(it, ring), it.along);
    PictureRing now = pictureRing(section, polarOf(it, ring), outwardOf(it, ring), view);
    if (ring > 0) {
      uint mask = push.keepAll != 0 ? wholeStrip(it.around) : seenOfStrip(last, now, it.around, directions[1], view);
      masks[ring - 1] = mask;
      if (mask != 0) seenStrips |= 1u << (ring - 1);
      triangles += uint(bitCount(mask));
      note(ring - 1, above | firstRingOf(mask, it.around), vertices);
      above = secondRingOf(mask, it.around);
    }
    last = now;
  }
  note(it.rings - 1, above, vertices);
  return (vertices + kBlockVertices - 1) >> kBlockShift << kTriangleBits | triangles;
}

void writeColours(Item it, uint first, uint blocks) {
  uint colour = push.colours.value[it.sweep];
  UintsOut colours = push.blockColours;
  for (uint k = 0; k < blocks; ++k) colours.value[first + k] = colour;
}

// One loop over all vertices, not one a ring: a CPU device goes round as often as the sweep that needs most of those
// beside one another, and a store costs it more than a section.
void writeVertices(Item it, SweepCurve curve, uint vertex) {
  Vertices vertices = push.vertices;
  uint bits = 0, ring = 0, rings = neededRings;
  while (bits != 0 || rings != 0) {
    if (bits == 0) {
      ring = uint(findLSB(rings));
      rings &= rings - 1;
      bits = needed[ring];
    }
    Section section = ringSection(curve, innerRing(it, ring), it.along);
    vec2 direction = directions[uint(findLSB(bits)) >> 1];
    vertices.vertex[vertex++] = packVertex(capPoint(section, direction, polarOf(it, ring), outwardOf(it, ring)));
    bits &= bits - 1;
  }
}

void writeTriangles(Item it, uint vertex, uint target) {
  UintsOut indices = push.indices;
  uint mask = 0, strips = seenStrips;
  RingVertices first, second;
  while (mask != 0 || strips != 0) {
    if (mask == 0) {
      uint strip = uint(findLSB(strips));
      strips &= strips - 1;
      mask = masks[strip];
      first = RingVertices(vertex + firsts[strip], needed[strip]);
      second = RingVertices(vertex + firsts[strip + 1], needed[strip + 1]);
    }
    writeTriangle(indices, target, stripTriangle(uint(findLSB(mask)), first, second, it.around));
    target += 3;
    mask &= mask - 1;
  }
}

shared uint groupBlock, groupWritten;

uint placeOf(uint begin, bool first, uint written) {
  Fill filling = push.filling;
  if (atomicMin(filling.state.undoneTube, 0xffffffffu) <= begin) return kNoRoom;
  uint block = takeBlocks(filling, blocksOf(written >> kTriangleBits, written & kTriangleMask), first, push.reserve);
  if (block == kNoRoom) atomicMin(filling.state.undoneTube, begin);
  return block;
}

void main() {
  uint local = gl_LocalInvocationID.x, group = gl_WorkGroupID.x, written = 0;
  uint begin = push.filling.state.firstTube + group * kGroupThreads, sweep = begin + local;
  uint end = min(push.filling.state.tubeEnd, push.filling.state.undoneTube);  // behind it no room is left
  uint along = begin < end && sweep < push.filling.state.tubeEnd ? push.along.value[sweep] : 0;
  Item it;
  SweepCurve curve;
  if (along != 0) {
    SweepRecord record = sweepAt(push.sweeps, sweep);
    it = itemOf(record, sweep, along, push.around.value[record.vessel], viewAt(push.view).around != 0);
    curve = sweepCurve(push.points, push.knots, push.tables, record);
    prepare(it, push.tables);
    written = look(it, curve);
  }
  uint before = sumBefore(local, written), last = kGroupThreads - 1;
  if (local == last) {
    groupWritten = before + written;
    groupBlock = placeOf(begin, group == 0, before + written);
  }
  barrier();
  uint block = groupBlock, all = groupWritten;
  if (block == kNoRoom) return;
  uint vertex = before >> kTriangleBits << kBlockShift, triangle = before & kTriangleMask;
  uint firstIndex = (block + (all >> kTriangleBits)) * kBlockWords;
  if (along != 0) {
    writeColours(it, block + (before >> kTriangleBits), written >> kTriangleBits);
    writeVertices(it, curve, (block << kBlockShift) + vertex);
    writeTriangles(it, vertex, firstIndex + 3 * triangle);
  }
  if (local == last) push.draws.draw[group] = DrawCommand(3 * (all & kTriangleMask), 1, firstIndex, int(block << kBlockShift), 0);
}
