#version 460
// A thread a vessel: how many quads around the picture asks for. CPU reference: tests/reference/detail.h.
#extension GL_GOOGLE_include_directive : require
#include "lib/records.glsl"

layout(local_size_x = 64) in;
layout(push_constant, std430) uniform Push { AroundPush push; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  DetailView view = viewAt(push.view);
  uint m = view.around;
  if (m == 0) {
    float radius = uintBitsToFloat(push.sizes.size[i]), tolerance = view.tolerance;
    precise float thin = kThinShare * tolerance;
    bool coarse = tolerance >= kCoarse;
    m = coarse ? kMinAround : radius > tolerance ? kRoundAround : kThinAround;
    while (m < kMaxAround && (coarse || m >= kRoundAround)) {
      precise float error = radius * aroundErrorAt(push.tables, m);
      if (error <= (m < kRoundAround ? thin : tolerance)) break;
      ++m;
    }
    push.sizes.size[i] = 0;  // for the next frame
  }
  push.around.value[i] = m;
}
