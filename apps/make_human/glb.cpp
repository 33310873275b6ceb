#include "make_human/glb.h"

#include <cstring>
#include <nlohmann/json.hpp>

namespace vasa::human {
namespace {

using Json = nlohmann::ordered_json;

enum ComponentType { kUnsignedByte = 5121, kUnsignedInt = 5125, kFloat = 5126 };
enum Target { kNoTarget = 0, kVertices = 34962, kIndices = 34963 };

class GlbWriter {
 public:
  GlbWriter() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "vasa make_human"}};
    for (const char* list :
         {"scenes", "nodes", "meshes", "materials", "skins", "animations", "accessors", "bufferViews"})
      root_[list] = Json::array();
  }

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
      root_["nodes"].push_back(node);
      joints.push_back(joint.joint);
      mat4 inverse(1);
      inverse[3] = vec4(-joint.position, 1);
      inverseBinds.push_back(inverse);
    }
    const std::size_t accessor = addAccessor(inverseBinds, "MAT4", kFloat, kNoTarget);
    root_["skins"].push_back({{"joints", joints}, {"inverseBindMatrices", accessor}, {"skeleton", 0}});
  }

  void addMesh(const SkinnedMesh& mesh) {
    std::vector<glm::u8vec4> joints;
    std::vector<vec4> weights;
    for (const SkinInfluence& influence : mesh.influences) {
      joints.emplace_back(influence.joints[0], influence.joints[1], influence.joints[2], influence.joints[3]);
      weights.push_back(influence.weights);
    }
    Json attributes;
    const Aabb box = mesh.mesh.bounds();
    const std::size_t positions = addAccessor(mesh.mesh.positions, "VEC3", kFloat, kVertices);
    root_["accessors"][positions]["min"] = {box.low.x, box.low.y, box.low.z};
    root_["accessors"][positions]["max"] = {box.high.x, box.high.y, box.high.z};
    attributes["POSITION"] = positions;
    attributes["NORMAL"] = addAccessor(mesh.normals, "VEC3", kFloat, kVertices);
    attributes["JOINTS_0"] = addAccessor(joints, "VEC4", kUnsignedByte, kVertices);
    attributes["WEIGHTS_0"] = addAccessor(weights, "VEC4", kFloat, kVertices);
    const std::size_t indices = addAccessor(mesh.mesh.triangles, "SCALAR", kUnsignedInt, kIndices, 3);
    root_["meshes"].push_back({{"name", mesh.name},
                               {"primitives", Json::array({{{"attributes", attributes},
                                                            {"indices", indices},
                                                            {"material", addMaterial(mesh)}}})}});
    sceneNodes_.push_back(root_["nodes"].size());
    root_["nodes"].push_back({{"name", mesh.name}, {"mesh", root_["meshes"].size() - 1}, {"skin", 0}});
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
      if (&track == &clip.tracks.front()) {
        times = addAccessor(track.rotation.times, "SCALAR", kFloat, kNoTarget);
        root_["accessors"][times]["min"] = {track.rotation.times.front()};
        root_["accessors"][times]["max"] = {track.rotation.times.back()};
      }
      std::vector<vec4> rotations;
      for (const quat& q : track.rotation.values) rotations.emplace_back(q.x, q.y, q.z, q.w);
      channel(track, "rotation", addAccessor(rotations, "VEC4", kFloat, kNoTarget));
      if (!track.translation.values.empty())
        channel(track, "translation", addAccessor(track.translation.values, "VEC3", kFloat, kNoTarget));
    }
    root_["animations"].push_back({{"name", clip.name}, {"samplers", samplers}, {"channels", channels}});
  }

  std::vector<std::byte> finish() {
    root_["scene"] = 0;
    root_["scenes"].push_back({{"nodes", sceneNodes_}});
    root_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    for (const char* list : {"meshes", "materials", "skins", "animations"})
      if (root_[list].empty()) root_.erase(list);
    std::string text = root_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::byte> file;
    const auto word = [&file](std::uint32_t value) { append(file, &value, 4); };
    word(0x46546c67u);  // "glTF"
    word(2);
    word(std::uint32_t(12 + 8 + text.size() + 8 + bytes_.size()));
    word(std::uint32_t(text.size()));
    word(0x4e4f534au);  // "JSON"
    append(file, text.data(), text.size());
    word(std::uint32_t(bytes_.size()));
    word(0x004e4942u);  // "BIN"
    append(file, bytes_.data(), bytes_.size());
    return file;
  }

 private:
  static void append(std::vector<std::byte>& to, const void* from, std::size_t size) {
    const std::byte* first = static_cast<const std::byte*>(from);
    to.insert(to.end(), first, first + size);
  }

  template <class T>
  std::size_t addAccessor(const std::vector<T>& values, const char* type, ComponentType component,
                          Target target, std::size_t scalarsPerValue = 1) {
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (target != kNoTarget) view["target"] = int(target);
    append(bytes_, values.data(), values.size() * sizeof(T));
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    root_["bufferViews"].push_back(view);
    root_["accessors"].push_back({{"bufferView", root_["bufferViews"].size() - 1},
                                  {"componentType", int(component)},
                                  {"count", values.size() * scalarsPerValue},
                                  {"type", type}});
    return root_["accessors"].size() - 1;
  }

  std::size_t addMaterial(const SkinnedMesh& mesh) {
    const vec4 c = mesh.colour;
    Json material = {
        {"name", mesh.name},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {c.x, c.y, c.z, c.w}}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}}};
    if (c.w < 1) material["alphaMode"] = "BLEND";
    root_["materials"].push_back(material);
    return root_["materials"].size() - 1;
  }

  Json root_;
  Json sceneNodes_ = Json::array();
  std::vector<std::byte> bytes_;
};

}  // namespace

std::vector<std::byte> writeGlb(const Rig& rig, const std::vector<SkinnedMesh>& meshes,
                                const std::vector<Clip>& clips) {
  GlbWriter writer;
  writer.addJoints(rig);
  for (const SkinnedMesh& mesh : meshes) writer.addMesh(mesh);
  for (const Clip& clip : clips) writer.addClip(clip);
  return writer.finish();
}

}  // namespace vasa::human
