#include "make_human/glb.h"

#include <algorithm>
#include <span>

#include "io/glb_writer.h"

namespace vasa::human {
namespace {

using gltf::GlbWriter;
using Json = GlbWriter::Json;

/// A place between two solids of a mesh: no triangle from here on has a vertex before it.
struct Cut {
  std::size_t triangle = 0, vertex = 0;
};

/// Where to cut a mesh of many solids, one after another, for parts of few enough vertices; its ends, too.
std::vector<Cut> cutsOf(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> least(mesh.triangles.size());  // of all triangles from each one on
  std::uint32_t low = std::uint32_t(mesh.positions.size());
  for (std::size_t i = mesh.triangles.size(); i-- > 0;) {
    const uvec3 t = mesh.triangles[i];
    least[i] = low = std::min({low, t.x, t.y, t.z});
  }
  std::vector<Cut> cuts{{}};
  Cut last;  // the last place that may be cut
  std::size_t end = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (least[i] >= end) last = {i, end};
    const uvec3 t = mesh.triangles[i];
    end = std::max({end, std::size_t(t.x) + 1, std::size_t(t.y) + 1, std::size_t(t.z) + 1});
    if (end - cuts.back().vertex > GlbWriter::kShortIndices && last.vertex > cuts.back().vertex)
      cuts.push_back(last);
  }
  cuts.push_back({mesh.triangles.size(), mesh.positions.size()});
  return cuts;
}

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
    const std::size_t material = addMaterial(mesh);
    Json primitives = Json::array();
    const std::vector<Cut> cuts = cutsOf(mesh.mesh);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      primitives.push_back(
          {{"attributes", attributesOf(mesh, cuts[i].vertex, cuts[i + 1].vertex - cuts[i].vertex)},
           {"indices", indicesOf(mesh.mesh, cuts[i], cuts[i + 1])},
           {"material", material}});
    Json& meshes = file_.root["meshes"];
    meshes.push_back({{"name", mesh.name}, {"primitives", primitives}});
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
  Json attributesOf(const SkinnedMesh& mesh, std::size_t first, std::size_t count) {
    std::vector<glm::u8vec4> joints;
    std::vector<vec4> weights;
    bool rigid = true;
    for (const SkinInfluence& influence : std::span(mesh.influences).subspan(first, count)) {
      joints.emplace_back(influence.joints[0], influence.joints[1], influence.joints[2], influence.joints[3]);
      weights.push_back(influence.weights);
      rigid = rigid && influence.weights == vec4(1, 0, 0, 0);
    }
    Json attributes;
    attributes["POSITION"] =
        file_.add(std::span(mesh.mesh.positions).subspan(first, count), GlbWriter::vertices, true);
    attributes["NORMAL"] = file_.add(std::span(mesh.normals).subspan(first, count), GlbWriter::vertices);
    attributes["JOINTS_0"] = file_.add(joints, GlbWriter::vertices);
    if (rigid) {  // a quarter of the bytes
      attributes["WEIGHTS_0"] =
          file_.add(std::vector<glm::u8vec4>(weights.size(), {255, 0, 0, 0}), GlbWriter::vertices);
      file_.root["accessors"].back()["normalized"] = true;
    } else {
      attributes["WEIGHTS_0"] = file_.add(weights, GlbWriter::vertices);
    }
    return attributes;
  }

  std::size_t indicesOf(const TriangleMesh& mesh, const Cut& from, const Cut& to) {
    std::vector<uvec3> triangles(mesh.triangles.begin() + std::ptrdiff_t(from.triangle),
                                 mesh.triangles.begin() + std::ptrdiff_t(to.triangle));
    for (uvec3& t : triangles) t -= std::uint32_t(from.vertex);
    return file_.add(triangles);
  }

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
