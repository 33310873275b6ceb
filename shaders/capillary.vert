#version 460
// Ribbons come in clip space from capillary.comp.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 colour;  // sRGB and opacity
layout(location = 2) in vec2 across;
layout(location = 0) out vec4 tint;   // linear
layout(location = 1) out vec2 side;   // in the camera's axes

vec3 linearOf(vec3 srgb) { return srgb * (srgb * (srgb * 0.305306011 + 0.682171111) + 0.012522878); }

void main() {
  gl_Position = clip;
  tint = vec4(linearOf(colour.rgb), colour.a);
  side = across;
}
