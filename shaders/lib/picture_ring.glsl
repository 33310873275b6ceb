// Where a ring of a sweep lies on the picture: each coordinate is linear in the direction around the ring, up to the
// division. As exact as the rasteriser's own place within the margin of `snap` (engine/render/detail_pass.h).
#ifndef VASA_PICTURE_RING
#define VASA_PICTURE_RING
#include "lib/section.glsl"
#include "lib/visible.glsl"

struct PictureView {
  vec4 x, y, w;   // DetailView::picture
  vec4 near;      // plane
  PictureGrid grid;
};

struct PictureRing {
  vec3 centre, u, v;  // (x, y, w) of the centre, and what the directions u and v of the ring add
  bool near;          // some of it may lie before the near plane
};

vec3 onPicture(vec3 d, PictureView view) { return vec3(dot(view.x.xyz, d), dot(view.y.xyz, d), dot(view.w.xyz, d)); }

// @param polar, outward  as capPoint()'s
PictureRing pictureRing(Section section, vec2 polar, float outward, PictureView view) {
  vec3 centre = section.centre + (section.radius * outward * polar.y) * section.tangent;
  float radius = section.radius * polar.x;
  PictureRing ring;
  ring.centre = onPicture(centre, view) + vec3(view.x.w, view.y.w, view.w.w);
  ring.u = onPicture(radius * section.u, view);
  ring.v = onPicture(radius * section.v, view);
  ring.near = dot(view.near.xyz, centre) + view.near.w <= 1.01 * section.radius;
  return ring;
}

vec2 placeOn(PictureRing ring, vec2 direction) {
  vec3 place = ring.centre + direction.x * ring.u + direction.y * ring.v;
  return place.xy / place.z;
}

// Bits as in lib/strip.glsl. @param step  (cos, sin) of 2π/around
uint seenOfStrip(PictureRing first, PictureRing second, uint around, vec2 step, PictureView view) {
  vec2 direction = vec2(1, 0), a = placeOn(first, direction), d = placeOn(second, direction);
  uint mask = 0, k = 0;
  do {  // not a for: a CPU device would go round once more
    direction = vec2(direction.x * step.x - direction.y * step.y, direction.x * step.y + direction.y * step.x);
    vec2 b = placeOn(first, direction), c = placeOn(second, direction);
    mask |= seenOfQuad(a, b, c, d, view.grid) << (2 * k);
    a = b;
    d = c;
  } while (++k < around);
  return first.near || second.near ? 0xffffffffu >> (32 - 2 * around) : mask;
}

#endif
