#include "make_human/human.h"

#include <algorithm>
#include <iterator>

#include "make_human/bones.h"
#include "make_human/clips.h"
#include "make_human/organs.h"
#include "make_human/skin.h"
#include "make_human/skin_fit.h"
#include "make_human/vessels.h"

namespace vasa::human {

Result<Human> makeHuman(const std::filesystem::path& tables, const GrowOptions& options) {
  Human human;
  Result<Rig> rig = Rig::read(tables / "joints.csv");
  if (!rig.ok()) return rig.error();
  human.rig = std::move(rig).value();
  const auto shapeOf = [&](std::string_view mesh) {
    return readShape(tables / "parts.csv", tables / "sections.csv", mesh, human.rig);
  };
  Result<Shape> skin = shapeOf("skin"), heart = shapeOf("heart"), brain = shapeOf("brain");
  for (const Result<Shape>* shape : {&skin, &heart, &brain})
    if (!shape->ok()) return shape->error();
  human.skinShape = std::move(skin).value();
  const Result<std::vector<BoneForm>> forms =
      readBoneForms(tables / "bones.csv", tables / "bone_forms.csv", human.rig);
  if (!forms.ok()) return forms.error();
  std::vector<SkinnedMesh> bones = makeBones(*forms, human.rig);
  const SkinnedMesh skeleton = united(bones);
  human.meshes = {makeSkin(human.skinShape, human.rig),
                  std::move(bones[0]),
                  makeSolid("keep-out: heart", {0.55f, 0.13f, 0.11f, 0}, *heart, human.rig),
                  std::move(bones[1]),
                  std::move(bones[2]),
                  makeSolid("organ: brain", {0.66f, 0.39f, 0.34f, 0.3f}, *brain, human.rig)};
  Result<std::vector<Clip>> clips =
      makeClips(tables / "clips.csv", tables / "clip_keys.csv", tables / "couplings.csv", human.rig);
  if (!clips.ok()) return clips.error();
  human.clips = std::move(clips).value();
  Body posed = bodyOf(human.rig, {human.meshes.front(), skeleton}, human.clips);
  fitSkin(posed);
  human.meshes.front() = std::move(posed.meshes.front());
  const Aabb box = human.meshes.front().mesh.bounds();
  const Surroundings around{human.skinShape, Solid(skeleton.mesh), Solid(human.meshes[2].mesh)};
  std::vector<SkinnedMesh> probed = human.meshes;
  probed[1] = skeleton;
  probed.resize(3);
  const MotionProbe probe(bodyOf(human.rig, std::move(probed), human.clips));
  Result<std::vector<BoneForm>> organForms = readOrganForms(tables, human.rig);
  if (!organForms.ok()) return organForms.error();
  Result<Network> vessels =
      makeVessels(tables, human.rig, around, *organForms, probe, box.high.y - box.low.y, options);
  if (!vessels.ok()) return vessels.error();
  human.vessels = std::move(vessels).value();
  Result<std::vector<SkinnedMesh>> organs =
      makeOrgans(tables, std::move(organForms).value(), human.rig, human.vessels);
  if (!organs.ok()) return organs.error();
  std::ranges::move(*organs, std::back_inserter(human.meshes));
  return human;
}

}  // namespace vasa::human
