// Vectors in and out of words of 64 bits (shared/tubes.h).
#ifndef VASA_WORDS
#define VASA_WORDS

vec4 vec4Of(u64vec2 words) { return uintBitsToFloat(uvec4(unpack32(words.x), unpack32(words.y))); }

// Of a TubeVertex.
vec3 placeIn(u64vec2 words) { return vec3(uintBitsToFloat(unpack32(words.x)), uintBitsToFloat(unpack32(words.y).x)); }
uint normalIn(u64vec2 words) { return unpack32(words.y).y; }
u64vec2 vertexWords(vec3 place, uint normal) {
  uvec3 bits = floatBitsToUint(place);
  return u64vec2(pack64(bits.xy), pack64(uvec2(bits.z, normal)));
}

#endif
