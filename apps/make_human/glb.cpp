#include "make_human/glb.h"

#include "io/glb_writer.h"

namespace vasa::human {
namespace {

using gltf::GlbWriter;
using Json = GlbWriter::Json;

class BodyWriter {
 public:
  BodyWriter() { file_.root["asset"]["generator"] = "vasa make_human"; }

  void addJoints(const Rig& rig) {
    Json joints = Json::array();
    std::vector<mat4> inverseBinds;
    for (int point : rig.joints) {
      const RigPoint& joint = rig.points[std::size_t(point)];
      const bool isRoot = joint.parent < 0;
      const vec3 offset =
          isRoot ? joint.position : joint.position - rig.points[std::size_t(joint.parent)].position;
      Json node = {{"name", joint.name}, {"translation", {offset.x, offset.y, offset.z}}};
      for (std::size_t child = 0; child < rig.joints.size(); ++child)
        if (rig.points[std::size_t(rig.joints[child])].parent == point) node["children"].push_back(child);
      if (isRoot) sceneNodes_.push_back(joint.joint);
      file_.root["nodes"].push_back(node);
      joints.push_back(joint.joint);
      mat4 inverse(1);
      inverse[3] = vec4(-joint.position, 1);
      inverseBinds.push_back(inverse);
    }
    const std::size_t accessor = file_.add(inverseBinds);
    file_.root["skins"].push_back({{"joints", joints}, {"inverseBindMatrices", accessor}, {"skeleton", 0}});
  }

  void addMesh(const SkinnedMesh& mesh) {
    std::vector<glm::u8vec4> joints;
    std::vector<vec4> weights;
    bool rigid = true;
    for (const SkinInfluence& influence : mesh.influences) {
      joints.emplace_back(influence.joints[0], influence.joints[1], influence.joints[2], influence.joints[3]);
      weights.push_back(influence.weights);
      rigid = rigid && influence.weights == vec4(1, 0, 0, 0);
    }
    Json attributes;
    attributes["POSITION"] = file_.add(mesh.mesh.positions, GlbWriter::vertices, true);
    attributes["NORMAL"] = file_.add(mesh.normals, GlbWriter::vertices);
    attributes["JOINTS_0"] = file_.add(joints, GlbWriter::vertices);
    if (rigid) {  // a quarter of the bytes
      attributes["WEIGHTS_0"] =
          file_.add(std::vector<glm::u8vec4>(weights.size(), {255, 0, 0, 0}), GlbWriter::vertices);
      file_.root["accessors"].back()["normalized"] = true;
    } else {
      attributes["WEIGHTS_0"] = file_.add(weights, GlbWriter::vertices);
    }
    const std::size_t indices = file_.add(mesh.mesh.triangles);
    Json& meshes = file_.root["meshes"];
    meshes.push_back({{"name", mesh.name},
                      {"primitives", Json::array({{{"attributes", attributes},
                                                   {"indices", indices},
                                                   {"material", addMaterial(mesh)}}})}});
    sceneNodes_.push_back(file_.root["nodes"].size());
    file_.root["nodes"].push_back({{"name", mesh.name}, {"mesh", meshes.size() - 1}, {"skin", 0}});
  }

  void addClip(const Clip& clip) {
    Json samplers = Json::array(), channels = Json::array();
    std::size_t times = 0;
    const auto channel = [&](const JointTracks& track, const char* path, std::size_t output) {
      channels.push_back(
          {{"sampler", samplers.size()}, {"target", {{"node", track.joint.value}, {"path", path}}}});
      samplers.push_back({{"input", times}, {"output", output}, {"interpolation", "LINEAR"}});
    };
    for (const JointTracks& track : clip.tracks) {
      if (&track == &clip.tracks.front()) times = file_.add(track.rotation.times, GlbWriter::data, true);
      std::vector<vec4> rotations;
      for (const quat& q : track.rotation.values) rotations.emplace_back(q.x, q.y, q.z, q.w);
      channel(track, "rotation", file_.add(rotations, GlbWriter::data));
      if (!track.translation.values.empty())
        channel(track, "translation", file_.add(track.translation.values, GlbWriter::data));
    }
    file_.root["animations"].push_back({{"name", clip.name}, {"samplers", samplers}, {"channels", channels}});
  }

  std::vector<std::byte> finish() {
    file_.root["scene"] = 0;
    file_.root["scenes"].push_back({{"nodes", sceneNodes_}});
    return file_.finish();
  }

 private:
  std::size_t addMaterial(const SkinnedMesh& mesh) {
    const vec4 c = mesh.colour;
    Json material = {
        {"name", mesh.name},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {c.x, c.y, c.z, c.w}}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}}};
    if (c.w < 1) material["alphaMode"] = "BLEND";
    Json& materials = file_.root["materials"];
    materials.push_back(material);
    return materials.size() - 1;
  }

  GlbWriter file_;
  Json sceneNodes_ = Json::array();
};

}  // namespace

std::vector<std::byte> writeGlb(const Rig& rig, const std::vector<SkinnedMesh>& meshes,
                                const std::vector<Clip>& clips) {
  BodyWriter writer;
  writer.addJoints(rig);
  for (const SkinnedMesh& mesh : meshes) writer.addMesh(mesh);
  for (const Clip& clip : clips) writer.addClip(clip);
  return writer.finish();
}

}  // namespace vasa::human
