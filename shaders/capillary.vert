#version 460
// Ribbons come in clip space from capillary.comp, vertices of their two sides by turns.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 colour;  // sRGB and opacity
layout(location = 2) in vec2 across;
layout(location = 0) out vec4 tint;  // linear
layout(location = 1) out vec3 side;  // normal in the camera's x and y; where across the ribbon, -1 to 1

vec3 linearOf(vec3 srgb) { return srgb * (srgb * (srgb * 0.305306011 + 0.682171111) + 0.012522878); }

void main() {
  gl_Position = clip;
  tint = vec4(linearOf(colour.rgb), colour.a);
  side = vec3(across, (gl_VertexIndex & 1) == 0 ? 1.0 : -1.0);
}
