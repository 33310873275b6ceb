// Memory in words of 64 bits. A CPU device loads and stores lane by lane and word by word, and wide words are a tenth of
// a frame: devices with shaderInt64 run what cmake/shaders.cmake compiles with VASA_INT64, others the same code on uvec2.
#ifndef VASA_WORDS
#define VASA_WORDS

#ifdef VASA_INT64
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#define Word uint64_t
#define Word2 u64vec2
uvec2 halvesOf(Word word) { return unpack32(word); }
Word wordOf(uvec2 halves) { return pack64(halves); }
uvec4 halvesOf(Word2 words) { return uvec4(unpack32(words.x), unpack32(words.y)); }
Word2 wordsOf(uvec4 halves) { return Word2(pack64(halves.xy), pack64(halves.zw)); }
#else
#define Word uvec2
#define Word2 uvec4
uvec2 halvesOf(Word word) { return word; }
Word wordOf(uvec2 halves) { return halves; }
uvec4 halvesOf(Word2 words) { return words; }
Word2 wordsOf(uvec4 halves) { return halves; }
#endif

vec2 vec2Of(Word word) { return uintBitsToFloat(halvesOf(word)); }
Word wordOf(vec2 a) { return wordOf(floatBitsToUint(a)); }
vec4 vec4Of(Word2 words) { return uintBitsToFloat(halvesOf(words)); }

// Of a TubeVertex.
vec3 placeIn(Word2 words) { return vec4Of(words).xyz; }
uint normalIn(Word2 words) { return halvesOf(words).w; }
Word2 vertexWords(vec3 place, uint normal) { return wordsOf(uvec4(floatBitsToUint(place), normal)); }

#endif
