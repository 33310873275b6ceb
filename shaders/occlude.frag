#version 460
// Takes occlusion off what is drawn; blended by multiplication.
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 0) uniform texture2D lights;  // what smooth.frag found
layout(location = 0) out vec4 pixel;

void main() {
  float light = texelFetch(lights, ivec2(gl_FragCoord.xy), 0).x;
  // What little light comes out of a crease has met its colour often: less is lost of red than of blue.
  pixel = vec4(pow(vec3(light), vec3(0.92, 1.02, 1.06)), 1);
}
