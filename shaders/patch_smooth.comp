#version 460
// A workgroup a strained patch. CPU reference: smoothPatch() of engine/surface/patch_smooth.h.
#extension GL_GOOGLE_include_directive : require
#include "lib/ring.glsl"
#include "lib/fork.glsl"
#include "lib/ramp.glsl"
#include "shared/patch.h"

layout(local_size_x = kSmoothThreads) in;
layout(push_constant, std430) uniform Push { PatchSmoothPush push; };

const float kSpared = 0.6;  // of its size at rest: a larger triangle moves no corner
const float kStep = 0.6;    // of the way to the neighbours' middle

const float kFreedSoon = 4;  // times the share that is pressed: vertices are free to move as far as they like
const float kSameSide = 0.8;  // cosine: a normal that is so near to the surface's stays

struct Vertex {
  vec3 position, normal;
  uint packedNormal;
};

Vertex vertexAt(SmoothedVertices vertices, uint v) {
  Word2 words = vertices.vertex[v];
  uint normal = normalIn(words);
  return Vertex(placeIn(words), unpackOctahedral(unpackSnorm(normal)), normal);
}

vec3 positionAt(SmoothedVertices vertices, uint v) { return placeIn(vertices.vertex[v]); }

// The two other corners of a triangle at a vertex.
uvec2 cornersOf(Word triangle, uint firstVertex) {
  uint corners = halvesOf(triangle).x;
  return firstVertex + uvec2(corners & 0xffffu, corners >> 16);
}

// How much a vertex is pressed, and the middle of its neighbours.
struct Pressed {
  float share;
  vec3 middle;
};

Pressed pressedAt(SmoothedVertices from, Vertex own, uvec2 fan, uint firstVertex) {
  precise vec3 sum = vec3(0);
  float least = 3e38;
  for (uint k = fan.x; k < fan.y; ++k) {
    Word triangle = push.fans.triangle[k];
    uvec2 corners = cornersOf(triangle, firstVertex);
    vec3 a = positionAt(from, corners.x), b = positionAt(from, corners.y);
    precise vec3 first = a - own.position, second = b - own.position;
    precise float size = dotOf(crossOf(first, second), own.normal) * uintBitsToFloat(halvesOf(triangle).y);
    least = min(least, size);
    sum += a + b;
  }
  precise float pressed = 1.0 - ramp(least / kSpared);
  precise vec3 middle = sum / float(2 * (fan.y - fan.x));
  return Pressed(pressed, middle);
}

vec3 turned(SmoothedVertices from, Vertex own, uvec2 fan, uint firstVertex, float share) {
  precise vec3 sum = vec3(0);
  for (uint k = fan.x; k < fan.y; ++k) {
    uvec2 corners = cornersOf(push.fans.triangle[k], firstVertex);
    precise vec3 first = positionAt(from, corners.x) - own.position, second = positionAt(from, corners.y) - own.position;
    sum += crossOf(first, second);
  }
  vec3 surface = unitOr(sum, own.normal);
  precise float away = share * ramp(1.0 - dotOf(surface, own.normal) / kSameSide);
  precise vec3 normal = own.normal + away * (surface - own.normal);
  return unitOr(normal, own.normal);
}

uvec2 fanAt(uint v) { return uvec2(push.firstFan.value[v], push.firstFan.value[v + 1]); }

shared bool anyPressed;
float free[kMostSmoothed / kSmoothThreads];  // of this thread's vertices: how much they may move

// Before any step: shares that are pressed, in the buffer between steps.
void findPressed(PatchWall wall) {
  uint end = wall.firstVertex + wall.vertexCount;
  for (uint v = wall.firstVertex + gl_LocalInvocationID.x; v < end; v += kSmoothThreads) {
    uvec2 fan = fanAt(v);
    float share = fan.x < fan.y ? pressedAt(push.vertices, vertexAt(push.vertices, v), fan, wall.firstVertex).share : 0.0;
    if (share > 0) anyPressed = true;
    push.between.vertex[v] = wordsOf(uvec4(floatBitsToUint(share), 0, 0, 0));
  }
}

float pressedBefore(uint v) { return uintBitsToFloat(halvesOf(push.between.vertex[v]).x); }

// Pressed vertices and their neighbours.
void findFree(PatchWall wall) {
  uint end = wall.firstVertex + wall.vertexCount, i = 0;
  for (uint v = wall.firstVertex + gl_LocalInvocationID.x; v < end; v += kSmoothThreads, ++i) {
    uvec2 fan = fanAt(v);
    float share = pressedBefore(v);
    for (uint k = fan.x; k < fan.y; ++k) {
      uvec2 corners = cornersOf(push.fans.triangle[k], wall.firstVertex);
      share = max(share, max(pressedBefore(corners.x), pressedBefore(corners.y)));
    }
    free[i] = fan.x < fan.y ? min(kFreedSoon * share, 1.0) : 0.0;
  }
}

// `first`: what stays is copied, too.
void takeStep(SmoothedVertices from, SmoothedVertices to, PatchWall wall, float share, bool first) {
  uint end = wall.firstVertex + wall.vertexCount, i = 0;
  for (uint v = wall.firstVertex + gl_LocalInvocationID.x; v < end; v += kSmoothThreads, ++i) {
    if (free[i] == 0) {
      if (first) to.vertex[v] = from.vertex[v];
      continue;
    }
    Vertex own = vertexAt(from, v);
    Pressed pressed = pressedAt(from, own, fanAt(v), wall.firstVertex);
    precise float part = share * kStep * pressed.share * free[i];
    precise vec3 place = own.position + part * (pressed.middle - own.position);
    to.vertex[v] = vertexWords(place, own.packedNormal);
  }
}

void turnNormals(PatchWall wall, float share) {
  uint end = wall.firstVertex + wall.vertexCount, i = 0;
  for (uint v = wall.firstVertex + gl_LocalInvocationID.x; v < end; v += kSmoothThreads, ++i) {
    if (free[i] == 0) continue;
    Vertex own = vertexAt(push.between, v);
    vec3 normal = turned(push.between, own, fanAt(v), wall.firstVertex, share * free[i]);
    push.vertices.vertex[v] = packVertex(SurfacePoint(own.position, normal));
  }
}

void meet() {
  memoryBarrierBuffer();
  barrier();
}

void main() {
  StrainedPatch strained = push.strained.patches[gl_WorkGroupID.x];
  PatchWall wall = push.walls.wall[strained.wall];
  if (gl_LocalInvocationID.x == 0) anyPressed = false;
  barrier();
  findPressed(wall);
  meet();
  if (!anyPressed) return;
  findFree(wall);
  meet();
  // There and back in turn: not every driver takes an address that is chosen while the shader runs.
  takeStep(push.vertices, push.between, wall, strained.share, true);
  meet();
  for (uint step = 1; step < kPatchSteps; step += 2) {
    takeStep(push.between, push.vertices, wall, strained.share, false);
    meet();
    takeStep(push.vertices, push.between, wall, strained.share, false);
    meet();
  }
  turnNormals(wall, strained.share);
}
