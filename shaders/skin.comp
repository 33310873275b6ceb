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

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  SkinVertex rest = push.rest.vertex[i];
  uvec4 joints = uvec4(rest.joints01 & 0xffffu, rest.joints01 >> 16, rest.joints23 & 0xffffu, rest.joints23 >> 16);
  joints = min(joints, uvec4(push.jointCount - 1));
  mat4 blend = rest.weights.x * push.joints.joint[joints.x];
  blend += rest.weights.y * push.joints.joint[joints.y];
  blend += rest.weights.z * push.joints.joint[joints.z];
  blend += rest.weights.w * push.joints.joint[joints.w];
  vec3 position = (blend * vec4(rest.x, rest.y, rest.z, 1)).xyz;
  vec3 normal = mat3(blend) * unpackOctahedral(unpackSnorm(rest.normal));
  float size2 = dot(normal, normal);
  normal = size2 > 0 ? normal * inversesqrt(size2) : vec3(0, 0, 1);
  push.posed.vertex[i] = TubeVertex(position.x, position.y, position.z, packOctahedral(normal));
}
