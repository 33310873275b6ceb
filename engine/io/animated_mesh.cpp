#include "io/animated_mesh.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "io/glb_writer.h"
#include "io/words.h"

namespace vasa {
namespace {

using gltf::GlbWriter;
using Json = GlbWriter::Json;

Json material(const AnimatedMesh::Part& part) {
  return {{"name", part.name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {part.colour.x, part.colour.y, part.colour.z, 1}},
            {"metallicFactor", 0},
            {"roughnessFactor", 0.45}}}};
}

Json vesselList(const AnimatedMesh& mesh) {
  Json list = Json::array();
  for (const AnimatedMesh::Label& label : mesh.labels) {
    Json vessel = {{"name", label.name}, {"kind", label.kind}};
    if (!label.ontologyId.empty()) vessel["id"] = label.ontologyId;
    list.push_back(std::move(vessel));
  }
  return list;
}

void addWeights(GlbWriter& writer, const AnimatedMesh& mesh) {
  std::vector<float> flat;
  for (const auto& row : mesh.weights) flat.insert(flat.end(), row.begin(), row.end());
  const std::size_t input = writer.add(mesh.times, GlbWriter::data, true),
                    output = writer.add(flat, GlbWriter::data);
  writer.root["animations"].push_back(
      {{"name", mesh.clip},
       {"samplers", Json::array({{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}})},
       {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}});
}

}  // namespace

std::vector<std::byte> encodeGlb(const AnimatedMesh& mesh) {
  GlbWriter writer;
  Json attributes = {{"POSITION", writer.add(mesh.positions, GlbWriter::vertices, true)}};
  if (!mesh.normals.empty()) attributes["NORMAL"] = writer.add(mesh.normals, GlbWriter::vertices);
  if (!mesh.labelOfVertex.empty()) attributes["_VESSEL"] = writer.addNumbers(mesh.labelOfVertex);
  Json targets = Json::array();
  const bool moves = !mesh.times.empty() && !mesh.shapes.empty();
  for (std::size_t k = 0; moves && k < mesh.shapes.size(); ++k) {
    Json target = {{"POSITION", writer.add(mesh.shapes[k], GlbWriter::vertices, true)}};
    if (!mesh.normalShapes.empty()) target["NORMAL"] = writer.add(mesh.normalShapes[k], GlbWriter::vertices);
    targets.push_back(std::move(target));
  }
  Json primitives = Json::array();
  for (const AnimatedMesh::Part& part : mesh.parts) {
    writer.root["materials"].push_back(material(part));
    Json primitive = {{"attributes", attributes},
                      {"indices", writer.add(part.triangles)},
                      {"material", writer.root["materials"].size() - 1}};
    if (moves) primitive["targets"] = targets;
    primitives.push_back(std::move(primitive));
  }
  Json node = {{"name", mesh.name}, {"mesh", 0}};
  Json object = {{"name", mesh.name}, {"primitives", std::move(primitives)}};
  if (moves) object["weights"] = mesh.weights[0];
  if (!mesh.labels.empty()) object["extras"] = {{"vessels", vesselList(mesh)}};
  writer.root["meshes"].push_back(std::move(object));
  writer.root["nodes"].push_back(std::move(node));
  writer.root["scene"] = 0;
  writer.root["scenes"].push_back({{"nodes", {0}}});
  if (moves) addWeights(writer, mesh);
  return writer.finish();
}

std::string encodeObj(const AnimatedMesh& mesh) {
  std::string text = "# metres, +Y up\n";
  const auto line = [&text](const char* word, vec3 v) {
    text +=
        word + numberText(double(v.x)) + ' ' + numberText(double(v.y)) + ' ' + numberText(double(v.z)) + '\n';
  };
  for (const vec3& p : mesh.positions) line("v ", p);
  for (const vec3& n : mesh.normals) line("vn ", n);
  std::map<std::uint32_t, std::vector<uvec3>> byLabel;
  for (const AnimatedMesh::Part& part : mesh.parts)
    for (const uvec3& t : part.triangles)
      byLabel[mesh.labelOfVertex.empty() ? 0 : mesh.labelOfVertex[t.x]].push_back(t);
  for (const auto& [label, triangles] : byLabel) {
    std::string name = label < mesh.labels.size() ? mesh.labels[label].name : mesh.name;
    for (char& c : name)
      if (c == '\n' || c == '\r') c = ' ';
    if (name.ends_with('\\')) name += ' ';  // else the next line would be part of the name
    text += "o " + name + '\n';
    if (label < mesh.labels.size() && !mesh.labels[label].kind.empty()) {
      std::string material = mesh.labels[label].kind;
      std::ranges::replace_if(
          material, [](unsigned char c) { return std::isspace(c) != 0; }, '_');
      text += "usemtl " + material + '\n';
    }
    for (const uvec3& t : triangles) {
      text += 'f';
      for (int k = 0; k < 3; ++k) {
        const std::string index = std::to_string(t[k] + 1);
        text += ' ' + index + (mesh.normals.empty() ? std::string() : "//" + index);
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace vasa
