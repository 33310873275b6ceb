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
  std::vector<SkinnedMesh>
      meshes;  ///< skin, bones, what vessels keep out of at the heart, cartilage, teeth, organs
  std::vector<Clip> clips;
  Network vessels;
};

/// Reads joints, parts, sections, bones, bone_forms, organs, organ_forms, clips, clip_keys, couplings,
/// vessels and growth
/// (.csv) and makes the human of them.
Result<Human> makeHuman(const std::filesystem::path& tables, const GrowOptions& options = {});

}  // namespace vasa::human
