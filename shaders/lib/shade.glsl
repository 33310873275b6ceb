// Light in the camera's axes (x right, y up, z towards the viewer): a key light over the viewer's left shoulder,
// a weak fill from the right, a bright sky over a warm ground. Linear colour throughout.
#ifndef VASA_SHADE
#define VASA_SHADE

const vec3 kKey = vec3(-0.408, 0.612, 0.677), kFill = vec3(0.857, -0.086, 0.508);  // unit, towards the light
const vec3 kKeyColour = vec3(1.06, 1.02, 0.95), kFillColour = vec3(0.24, 0.28, 0.35);
const vec3 kSky = vec3(0.52, 0.55, 0.60), kGround = vec3(0.22, 0.19, 0.17);

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
  return lobe * (0.04 + 0.96 * miss * miss * miss * miss * miss) * 8.0;
}

vec3 shade(vec3 base, vec3 normal, vec3 eye, vec3 worldUp) {
  vec3 ambient = mix(kGround, kSky, 0.5 + 0.5 * dot(normal, worldUp));
  float facing = clamp(dot(normal, eye), 0.0, 1.0);
  ambient *= 0.55 + 0.45 * facing;  // darker outlines set one tube off against the next
  vec3 light = ambient + kKeyColour * wrapped(dot(normal, kKey)) + kFillColour * wrapped(dot(normal, kFill));
  vec3 gloss = kKeyColour * highlight(normal, eye, kKey) + kFillColour * highlight(normal, eye, kFill);
  return base * light * 0.85 + gloss;
}

#endif
