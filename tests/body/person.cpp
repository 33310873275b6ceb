#include "body/person.h"

#include <array>
#include <cmath>

#include "body/doll.h"
#include "io/gltf_builder.h"
#include "math/closest_point.h"
#include "support/tubes.h"

namespace vasa::test {
namespace {

// By the two nearest bones, the nearer one more.
SkinInfluence influenceAt(const Skeleton& skeleton, vec3 p) {
  std::array<std::pair<float, std::uint32_t>, 2> near{std::pair(1e9f, 0u), std::pair(1e9f, 0u)};
  for (const auto& joint : skeleton.joints) {
    if (!joint.parent.valid()) continue;
    const vec3 a(skeleton.joints[joint.parent.value].restWorld[3]), b(joint.restWorld[3]);
    const float distance = glm::distance(p, glm::mix(a, b, closestOnSegment(p, a, b)));
    if (joint.parent.value == near[0].second)
      near[0].first = std::min(near[0].first, distance);
    else if (distance < near[0].first)
      near = {std::pair(distance, joint.parent.value), near[0]};
    else if (distance < near[1].first)
      near[1] = {distance, joint.parent.value};
  }
  const auto pull = [](float distance) { return 1 / (distance * distance + 1e-6f); };
  const float first = pull(near[0].first), second = pull(near[1].first);
  return {{std::uint16_t(near[0].second), std::uint16_t(near[1].second), 0, 0},
          vec4(first, second, 0, 0) / (first + second)};
}

vec3 placeOf(const Body& body, const char* joint) {
  return vec3(body.skeleton.joints[body.skeleton.find(joint).value].restWorld[3]);
}

std::vector<float> flat(const std::vector<vec3>& values) {
  std::vector<float> all;
  for (const vec3& v : values) all.insert(all.end(), {v.x, v.y, v.z});
  return all;
}

// Positions, joints and weights of a primitive.
nlohmann::json primitive(GltfBuilder& file, const TriangleMesh& mesh,
                         const std::vector<SkinInfluence>& influences) {
  const int positions = file.floats(flat(mesh.positions), "VEC3");
  const Aabb box = mesh.bounds();
  auto& told = file.document["accessors"][std::size_t(positions)];
  told["min"] = {box.low.x, box.low.y, box.low.z}, told["max"] = {box.high.x, box.high.y, box.high.z};
  std::vector<std::uint8_t> numbers;
  std::vector<float> weights;
  for (const SkinInfluence& by : influences)
    for (int k = 0; k < 4; ++k)
      numbers.push_back(std::uint8_t(by.joints[std::size_t(k)])), weights.push_back(by.weights[k]);
  std::vector<std::uint32_t> indices;
  for (const uvec3& t : mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
  const int bound = file.accessor(numbers, "VEC4", GltfBuilder::kUnsignedByte, influences.size());
  const int share = file.floats(weights, "VEC4");
  const int corners = file.accessor(indices, "SCALAR", GltfBuilder::kUnsignedInt, indices.size());
  return {{"attributes", {{"POSITION", positions}, {"JOINTS_0", bound}, {"WEIGHTS_0", share}}},
          {"indices", corners}};
}

TriangleMesh eyes(vec3 at) {
  TriangleMesh mesh;
  for (std::uint32_t v = 0; v < 64; ++v) {
    const float angle = float(v);
    mesh.positions.push_back(at + vec3(0.03f * std::cos(angle), 0.0005f * angle, 0.1f));
    if (v > 1) mesh.triangles.emplace_back(v - 2, v - 1, v);
  }
  return mesh;
}

}  // namespace

const std::vector<Section>& personTrunk() {
  static const std::vector<Section> trunk{{0.90f, 0.17f, 0.12f, 0.09f}, {1.00f, 0.16f, 0.10f, 0.14f},
                                          {1.10f, 0.14f, 0.09f, 0.15f}, {1.20f, 0.15f, 0.11f, 0.11f},
                                          {1.30f, 0.18f, 0.13f, 0.10f}, {1.40f, 0.20f, 0.12f, 0.08f},
                                          {1.46f, 0.08f, 0.07f, 0.05f}};
  return trunk;
}

TriangleMesh stacked(const std::vector<Section>& sections, float x) {
  constexpr std::uint32_t kAround = 32, kBetween = 6;
  TriangleMesh mesh;
  std::uint32_t rings = 0;
  for (std::size_t s = 0; s + 1 < sections.size(); ++s)
    for (std::uint32_t i = 0; i < kBetween + (s + 2 == sections.size()); ++i, ++rings) {
      const float t = float(i) / kBetween;
      const Section &a = sections[s], &b = sections[s + 1];
      for (std::uint32_t k = 0; k < kAround; ++k) {
        const float angle = 2 * kPi * float(k) / kAround, ahead = std::cos(angle);
        const float deep = ahead > 0 ? glm::mix(a.front, b.front, t) : glm::mix(a.back, b.back, t);
        mesh.positions.emplace_back(x + glm::mix(a.wide, b.wide, t) * std::sin(angle), glm::mix(a.y, b.y, t),
                                    deep * ahead);
      }
    }
  for (std::uint32_t r = 0; r + 1 < rings; ++r)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = r * kAround + k, b = r * kAround + (k + 1) % kAround;
      mesh.triangles.emplace_back(a, b, b + kAround);
      mesh.triangles.emplace_back(a, b + kAround, a + kAround);
    }
  for (const bool top : {false, true}) {
    const auto apex = std::uint32_t(mesh.positions.size()), base = top ? (rings - 1) * kAround : 0;
    mesh.positions.emplace_back(x, (top ? sections.back() : sections.front()).y, 0);
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = base + k, b = base + (k + 1) % kAround;
      mesh.triangles.push_back(top ? uvec3(a, b, apex) : uvec3(b, a, apex));
    }
  }
  return mesh;
}

Body person() {
  Body body = dollBody("vrm");
  SkinnedMesh skin;
  skin.name = "skin";
  skin.mesh = stacked(personTrunk(), 0);
  append(skin.mesh, stacked({{1.44f, 0.05f, 0.05f, 0.05f},
                             {1.55f, 0.08f, 0.09f, 0.1f},
                             {1.65f, 0.08f, 0.09f, 0.09f},
                             {1.75f, 0.02f, 0.02f, 0.02f}},
                            0));
  for (const std::string side : {"left", "right"}) {
    append(skin.mesh,
           stacked({{0.0f, 0.04f, 0.05f, 0.16f}, {0.1f, 0.04f, 0.05f, 0.05f}, {0.92f, 0.085f, 0.08f, 0.08f}},
                   side == "left" ? 0.09f : -0.09f));
    const vec3 from = placeOf(body, (side + "UpperArm").c_str()),
               wrist = placeOf(body, (side + "Hand").c_str()), to = wrist + 0.3f * (wrist - from);
    append(skin.mesh,
           tube([&](float t) { return glm::mix(from, to, t); }, [](float) { return 0.045f; }, 24, 16));
  }
  skin.normals = vertexNormals(skin.mesh);
  for (const vec3& p : skin.mesh.positions) skin.influences.push_back(influenceAt(body.skeleton, p));
  body.meshes.push_back(skin);
  return body;
}

std::string personGlb(const PersonFile& odd) {
  Body body = person();
  for (auto& joint : body.skeleton.joints) {
    joint.rest.translation *= odd.unitsAMetre;
    joint.inverseBind[3] = vec4(odd.unitsAMetre * vec3(joint.inverseBind[3]), 1);
  }
  for (vec3& p : body.meshes[0].mesh.positions) p *= odd.unitsAMetre;
  if (odd.half) {
    TriangleMesh& skin = body.meshes[0].mesh;
    std::erase_if(skin.triangles, [&](const uvec3& t) {
      return std::min({skin.positions[t.x].x, skin.positions[t.y].x, skin.positions[t.z].x}) < -1e-4f;
    });
  }
  const auto& joints = body.skeleton.joints;
  const auto still = std::uint8_t(joints.size());  // the joint that nothing moves, if there is one
  GltfBuilder file;
  std::vector<float> binds;
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    nlohmann::json node{{"name", joints[j].name}};
    vec3 move = joints[j].rest.translation;
    if (odd.jumps && j == 0) move += vec3(0.3f, 0.5f, 0.2f);
    node["translation"] = {move.x, move.y, move.z};
    const float raised = joints[j].name == "leftUpperArm"    ? 0.7f
                         : joints[j].name == "rightUpperArm" ? -0.7f
                                                             : 0;
    if (odd.jumps && raised != 0) node["rotation"] = {0, 0, std::sin(raised), std::cos(raised)};
    for (std::size_t k = 0; k < joints.size(); ++k)
      if (joints[k].parent.valid() && joints[k].parent.value == j) node["children"].push_back(k);
    file.add("nodes", node);
    list.push_back(j);
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) binds.push_back(joints[j].inverseBind[column][row]);
  }
  if (odd.stuck) {
    file.add("nodes", {{"name", "still"}, {"translation", {0, 0.95, 0}}});
    list.push_back(still);
    const auto bind = matrixAt({0, -0.95f, 0});
    binds.insert(binds.end(), bind.begin(), bind.end());
  }
  const SkinnedMesh& skin = body.meshes[0];
  std::vector<SkinInfluence> bound = skin.influences;
  if (odd.stuck)
    for (SkinInfluence& influence : bound) influence = {{still, 0, 0, 0}, vec4(1, 0, 0, 0)};
  nlohmann::json primitives{primitive(file, skin.mesh, bound)};
  if (odd.eyes) {
    const auto neck = std::uint16_t(body.skeleton.find("neck").value),
               head = std::uint16_t(body.skeleton.find("head").value);
    const std::vector<SkinInfluence> half(64, {{neck, head, 0, 0}, vec4(0.5f, 0.5f, 0, 0)});
    nlohmann::json own = primitive(file, eyes(placeOf(body, "head")), half);
    own["material"] = file.add("materials", {{"name", "eyes"}});
    primitives.push_back(own);
  }
  file.add("meshes", {{"name", "person"}, {"primitives", primitives}});
  const int figure = file.add("nodes", {{"name", "figure"}, {"mesh", 0}, {"skin", 0}});
  file.add("skins", {{"joints", list}, {"inverseBindMatrices", file.floats(binds, "MAT4")}});
  nlohmann::json roots{0, figure};
  if (odd.mirrored)
    roots = {file.add("nodes", {{"name", "mirror"}, {"scale", {-1, 1, 1}}, {"children", {0, figure}}})};
  if (odd.stuck) roots[0] = file.add("nodes", {{"name", "armature"}, {"children", {0, still}}});
  file.add("scenes", {{"nodes", roots}});
  file.document["scene"] = 0;
  const vec3 hips = joints[0].rest.translation;
  constexpr int kFrames = 60;  // of two seconds at 30 a second
  std::vector<float> moments, places, turns;
  for (int i = 0; i <= kFrames; ++i) {
    const float t = float(i) / kFrames, half = 0.3f * std::sin(kPi * t);
    moments.push_back(odd.seconds * t);
    places.insert(places.end(), {hips.x, hips.y, hips.z + odd.unitsAMetre * t});
    turns.insert(turns.end(), {std::sin(half), 0, 0, std::cos(half)});
  }
  const int times = file.floats(moments, "SCALAR");
  file.document["accessors"][std::size_t(times)]["min"] = {0};
  file.document["accessors"][std::size_t(times)]["max"] = {odd.seconds};
  const int way = file.floats(places, "VEC3"), bend = file.floats(turns, "VEC4");
  const std::uint32_t chest = body.skeleton.find("chest").value;
  file.add("animations",
           {{"name", "walk"},
            {"samplers", {{{"input", times}, {"output", way}}, {{"input", times}, {"output", bend}}}},
            {"channels",
             {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
              {{"sampler", 1}, {"target", {{"node", chest}, {"path", "rotation"}}}}}}});
  if (odd.vanishes) {
    std::vector<float> sizes;
    for (int i = 0; i <= kFrames; ++i) sizes.insert(sizes.end(), 3, 1 - float(i) / kFrames);
    auto& walk = file.document["animations"][0];
    walk["samplers"].push_back({{"input", times}, {"output", file.floats(sizes, "VEC3")}});
    walk["channels"].push_back({{"sampler", 2}, {"target", {{"node", chest}, {"path", "scale"}}}});
  }
  return file.glb();
}

}  // namespace vasa::test
