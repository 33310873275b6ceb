#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "body/mesh_role.h"
#include "math/types.h"
#include "network/network.h"

namespace vasa {

/// The light: atlas for a white page, clinical for a dark screen, xray for surfaces that let light through.
enum class LookStyle : std::uint8_t { atlas, clinical, xray };

/// What is shown, and in which colours. Colours are sRGB in [0, 1] with straight alpha.
struct Look {
  LookStyle style = LookStyle::atlas;
  vec4 background{0.93f, 0.94f, 0.95f, 1};
  bool transparent = false;  ///< picture with alpha: the background counts for nothing
  bool drawArteries = true;
  bool drawVeins = true;         ///< portal vein, too
  bool drawOtherVessels = true;  ///< lymph vessels and unknown ones
  bool drawBones = true;
  bool drawHeart = true;
  bool drawSkin = true;
  bool drawOther = true;  ///< organs other than the heart, and meshes of unknown names
  /// In [0, 1], 0: not drawn. Of what is neither whole nor skin or capillaries, a share of each pixel's
  /// samples is drawn, the remainder by a pattern over pixels: with one sample a pixel it shows as fine
  /// grain.
  float boneOpacity = 1, heartOpacity = 1, otherOpacity = 1, arteryOpacity = 1, veinOpacity = 1;
  float capillaryOpacity = 1;
  float skinOpacity = 0.3f;  ///< in [0, 1]: less where the skin is seen face on, more towards its outline
  /// Strength of ambient occlusion, 0 (none, fast) to 1; not in xray.
  float occlusion = 0;

  bool operator==(const Look&) const = default;
};

/// Whether some bone, organ or vessel lets others shine through by its opacity.
bool anyTranslucent(const Look& look);

/// Whether vessels of a kind are drawn.
bool draws(const Look& look, VesselKind kind);

/// With which meshes of a role are drawn; 0: not at all. Organs have opacities of their own besides.
float opacityOf(MeshRole role, const Look& look);

/// The presets "atlas", "clinical" and "xray": style, background, skin and occlusion.
std::optional<Look> lookNamed(std::string_view name);

/// Arteries red, veins blue, portal vein purple, lymph vessels green, others grey.
vec4 colourOf(VesselKind kind);
vec4 colourOf(MeshRole role);
/// Of a kind of vessel, linear, as files for other programs have colours.
vec3 linearColourOf(VesselKind kind);

/// A colour as the shaders read it: 8 bits each, red lowest, alpha highest.
std::uint32_t packColour(vec4 colour);

}  // namespace vasa
