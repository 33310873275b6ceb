// Mirrors engine/surface/octahedral.cpp.
#ifndef VASA_OCTAHEDRAL
#define VASA_OCTAHEDRAL

float signOf(float value) { return value < 0 ? -1.0 : 1.0; }

uint toSnorm16(float value) {
  precise float scaled = clamp(value, -1.0, 1.0) * 32767.0 + 0.5;
  return uint(int(floor(scaled))) & 0xffffu;
}

uint packOctahedral(vec3 unit) {
  precise float size = abs(unit.x) + abs(unit.y) + abs(unit.z);
  precise float x = unit.x / size, y = unit.y / size;
  if (unit.z < 0) {
    precise float foldedX = (1 - abs(y)) * signOf(x);
    y = (1 - abs(x)) * signOf(y);
    x = foldedX;
  }
  return toSnorm16(x) | toSnorm16(y) << 16;
}

vec2 unpackSnorm(uint bits) { return max(vec2(bitfieldExtract(int(bits), 0, 16), int(bits) >> 16) / 32767.0, -1.0); }

// x and y as the fixed-function fetch of two signed normalised 16-bit numbers gives them.
vec3 unpackOctahedral(vec2 folded) {
  float z = 1 - abs(folded.x) - abs(folded.y);
  float fold = max(-z, 0.0);
  return normalize(vec3(folded.x - signOf(folded.x) * fold, folded.y - signOf(folded.y) * fold, z));
}

#endif
