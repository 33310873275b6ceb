#version 460
// Linear blend skinning, one thread a vertex.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/octahedral.glsl"
#include "shared/skin.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { SkinPush push; };

vec2 unpackSnorm(uint bits) { return max(vec2(bitfieldExtract(int(bits), 0, 16), int(bits) >> 16) / 32767.0, -1.0); }

void blend(inout JointRows sum, uint joint, float weight) {
  if (weight == 0) return;  // bones have one joint: on a CPU device the loads saved are most of the work
  JointRows rows = push.joints.joint[min(joint, push.jointCount - 1)];
  sum.row0 += weight * rows.row0;
  sum.row1 += weight * rows.row1;
  sum.row2 += weight * rows.row2;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  // Word by word: GPU-assisted validation takes a struct that is loaded whole for larger than it is.
  SkinVertex rest = SkinVertex(push.rest.vertex[i].x, push.rest.vertex[i].y, push.rest.vertex[i].z, push.rest.vertex[i].normal,
                               push.rest.vertex[i].joints01, push.rest.vertex[i].joints23, push.rest.vertex[i].weights);
  JointRows m = JointRows(vec4(0), vec4(0), vec4(0));
  blend(m, rest.joints01 & 0xffffu, rest.weights.x);
  blend(m, rest.joints01 >> 16, rest.weights.y);
  blend(m, rest.joints23 & 0xffffu, rest.weights.z);
  blend(m, rest.joints23 >> 16, rest.weights.w);
  vec3 place = vec3(rest.x, rest.y, rest.z);
  if (i >= push.firstBeating && i < push.lastBeating) place = push.centre + push.scale * (place - push.centre);
  vec4 position = vec4(place, 1), normal = vec4(unpackOctahedral(unpackSnorm(rest.normal)), 0);
  vec3 turned = vec3(dot(m.row0, normal), dot(m.row1, normal), dot(m.row2, normal));
  float size2 = dot(turned, turned);
  turned = size2 > 0 ? turned * inversesqrt(size2) : vec3(0, 0, 1);
  push.posed.vertex[i] = TubeVertex(dot(m.row0, position), dot(m.row1, position), dot(m.row2, position),
                                    packOctahedral(turned));
}
