#pragma once
#include <cstdint>
#include <string_view>

#include "body/body.h"

namespace vasa {

/// What a mesh of the body is. The one place that says what its name means.
enum class MeshRole : std::uint8_t { bones, heart, skin, organs, other };

/// The role by a mesh's name: a name that begins with "skin" -> skin (body/skin_recognition.h); else "bones",
/// "skeleton", "cartilage", "teeth" -> bones; "heart" -> heart; "skin", "body" -> skin; "organs", "brain",
/// "lung", "liver", "kidney", "spleen", "stomach" -> organs; otherwise other. Upper and lower case are alike.
MeshRole roleNamed(std::string_view name);

/// Whether vessels keep out of a mesh: bones and heart, and of what is named otherwise what moves by rigid
/// parts. Vessels run through organs and below the skin.
bool isSolid(const SkinnedMesh& mesh);

}  // namespace vasa
