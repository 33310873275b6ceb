#pragma once
#include <vector>

#include "io/gltf_builder.h"
#include "math/types.h"

namespace vasa::test {

/// Adds nodes that are named and hang on one another as a person's limbs, the hips first, without meshes.
/// @param apart  false: all in one place, as an atlas groups what it has
/// @return how many
inline std::size_t addPersonPieces(GltfBuilder& file, bool apart = true) {
  struct Piece {
    const char* name;
    int parent;
    vec3 place;
  };
  const std::vector<Piece> pieces{{"Hips", -1, {0, 1, 0}},           {"Spine", 0, {0, 0.2f, 0}},
                                  {"Head", 1, {0, 0.4f, 0}},         {"LeftArm", 1, {0.2f, 0.3f, 0}},
                                  {"LeftForeArm", 3, {0.3f, 0, 0}},  {"LeftHand", 4, {0.25f, 0, 0}},
                                  {"RightArm", 1, {-0.2f, 0.3f, 0}}, {"RightForeArm", 6, {-0.3f, 0, 0}},
                                  {"RightHand", 7, {-0.25f, 0, 0}},  {"LeftUpLeg", 0, {0.1f, 0, 0}},
                                  {"LeftLeg", 9, {0, -0.45f, 0}},    {"LeftFoot", 10, {0, -0.45f, 0}},
                                  {"RightUpLeg", 0, {-0.1f, 0, 0}},  {"RightLeg", 12, {0, -0.45f, 0}},
                                  {"RightFoot", 13, {0, -0.45f, 0}}};
  for (const Piece& piece : pieces) {
    const auto node = file.document["nodes"].size();
    const vec3 place = apart ? piece.place : vec3(0);
    file.add("nodes", {{"name", piece.name}, {"translation", {place.x, place.y, place.z}}});
    if (piece.parent >= 0) file.document["nodes"][std::size_t(piece.parent)]["children"].push_back(node);
  }
  return pieces.size();
}

}  // namespace vasa::test
