// From 0 to 1, level at both ends. Mirrors engine/surface/patch_smooth.cpp.
#ifndef VASA_RAMP
#define VASA_RAMP

float ramp(float x) {
  precise float t = clamp(x, 0.0, 1.0);
  precise float share = t * t * (3.0 - 2.0 * t);
  return share;
}

#endif
