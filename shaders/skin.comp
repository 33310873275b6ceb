#version 460
// Linear blend skinning, one thread a vertex.
#extension GL_GOOGLE_include_directive : require
#include "lib/octahedral.glsl"
#include "lib/words.glsl"
#include "shared/skin.h"

layout(local_size_x = 64) in;
layout(push_constant, std430) uniform Push { SkinPush push; };

void blend(inout JointRows sum, uint joint, float weight) {
  if (weight == 0) return;  // bones have one joint: on a CPU device the loads saved are most of the work
  uint row = 3 * min(joint, push.jointCount - 1);
  sum.row0 += weight * vec4Of(push.joints.row[row]);
  sum.row1 += weight * vec4Of(push.joints.row[row + 1]);
  sum.row2 += weight * vec4Of(push.joints.row[row + 2]);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  uint word = 5 * i;
  uvec2 xy = halvesOf(push.rest.word[word]), zNormal = halvesOf(push.rest.word[word + 1]);
  uvec2 joints = halvesOf(push.rest.word[word + 2]);
  vec2 weights01 = uintBitsToFloat(halvesOf(push.rest.word[word + 3]));
  vec2 weights23 = uintBitsToFloat(halvesOf(push.rest.word[word + 4]));
  JointRows m = JointRows(vec4(0), vec4(0), vec4(0));
  blend(m, joints.x & 0xffffu, weights01.x);
  blend(m, joints.x >> 16, weights01.y);
  blend(m, joints.y & 0xffffu, weights23.x);
  blend(m, joints.y >> 16, weights23.y);
  vec3 place = vec3(uintBitsToFloat(xy), uintBitsToFloat(zNormal.x));
  if (push.scale != 1) place = push.centre + push.scale * (place - push.centre);
  vec4 position = vec4(place, 1);
  vec4 normal = vec4(unpackOctahedral(unpackSnorm(zNormal.y)), 0);
  vec3 turned = vec3(dot(m.row0, normal), dot(m.row1, normal), dot(m.row2, normal));
  float size2 = dot(turned, turned);
  turned = size2 > 0 ? turned * inversesqrt(size2) : vec3(0, 0, 1);
  uvec3 posed = floatBitsToUint(vec3(dot(m.row0, position), dot(m.row1, position), dot(m.row2, position)));
  push.posed.vertex[i] = vertexWords(uintBitsToFloat(posed), packOctahedral(turned));
}
