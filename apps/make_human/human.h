#pragma once
#include "body/body.h"
#include "make_human/grow.h"
#include "make_human/rig.h"
#include "make_human/shape.h"
#include "network/network.h"

namespace vasa::human {

/// Everything that the tables of a folder describe.
struct Human {
  Rig rig;
  Shape skinShape;
  std::vector<SkinnedMesh> meshes;  ///< skin, bones, heart, organs, cartilage, teeth
  std::vector<Clip> clips;
  Network vessels;
};

/// Reads joints, parts, sections, bones, bone_forms, clips, clip_keys, vessels and growth (.csv) and makes
/// the human of them.
Result<Human> makeHuman(const std::filesystem::path& tables, const GrowOptions& options = {});

}  // namespace vasa::human
