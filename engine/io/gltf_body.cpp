#include "io/gltf_body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "body/clip_reach.h"
#include "body/coarser_levels.h"
#include "body/copied_joints.h"
#include "body/idle_joints.h"
#include "body/props.h"
#include "body/retarget.h"
#include "body/rig.h"
#include "body/skin_recognition.h"
#include "core/log.h"
#include "io/gltf_clips.h"
#include "io/gltf_rule.h"
#include "io/read_limits.h"
#include "math/aabb.h"

namespace vasa::gltf {
namespace {

// What a mesh takes in what is made of it, beside its vertices.
constexpr std::size_t kBytesAMesh = 400, kBytesAPrimitive = 16, kBytesAnIndex = 4;
constexpr std::size_t kBytesAVertex = 2 * sizeof(vec3) + sizeof(SkinInfluence);

vec4 colourOf(const Model& model, int material) {
  if (material < 0) return SkinnedMesh{}.colour;
  const auto& found = model.materials[std::size_t(material)];
  return found.blends ? found.baseColour : vec4(vec3(found.baseColour), 1);
}

// One a node: the nearest joint above it, or itself.
std::vector<JointId> carriers(const NodeTree& tree, const BodySkeleton& joints) {
  std::vector<JointId> carrier = joints.jointOfNode;
  for (const int node : tree.order) {
    const int parent = tree.parent[std::size_t(node)];
    if (!carrier[std::size_t(node)].valid() && parent >= 0)
      carrier[std::size_t(node)] = carrier[std::size_t(parent)];
  }
  return carrier;
}

bool canCarry(const Skeleton::Joint& joint) {
  const float determinant = std::abs(glm::determinant(mat3(joint.restWorld * joint.inverseBind)));
  return std::isfinite(determinant) && determinant > 1e-12f;
}

// Bound with full weight to one joint, so that at rest it is where the file puts it.
SkinnedMesh onJoint(Geometry geometry, JointId carrier, const BodySkeleton& joints, const mat4& fileWorld) {
  const auto& joint = joints.skeleton.joints[carrier.value];
  const mat4 toRest = joints.fileToRest.empty() ? mat4(1) : joints.fileToRest[carrier.value];
  transform(geometry, glm::inverse(joint.restWorld * joint.inverseBind) * toRest * fileWorld);
  SkinnedMesh out;
  out.influences.assign(geometry.mesh.positions.size(),
                        SkinInfluence{{std::uint16_t(carrier.value), 0, 0, 0}, vec4(1, 0, 0, 0)});
  out.mesh = std::move(geometry.mesh);
  out.normals = std::move(geometry.normals);
  return out;
}

std::map<int, Geometry> geometryByMaterial(const Asset& asset, const Model::Node& node) {
  std::map<int, Geometry> byMaterial;
  const auto& primitives = asset.model.meshes[std::size_t(node.mesh)].primitives;
  for (std::size_t i = 0; i < primitives.size(); ++i)
    appendPrimitive(asset, primitives[i], weightsOf(asset.model, node), node.skin >= 0,
                    byMaterial[primitives[i].material]);
  return byMaterial;
}

void warnOfMending(const Asset& asset, const std::string& mesh, const Geometry& geometry) {
  if (geometry.mendedWeights > 0)
    logWarning(asset.name + ": mesh \"" + mesh + "\": the weights of " +
               std::to_string(geometry.mendedWeights) + " vertices did not sum to 1; mended");
}

struct Source {
  const Asset& asset;
  const NodeTree& tree;
  const BodySkeleton& joints;
  std::vector<JointId> carrier;  // one a node
};

// Whether something moves the node's mesh; warns where nothing does.
bool isMoved(const Source& from, int index, const std::string& name) {
  if (from.asset.model.nodes[std::size_t(index)].skin >= 0) return true;
  const JointId carrier = from.carrier[std::size_t(index)];
  if (carrier.valid() && canCarry(from.joints.skeleton.joints[carrier.value])) return true;
  logWarning(from.asset.name + ": " + (carrier.valid() ? "a joint without extent" : "nothing") +
             " moves the mesh \"" + name + "\"; left out");
  return false;
}

void addMeshesOfNode(const Source& from, int index, std::vector<SkinnedMesh>& meshes) {
  const auto& model = from.asset.model;
  const auto& node = model.nodes[std::size_t(index)];
  const std::string name = nameOf(model.meshes[std::size_t(node.mesh)].name, node.name, index);
  if (!isMoved(from, index, name)) return;
  auto byMaterial = geometryByMaterial(from.asset, node);
  for (auto& [material, geometry] : byMaterial) {
    if (geometry.mesh.empty()) continue;
    warnOfMending(from.asset, name, geometry);
    SkinnedMesh mesh = node.skin >= 0 ? onSkin(std::move(geometry), from.joints.skins[std::size_t(node.skin)])
                                      : onJoint(std::move(geometry), from.carrier[std::size_t(index)],
                                                from.joints, from.tree.world[std::size_t(index)]);
    const bool parted = byMaterial.size() > 1 && material >= 0;
    mesh.name = parted ? name + "/" + model.materials[std::size_t(material)].name : name;
    mesh.colour = colourOf(model, material);
    mustBeFinite(mesh.mesh.positions, index);
    meshes.push_back(std::move(mesh));
  }
}

// glTF is in metres, but not in every exporter's hands: a skeleton of a person's size in centimetres or
// millimetres is read as that. [metres a unit]
float likelyUnitOf(const Asset& asset, const Skeleton& skeleton) {
  constexpr float kLargest = 4, kSmallest = 0.4f;  // [m] of people's skeletons
  constexpr float kLongestLink = 1;  // [m] of half the links: one joint that strays says nothing
  Aabb box;
  std::vector<float> links;
  for (const auto& joint : skeleton.joints) {
    box.add(vec3(joint.restWorld[3]));
    if (!joint.parent.valid()) continue;
    const vec3 above(skeleton.joints[joint.parent.value].restWorld[3]);
    if (const float link = glm::distance(vec3(joint.restWorld[3]), above); link > 0) links.push_back(link);
  }
  if (links.empty()) return 1;
  const vec3 extent = box.extent();
  const float size = std::max({extent.x, extent.y, extent.z});
  const auto middle = links.begin() + std::ptrdiff_t(links.size() / 2);
  std::ranges::nth_element(links, middle);
  if (size > 0 && size < kSmallest / 4)
    logWarning(asset.name + ": its skeleton is " + std::to_string(std::lround(1000 * size)) +
               " mm large, and glTF is in metres; export it at a person's size (Blender: apply the scale)");
  if (!(size > kLargest && *middle > kLongestLink)) return 1;
  for (const auto& [name, unit] : {std::pair("centimetres", 0.01f), std::pair("millimetres", 0.001f)})
    if (size * unit >= kSmallest && size * unit < kLargest) {
      logInfo(asset.name + ": read as " + name + ", as its skeleton would be " + std::to_string(int(size)) +
              " m large in metres");
      return unit;
    }
  logWarning(asset.name + ": its skeleton is " + std::to_string(int(std::min(size, 1e9f))) +
             " m large, and glTF is in metres; export it at a person's size");
  return 1;
}

void leaveOutStrays(std::vector<Clip>& clips, const Skeleton& skeleton, const std::string& file) {
  std::erase_if(clips, [&](const Clip& clip) {
    const bool strays = !staysNear(skeleton, clip);
    if (strays)
      logWarning(
          file + ": the clip \"" + clip.name +
          "\" takes joints farther than a kilometre from the body, and is left out; check the unit of its "
          "keys");
    return strays;
  });
}

// Joints of a person that a clip makes less than half as large, or more than twice: vessels keep their
// volume, for which there may be no room.
void tellScaled(const std::vector<Clip>& clips, const Skeleton& skeleton, const std::string& file) {
  constexpr float kMuch = 2;
  const HumanoidNames parts = partsOf(skeleton);
  for (const Clip& clip : clips)
    for (const JointTracks& tracks : clip.tracks) {
      const auto& joint = skeleton.joints[tracks.joint.value];
      const auto much = [&](vec3 scale) {
        const vec3 share = glm::abs(scale / joint.rest.scale);
        return std::max({share.x, share.y, share.z}) > kMuch ||
               std::min({share.x, share.y, share.z}) < 1 / kMuch;
      };
      const bool cubic = tracks.scale.interpolation == Interpolation::cubic;
      bool scaled = false;
      for (std::size_t k = cubic; k < tracks.scale.values.size(); k += cubic ? 3 : 1)
        scaled = scaled || much(tracks.scale.values[k]);
      if (!scaled || parts.of[tracks.joint.value].empty()) continue;
      logWarning(file + ": the clip \"" + clip.name + "\" scales the joint \"" + joint.name +
                 "\" to more than twice or less than half of its size: vessels there keep their volume, and "
                 "take long to be kept apart where that leaves no room");
      break;
    }
}

// Of each joint the first skin that it is one of.
std::vector<std::uint32_t> firstSkins(std::span<const BodySkeleton::Skin> skins, std::size_t joints) {
  std::vector<std::uint32_t> first(joints, kNone);
  for (auto s = std::uint32_t(skins.size()); s-- > 0;)
    for (const JointId joint : skins[s].joints) first[joint.value] = s;
  return first;
}

// A VRM's table says of some that they are a person's parts, whatever they move.
void tellIdleJoints(const Asset& asset, const BodySkeleton& joints, const std::vector<JointId>& now,
                    Body& body) {
  std::vector<bool> keep(body.skeleton.joints.size(), false);
  for (const auto& [node, part] : asset.model.humanoid)
    if (const JointId joint = joints.jointOfNode[std::size_t(node)]; joint.valid())
      keep[now[joint.value].value] = true;
  const std::vector<std::string> idle = leaveOutIdleJoints(body, keep);
  if (!idle.empty())
    logInfo(asset.name + ": " + std::to_string(idle.size()) +
            (idle.size() > 1 ? " joints that move nothing are" : " joint that moves nothing is") +
            " left out (" + idle.front() + (idle.size() > 1 ? " ...)" : ")"));
}

// Joint maps and --focus go by names: of joints with one name each later one has a number.
void tellNamesApart(Skeleton& skeleton) {
  std::set<std::string> taken;
  for (auto& joint : skeleton.joints) taken.insert(joint.name);
  std::map<std::string, int> met;
  for (auto& joint : skeleton.joints) {
    int& count = met[joint.name];
    if (++count == 1) continue;
    std::string name;
    do name = joint.name + ' ' + std::to_string(count++);
    while (!taken.insert(name).second);
    --count;
    joint.name = std::move(name);
  }
}

// Whether one side's arm and leg have next to no skin, and the other side's have.
bool isHalf(const Body& body) {
  constexpr double kNextToNone = 0.05;
  constexpr std::array<std::string_view, 4> kLimbs{"leftUpperArm", "rightUpperArm", "leftUpperLeg",
                                                   "rightUpperLeg"};
  const Rig rig = rigOf(body.skeleton);
  std::vector<std::size_t> limbs;  // of each joint, kLimbs.size(): none
  for (std::size_t j = 0; j < rig.names.size(); ++j) {
    const auto own = std::size_t(std::ranges::find(kLimbs, rig.parts.of[j]) - kLimbs.begin());
    limbs.push_back(own < kLimbs.size() || rig.parents[j] == kNone ? own : limbs[rig.parents[j]]);
  }
  std::array<double, kLimbs.size() + 1> corners{};
  for (const SkinnedMesh& mesh : body.meshes)
    for (const uvec3& t : mesh.mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const SkinInfluence& influence = mesh.influences[t[k]];
        ++corners[limbs[body.carrier(influence.joints[influence.heaviest()])]];
      }
  const auto lacks = [&](std::size_t side) {
    return corners[side] < kNextToNone * corners[1 - side] &&
           corners[2 + side] < kNextToNone * corners[3 - side];
  };
  return lacks(0) || lacks(1);
}

// What the file leaves open of where the body is at rest, and what of it is not seen.
void tellWhatIsOpen(const Asset& asset, const BodySkeleton& joints, const Body& body) {
  const auto& model = asset.model;
  if (std::ranges::any_of(model.nodes, [&](const Model::Node& node) {
        if (node.mesh < 0 || node.skin < 0) return false;
        const Model::Skin& skin = model.skins[std::size_t(node.skin)];
        return skin.inverseBindMatrices < 0 && skin.joints.size() > 1;
      }))
    logWarning(asset.name +
               ": a skin has no inverse bind matrices: rest is the pose that the file was saved in, and "
               "vertices are taken to lie beside their joints; export the body with its binding");
  if (joints.packedAndPosed)
    logWarning(
        asset.name +
        ": its vertices are packed (KHR_mesh_quantization) and it was saved in a pose, so that where it stood "
        "is not told: it rests where its topmost joint stands in that pose, which may lie centimetres or "
        "metres beside its vessels; pack it at rest, or with floats for positions (gltfpack -vpf)");
  if (const std::size_t people = peopleIn(body.skeleton); people > 1)
    logWarning(
        asset.name + ": it has " + std::to_string(people) +
        " skeletons of a person: motions move one of them, and vessels near the others do not follow it; "
        "export one person alone, with all that it wears on one skeleton");
  if (sidesSwapped(rigOf(body.skeleton))) {
    const bool mirrored = std::ranges::any_of(body.skeleton.joints, [](const Skeleton::Joint& joint) {
      return glm::determinant(mat3(joint.restWorld)) < 0;
    });
    logWarning(asset.name + ": its feet point backwards for what its joints call left and right: " +
               (mirrored
                    ? "a negative scale mirrors it; export it without that scale (Blender: Apply Scale on "
                      "armature and meshes)"
                    : "sides seem swapped, and motions, which go by names where no --joint-map says "
                      "otherwise, turn it around; name them as the person sees them"));
  }
  if (isHalf(body))
    logWarning(asset.name +
               ": half a body: one side's arm and leg have no skin, and vessels there lie in the open; apply "
               "its mirror (Blender: export with Apply Modifiers) and export it again");
  const bool hasMesh =
      std::ranges::any_of(model.nodes, [](const Model::Node& node) { return node.mesh >= 0; });
  if (hasMesh && body.meshes.empty())
    logWarning(
        asset.name +
        ": none of its meshes can be shown: they have no triangles, nothing moves them, or they are no "
        "part of the scene that the file opens with; the body is its skeleton alone");
}

}  // namespace

void checkExpandedSize(const Asset& asset, const NodeTree& tree, std::size_t vertexBytes) {
  const Model& model = asset.model;
  std::vector<std::size_t> sizes;  // [bytes] of a mesh; a primitive without triangles costs time too
  for (const auto& mesh : model.meshes) {
    sizes.push_back(kBytesAMesh + mesh.name.size());
    for (const auto& primitive : mesh.primitives) {
      sizes.back() += kBytesAPrimitive + primitive.targets.size() * sizeof(float);  // looked at, used or not
      if (primitive.position >= 0) sizes.back() += primitive.vertices * vertexBytes;
      if (primitive.indices >= 0)
        sizes.back() += model.accessors[std::size_t(primitive.indices)].count * kBytesAnIndex;
    }
  }
  const std::size_t most = partOfMemory(asset.bytes, 8, 32);
  std::size_t sum = 0;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].mesh < 0 || !tree.inScene[i]) continue;
    const auto& mesh = model.meshes[std::size_t(model.nodes[i].mesh)];
    const auto morphs =
        std::size_t(std::ranges::count_if(weightsOf(model, model.nodes[i]), [](float w) { return w != 0; }));
    sum += sizes[std::size_t(model.nodes[i].mesh)];
    for (const auto& primitive : mesh.primitives)
      sum += std::min(morphs, primitive.targets.size()) * primitive.vertices * sizeof(vec3);
    if (sum > most)
      breaks("/nodes/" + std::to_string(i),
             "the meshes, repeated as often as nodes name them, are too large: all up to this " +
                 beyondMemory(sum, most),
             "split or reduce the asset");
  }
}

std::string nameOf(const std::string& first, const std::string& second, int node) {
  if (!first.empty()) return first;
  return second.empty() ? "node " + std::to_string(node) : second;
}

void mustBeFinite(const std::vector<vec3>& positions, int node) {
  for (const vec3 p : positions)
    if (!std::isfinite(p.x + p.y + p.z))
      breaks("/nodes/" + std::to_string(node), "its transform takes vertices out of the range of numbers",
             kExportAgain);
}

SkinnedMesh onSkin(Geometry geometry, const BodySkeleton::Skin& skin) {
  transform(geometry, skin.bake);
  SkinnedMesh out;
  for (const auto& influence : geometry.influences) {
    SkinInfluence to{{}, influence.weights};
    for (std::size_t i = 0; i < 4; ++i) to.joints[i] = std::uint16_t(skin.joints[influence.joints[i]].value);
    out.influences.push_back(to);
  }
  out.mesh = std::move(geometry.mesh);
  out.normals = std::move(geometry.normals);
  return out;
}

bool holdsBody(const Asset& asset) {
  if (!asset.model.skins.empty()) return true;
  try {
    const Skeleton pieces = buildSkeleton(asset, resolveNodes(asset.model)).skeleton;
    return peopleIn(pieces) > 0 && legsOf(rigOf(pieces)) > 0;
  } catch (const BrokenRule&) {
    return false;  // nodes that may carry meshes and no body
  }
}

// Whether nodes bear the names of a person's limbs.
bool namesAPerson(const Model& model) {
  std::vector<std::string> names;
  for (const auto& node : model.nodes) names.push_back(node.name);
  return humanoidKeys(humanoidNames(names).of) > kHumanoidKeys / 2;
}

Body bodyOf(const Asset& asset) {
  if (!holdsBody(asset)) {
    // Rigid pieces of a person, but for what its skeleton says is wrong with them.
    if (asset.model.skins.empty() && namesAPerson(asset.model))
      buildSkeleton(asset, resolveNodes(asset.model));
    breaks("/skins", "a body needs a skeleton, and the file has no skin",
           "bind its meshes to an armature (Blender: Parent > Armature Deform) and export both; vessels are "
           "read by vasa convert, and the skin of a scan without a skeleton by vasa fit --from");
  }
  NodeTree tree = resolveNodes(asset.model);
  BodySkeleton joints = buildSkeleton(asset, tree);
  if (const float unit = likelyUnitOf(asset, joints.skeleton); unit != 1) {
    tree = resolveNodes(asset.model, unit);
    joints = buildSkeleton(asset, tree);
  }
  const Source from{asset, tree, joints, carriers(tree, joints)};
  Body body;
  body.name = asset.name;
  checkExpandedSize(asset, tree, kBytesAVertex);
  for (int node = 0; node < int(asset.model.nodes.size()); ++node)
    if (asset.model.nodes[std::size_t(node)].mesh >= 0 && tree.inScene[std::size_t(node)])
      addMeshesOfNode(from, node, body.meshes);
  if (!body.meshes.empty()) warnOfUnseen(asset, tree);  // where there are none, that is said
  body.clips = readClips(asset, joints.jointOfNode);
  if (!joints.fileRest.empty()) holdFilePose(body.clips, joints.skeleton, joints.fileRest);
  leaveOutStrays(body.clips, joints.skeleton, body.name);
  tellScaled(body.clips, joints.skeleton, body.name);
  body.skeleton = std::move(joints.skeleton);
  for (const auto& joint : body.skeleton.joints)
    if (!std::isfinite(glm::dot(joint.restWorld[3], vec4(1)) + glm::determinant(mat3(joint.restWorld))))
      breaks("/nodes", "the transform of joint \"" + joint.name + "\" leaves the range of numbers",
             kExportAgain);
  const std::size_t told = body.skeleton.joints.size();
  const std::vector<JointId> now = uniteCopiedJoints(body, firstSkins(joints.skins, told));
  if (const std::size_t copies = told - body.skeleton.joints.size(); copies > 0)
    logInfo(asset.name + ": " + std::to_string(copies) +
            " joints of further skeletons repeat others by name and place, and are one with them");
  tellIdleJoints(asset, joints, now, body);
  tellNamesApart(body.skeleton);
  tellWhatIsOpen(asset, joints, body);
  if (const auto left = leaveOutCoarserLevels(body); !left.empty())
    logInfo(asset.name + ": " + std::to_string(left.size()) + " coarser levels of detail are left out: '" +
            left.front() + "' first");
  if (const auto props = leaveOutProps(body); !props.empty())
    logInfo(asset.name +
            ": what follows one joint and reaches farther from the skeleton than flesh does is left " +
            "out (a prop, scenery): '" + props.front() + "'" +
            (props.size() > 1 ? " and " + std::to_string(props.size() - 1) + " more" : ""));
  recogniseSkin(body);
  return body;
}

}  // namespace vasa::gltf
