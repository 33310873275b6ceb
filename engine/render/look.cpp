#include "render/look.h"

#include <algorithm>

#include "render/picture.h"

namespace vasa {

bool anyTranslucent(const Look& look) {
  return std::min({look.boneOpacity, look.heartOpacity, look.otherOpacity, look.arteryOpacity,
                   look.veinOpacity}) < 1;
}

bool draws(const Look& look, VesselKind kind) {
  if (kind == VesselKind::artery) return look.drawArteries;
  const bool isVein = kind == VesselKind::vein || kind == VesselKind::portalVein;
  return isVein ? look.drawVeins : look.drawOtherVessels;
}

float opacityOf(MeshRole role, const Look& look) {
  switch (role) {
    case MeshRole::bones:
      return look.drawBones ? look.boneOpacity : 0;
    case MeshRole::heart:
      return look.drawHeart ? look.heartOpacity : 0;
    case MeshRole::skin:
      return look.drawSkin ? look.skinOpacity : 0;
    case MeshRole::organs:
    case MeshRole::other:
      return look.drawOther ? look.otherOpacity : 0;
    case MeshRole::keepOut:
      break;
  }
  return 0;
}

std::optional<Look> lookNamed(std::string_view name) {
  Look look;
  look.occlusion = 1;
  if (name == "atlas") {
    look.background = {1, 1, 1, 1};
    return look;
  }
  look.style = LookStyle::clinical;
  look.background = {0.035f, 0.045f, 0.06f, 1};
  if (name == "clinical") return look;
  look.style = LookStyle::xray;
  look.background = {0.01f, 0.015f, 0.03f, 1};
  look.occlusion = 0;
  if (name == "xray") return look;
  return std::nullopt;
}

vec4 colourOf(VesselKind kind) {
  constexpr vec4 kColours[] = {{0.80f, 0.13f, 0.12f, 1},   // artery
                               {0.16f, 0.30f, 0.68f, 1},   // vein
                               {0.46f, 0.24f, 0.62f, 1},   // portal vein
                               {0.36f, 0.60f, 0.32f, 1},   // lymphatic
                               {0.62f, 0.62f, 0.62f, 1}};  // other
  return kColours[int(kind)];
}

vec4 colourOf(MeshRole role) {
  constexpr vec4 kOther{0.78f, 0.70f, 0.66f, 1};
  constexpr vec4 kColours[] = {{0.93f, 0.86f, 0.71f, 1},  // bones
                               {0.70f, 0.42f, 0.38f, 1},  // heart
                               {0.86f, 0.60f, 0.48f, 1},  // skin
                               {0.84f, 0.66f, 0.62f, 1},  // organs
                               kOther,
                               kOther};
  return kColours[int(role)];
}

vec3 linearColourOf(VesselKind kind) { return vec3(linearColour(colourOf(kind))); }

std::uint32_t packColour(vec4 colour) {
  std::uint32_t packed = 0;
  for (int i = 0; i < 4; ++i) {
    const float value = std::clamp(colour[i], 0.0f, 1.0f) * 255 + 0.5f;
    packed |= std::uint32_t(value) << (8 * i);
  }
  return packed;
}

}  // namespace vasa
