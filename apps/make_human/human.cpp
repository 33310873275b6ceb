#include "make_human/human.h"

#include "make_human/bones.h"
#include "make_human/clips.h"
#include "make_human/skin.h"
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
  Result<Shape> skin = shapeOf("skin"), forms = shapeOf("bones"), heart = shapeOf("heart"),
                organs = shapeOf("organs");
  for (const Result<Shape>* shape : {&skin, &forms, &heart, &organs})
    if (!shape->ok()) return shape->error();
  human.skinShape = std::move(skin).value();
  Result<SkinnedMesh> bones = makeBones(tables / "bones.csv", *forms, human.rig);
  if (!bones.ok()) return bones.error();
  human.meshes = {makeSkin(human.skinShape, human.rig), std::move(bones).value(),
                  makeSolid("heart", {0.55f, 0.13f, 0.11f, 1}, *heart, human.rig),
                  makeSolid("organs", {0.66f, 0.39f, 0.34f, 0.3f}, *organs, human.rig)};
  Result<std::vector<Clip>> clips = makeClips(tables / "clips.csv", tables / "clip_keys.csv", human.rig);
  if (!clips.ok()) return clips.error();
  human.clips = std::move(clips).value();
  const Aabb box = human.meshes.front().mesh.bounds();
  const Surroundings around{human.skinShape, Solid(human.meshes[1].mesh), Solid(human.meshes[2].mesh)};
  const MotionProbe probe(bodyOf(human.rig, human.meshes, human.clips));
  Result<Network> vessels = makeVessels(tables, human.rig, around, probe, box.high.y - box.low.y, options);
  if (!vessels.ok()) return vessels.error();
  human.vessels = std::move(vessels).value();
  return human;
}

}  // namespace vasa::human
