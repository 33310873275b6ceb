#include "make_human/bones.h"

#include <algorithm>

#include "core/parallel.h"
#include "make_human/form_surface.h"
#include "make_human/polygonise.h"

namespace vasa::human {
namespace {

constexpr float kOrganCell = 0.020f;  // [m] largest polygon of an organ
constexpr float kLofted = 25;         // beside thin lofted plates distances come out many times too long

// How far thinning may move a bone's surface: no farther than its polygons depart from a curve of this
// radius. What is left is still dense enough that distances to a bone's vertices tell distances to the bone
// (body/bone_field.h).
constexpr float kCurve = 5.5e-3f, kMostError = 0.15e-3f;  // [m]

float thinningError(const BoneForm& form) {
  float cell = 0;  // the largest: a skull is no finer for its sutures
  for (const BonePiece& piece : form.pieces) cell = std::max(cell, piece.cell);
  return std::min(cell * cell / (8 * kCurve), kMostError);
}

struct Tissue {
  const char* name;
  const char* mesh;
  vec4 colour;
};
constexpr Tissue kTissues[] = {{"bone", "bones", {0.83f, 0.79f, 0.68f, 1}},
                               {"cartilage", "cartilage", {0.86f, 0.88f, 0.84f, 1}},
                               {"teeth", "teeth", {0.95f, 0.94f, 0.90f, 1}}};

void append(SkinnedMesh& to, const FormSurface& from, int joint, bool mirror) {
  const std::uint32_t first = std::uint32_t(to.mesh.positions.size());
  for (std::size_t i = 0; i < from.normals.size(); ++i) {
    to.mesh.positions.push_back(mirror ? mirrored(from.mesh.positions[i]) : from.mesh.positions[i]);
    to.normals.push_back(mirror ? mirrored(from.normals[i]) : from.normals[i]);
  }
  for (const uvec3& t : from.mesh.triangles)
    to.mesh.triangles.push_back(first + (mirror ? uvec3(t.x, t.z, t.y) : t));
  SkinInfluence influence;
  influence.joints[0] = std::uint16_t(joint);
  influence.weights.x = 1;
  to.influences.resize(to.mesh.positions.size(), influence);
}

void addFreeForm(SkinnedMesh& to, const Shape& shape, const Rig& rig) {
  FormSurface solid;
  solid.mesh =
      polygonise({[&](vec3 p) { return shape.distance(p); },
                  [&](vec3 p, float reach) { return shape.cellSize(p, kLofted * reach); }, shape.bounds()},
                 kOrganCell);
  solid.normals = vertexNormals(solid.mesh);
  append(to, solid, rig.points[std::size_t(shape.parts.front().path.front())].joint, false);
}

}  // namespace

std::vector<SkinnedMesh> makeBones(const std::vector<BoneForm>& forms, const Rig& rig) {
  std::vector<FormSurface> surfaces(forms.size());
  parallelFor(forms.size(), 1,
              [&](std::size_t i) { surfaces[i] = surfaceOf(forms[i], thinningError(forms[i])); });
  std::vector<SkinnedMesh> meshes;
  for (const Tissue& tissue : kTissues) {
    SkinnedMesh& mesh = meshes.emplace_back();
    mesh.name = tissue.mesh;
    mesh.colour = tissue.colour;
    for (std::size_t i = 0; i < forms.size(); ++i) {
      if (forms[i].tissue != tissue.name) continue;
      const RigPoint& left = rig.points[std::size_t(forms[i].path.front())];
      append(mesh, surfaces[i], left.joint, false);
      if (forms[i].paired)
        append(mesh, surfaces[i], rig.points[std::size_t(rig.find(mirroredName(left.name)))].joint, true);
    }
  }
  return meshes;
}

SkinnedMesh united(std::span<const SkinnedMesh> meshes) {
  SkinnedMesh all = meshes[0];
  for (const SkinnedMesh& mesh : meshes.subspan(1)) {
    const std::uint32_t first = std::uint32_t(all.mesh.positions.size());
    all.mesh.positions.insert(all.mesh.positions.end(), mesh.mesh.positions.begin(),
                              mesh.mesh.positions.end());
    all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
    all.influences.insert(all.influences.end(), mesh.influences.begin(), mesh.influences.end());
    for (const uvec3& t : mesh.mesh.triangles) all.mesh.triangles.push_back(first + t);
  }
  return all;
}

SkinnedMesh makeSolid(std::string name, vec4 colour, const Shape& shape, const Rig& rig) {
  SkinnedMesh mesh;
  mesh.name = std::move(name);
  mesh.colour = colour;
  for (int joint : rig.joints) {
    Shape group;
    for (const Part& part : shape.parts)
      if (part.path.front() == joint) group.parts.push_back(part);
    if (!group.parts.empty()) addFreeForm(mesh, group, rig);
  }
  return mesh;
}

}  // namespace vasa::human
