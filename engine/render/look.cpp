#include "render/look.h"

#include <algorithm>
#include <cmath>

namespace vasa {

bool anyTranslucent(const Look& look) {
  return std::min({look.boneOpacity, look.heartOpacity, look.otherOpacity, look.arteryOpacity,
                   look.veinOpacity}) < 1;
}

bool draws(const Look& look, VesselKind kind) {
  switch (kind) {
    case VesselKind::artery:
      return look.drawArteries;
    case VesselKind::vein:
    case VesselKind::portalVein:
      return look.drawVeins;
    case VesselKind::lymphatic:
    case VesselKind::other:
      break;
  }
  return look.drawOtherVessels;
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
  switch (kind) {
    case VesselKind::artery:
      return {0.80f, 0.13f, 0.12f, 1};
    case VesselKind::vein:
      return {0.16f, 0.30f, 0.68f, 1};
    case VesselKind::portalVein:
      return {0.46f, 0.24f, 0.62f, 1};
    case VesselKind::lymphatic:
      return {0.36f, 0.60f, 0.32f, 1};
    case VesselKind::other:
      break;
  }
  return {0.62f, 0.62f, 0.62f, 1};
}

vec4 colourOf(MeshRole role) {
  switch (role) {
    case MeshRole::bones:
      return {0.93f, 0.86f, 0.71f, 1};
    case MeshRole::heart:
      return {0.70f, 0.42f, 0.38f, 1};
    case MeshRole::skin:
      return {0.86f, 0.60f, 0.48f, 1};
    case MeshRole::organs:
      return {0.84f, 0.66f, 0.62f, 1};
    case MeshRole::other:
    case MeshRole::keepOut:
      break;
  }
  return {0.78f, 0.70f, 0.66f, 1};
}

vec3 linearColourOf(VesselKind kind) {
  const vec4 colour = colourOf(kind);
  const auto linear = [](float c) {
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
  };
  return {linear(colour.x), linear(colour.y), linear(colour.z)};
}

std::uint32_t packColour(vec4 colour) {
  std::uint32_t packed = 0;
  for (int i = 0; i < 4; ++i) {
    const float value = std::clamp(colour[i], 0.0f, 1.0f) * 255 + 0.5f;
    packed |= std::uint32_t(value) << (8 * i);
  }
  return packed;
}

}  // namespace vasa
