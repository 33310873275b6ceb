#pragma once
#include <cstdint>
#include <string_view>

#include "body/body.h"

namespace vasa {

/// What a mesh of the body is. The one place that says what its name means.
enum class MeshRole : std::uint8_t { bones, heart, skin, organs, other, keepOut };

/// The role by a mesh's name: a name that begins with "skin" -> skin (body/skin_recognition.h), with
/// "keep-out"
/// -> keepOut; else "bones", "skeleton", "cartilage", "teeth" -> bones; "heart" -> heart; "skin", "body" ->
/// skin; "organ", "brain", "lung", "liver", "kidney", "spleen", "stomach" -> organs; otherwise other. Upper
/// and lower case are alike.
MeshRole roleNamed(std::string_view name);

/// Whether vessels keep out of a mesh: bones, heart and what is named keep-out (which is never drawn), and of
/// what is named otherwise what moves by rigid parts. Vessels run through organs and below the skin. A heart
/// that is named as an organ ("organ: heart") is drawn as a heart is, but vessels lie in its wall and
/// grooves.
bool isSolid(const SkinnedMesh& mesh);

}  // namespace vasa
