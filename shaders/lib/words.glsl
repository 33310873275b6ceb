// Vectors out of words of 64 bits (shared/tubes.h).
#ifndef VASA_WORDS
#define VASA_WORDS

vec4 vec4Of(u64vec2 words) { return uintBitsToFloat(uvec4(unpack32(words.x), unpack32(words.y))); }

#endif
