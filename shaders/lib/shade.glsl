// Light in the camera's axes (x right, y up, z towards the viewer): a key light over the viewer's left shoulder, a weak
// fill from the right, a sky over a ground, and a rim where a surface turns away. Linear colour throughout; a filmic
// curve takes it to the picture.
#ifndef VASA_SHADE
#define VASA_SHADE

layout(constant_id = 0) const uint kStyle = 0;  // LookStyle: atlas, clinical, xray

struct Style {
  vec3 key, fill, sky, ground, rim;
  float outline;   // ambient light left where a surface turns away
  float gloss, exposure;
};

const Style kStyles[3] = Style[3](
    Style(vec3(1.42, 1.36, 1.24), vec3(0.22, 0.26, 0.34), vec3(0.50, 0.53, 0.58), vec3(0.24, 0.20, 0.17), vec3(0.0),
          0.40, 7.0, 0.80),
    Style(vec3(1.45, 1.42, 1.36), vec3(0.10, 0.16, 0.26), vec3(0.20, 0.23, 0.29), vec3(0.07, 0.06, 0.07),
          vec3(0.34, 0.48, 0.70), 0.70, 10.0, 0.95),
    Style(vec3(1.0), vec3(0.2), vec3(0.5), vec3(0.3), vec3(0.0), 1.0, 0.0, 1.0));

const vec3 kKey = vec3(-0.408, 0.612, 0.677), kFill = vec3(0.857, -0.086, 0.508);  // unit, towards the light

// Half a step of shade beyond the terminator keeps thin round tubes readable.
float wrapped(float cosine) {
  float value = max((cosine + 0.25) / 1.25, 0.0);
  return value * value;
}

// Blinn-Phong lobe with Schlick's Fresnel term, as much as a moist surface shows.
float highlight(vec3 normal, vec3 eye, vec3 light) {
  vec3 middle = normalize(eye + light);
  float lobe = max(dot(normal, middle), 0.0);
  lobe *= lobe; lobe *= lobe; lobe *= lobe; lobe *= lobe; lobe *= lobe;  // to the 32nd
  float miss = 1 - max(dot(eye, middle), 0.0);
  return lobe * (0.04 + 0.96 * miss * miss * miss * miss * miss);
}

// A filmic curve (Narkowicz 2015, a fit to the ACES reference rendering transform).
vec3 filmic(vec3 light) {
  return clamp(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), 0.0, 1.0);
}

vec3 ambientLight(vec3 normal, vec3 worldUp) {
  return mix(kStyles[kStyle].ground, kStyles[kStyle].sky, 0.5 + 0.5 * dot(normal, worldUp));
}

vec3 shade(vec3 base, vec3 normal, vec3 eye, vec3 worldUp) {
  Style style = kStyles[kStyle];
  float facing = clamp(dot(normal, eye), 0.0, 1.0), away = 1 - facing;
  vec3 ambient = ambientLight(normal, worldUp) * mix(style.outline, 1.0, facing);
  vec3 light = ambient + style.key * wrapped(dot(normal, kKey)) + style.fill * wrapped(dot(normal, kFill));
  vec3 gloss = style.key * (style.gloss * highlight(normal, eye, kKey));
  vec3 rim = style.rim * (away * away * away * (0.5 + 0.5 * dot(normal, worldUp)));
  return filmic((base * light + gloss + rim) * style.exposure);
}

#endif
