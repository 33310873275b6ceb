// Where a vertex lies on the picture, for lib/visible.glsl.
#ifndef VASA_PICTURE_PLACE
#define VASA_PICTURE_PLACE
#include "lib/visible.glsl"

DetailView view;  // set before; no argument, as a CPU device would copy it

vec2 placeOf(vec3 position) {
  vec4 place = vec4(position, 1);
  return dot(view.planes[4], place) < 0
             ? vec2(kBehind)
             : vec2(dot(view.picture[0], place), dot(view.picture[1], place)) / dot(view.picture[2], place);
}

#endif
