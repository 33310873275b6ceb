#version 460
// One workgroup for all patches: those that their rings strain, and the dispatch that smooths them.
// CPU reference: patchSmoothing() of engine/surface/patch_smooth.h.
#extension GL_GOOGLE_include_directive : require
#include "lib/ramp.glsl"
#include "lib/section.glsl"
#include "lib/words.glsl"
#include "shared/patch.h"

layout(local_size_x = kStrainThreads) in;
layout(push_constant, std430) uniform Push { PatchStrainPush push; };

const float kLeastStrain = 1.0, kFullStrain = 2.0;  // of the rings' radii

shared uint strained;

vec3 carried(uint seam, vec3 p) {
  vec4 x = vec4Of(push.joints.row[3 * seam]), y = vec4Of(push.joints.row[3 * seam + 1]), z = vec4Of(push.joints.row[3 * seam + 2]);
  precise vec3 place = vec3(x.x * p.x + x.y * p.y + x.z * p.z + x.w, y.x * p.x + y.y * p.y + y.z * p.z + y.w,
                            z.x * p.x + z.y * p.y + z.z * p.z + z.w);
  return place;
}

float apartAt(uint a, uint b, vec3 place) {
  precise vec3 apart = carried(a, place) - carried(b, place);
  return sqrt(dotOf(apart, apart));
}

float disagreement(uint a, uint b) {
  precise float sum = apartAt(a, b, push.seams.seam[a].centre) + apartAt(a, b, push.seams.seam[b].centre);
  precise float share = sum / (push.seams.seam[a].radius + push.seams.seam[b].radius);
  return share;
}

float smoothingOf(PatchWall wall) {
  float most = 0;
  for (uint i = wall.firstSeam; i < wall.firstSeam + wall.seamCount; ++i)
    for (uint j = i + 1; j < wall.firstSeam + wall.seamCount; ++j) most = max(most, disagreement(i, j));
  precise float strain = (most - kLeastStrain) / (kFullStrain - kLeastStrain);
  return ramp(strain);
}

void main() {
  if (gl_LocalInvocationID.x == 0) strained = 0;
  barrier();
  for (uint i = gl_LocalInvocationID.x; i < push.count; i += kStrainThreads) {
    float share = smoothingOf(push.walls.wall[i]);
    if (share > 0) push.strained.patches[atomicAdd(strained, 1)] = StrainedPatch(i, share);
  }
  barrier();
  if (gl_LocalInvocationID.x > 0) return;
  push.dispatch.x = strained;
  push.dispatch.y = 1;
  push.dispatch.z = 1;
}
