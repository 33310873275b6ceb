#version 460
// How much of the sky the surfaces around a pixel take away, from depth alone (McGuire, Osman, Bukowski, Hennessy 2011).
// CPU reference: tests/reference/occlusion.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared/occlusion.h"

layout(push_constant, std430) uniform Push { OcclusionPush push; };
layout(set = 0, binding = 0) uniform texture2D depths;  // of the picture, 0: background
layout(location = 0) out float light;  // share of the ambient light that is left, 0 to 1

const float kLeast = 3, kMost = 48;  // [pixels] radius of the spiral

float depthAt(ivec2 pixel) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(push.width, push.height)))) return 0.0;
  return texelFetch(depths, pixel, 0).x;
}

vec3 placeOf(ivec2 pixel, float depth) {
  float distance = (push.fromDepth.x + push.fromDepth.y * depth) / (push.fromDepth.z + push.fromDepth.w * depth);
  vec2 ray = push.corner + (vec2(pixel) + 0.5) * push.step;
  return vec3(ray * (push.perspective != 0 ? distance : 1.0), -distance);
}

// The smaller of the two differences across a pixel lies on its own surface.
vec3 slope(ivec2 pixel, ivec2 way, vec3 here) {
  float ahead = depthAt(pixel + way), behind = depthAt(pixel - way);
  vec3 forward = placeOf(pixel + way, ahead) - here, backward = here - placeOf(pixel - way, behind);
  if (ahead <= 0) return backward;
  if (behind <= 0) return forward;
  return abs(forward.z) < abs(backward.z) ? forward : backward;
}

float lightAt(ivec2 pixel, float depth) {
  vec3 here = placeOf(pixel, depth), normal = cross(slope(pixel, ivec2(0, -1), here), slope(pixel, ivec2(-1, 0), here));
  float size2 = dot(normal, normal);
  if (!(size2 > 0)) return 1.0;
  normal *= inversesqrt(size2);
  float metre = push.step.y * (push.perspective != 0 ? -here.z : 1.0);  // of a pixel
  float radius = clamp(push.reach / abs(metre), kLeast, kMost), reach = radius * abs(metre);
  // Quarter turns of eighths of the spiral: sixteen different ones in a tile.
  uint turn = (uint(pixel.x) & 3u) * 5u + (uint(pixel.y) & 3u) * 3u & 15u;
  vec2 axis = vec2(1.0 - 0.125 * float(turn), 0);
  axis.y = sqrt(max(1.0 - axis.x * axis.x, 0.0));
  float taken = 0;
  for (uint i = 0; i < kOcclusionTaps; ++i) {
    vec2 tap = kOcclusionSpiral[i] * radius;
    ivec2 other = pixel + ivec2(floor(vec2(tap.x * axis.x - tap.y * axis.y, tap.x * axis.y + tap.y * axis.x) + 0.5));
    float otherDepth = depthAt(other);
    if (otherDepth <= 0) continue;
    vec3 way = placeOf(other, otherDepth) - here;
    float size = dot(way, way) / (reach * reach), near = max(1.0 - size, 0.0);
    taken += near * max(dot(way, normal) / reach - 0.06, 0.0) / (size + 0.04);
  }
  return max(1.0 - push.strength * taken * (2.4 / float(kOcclusionTaps)), 0.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  light = lightAt(pixel, depthAt(pixel));
}
