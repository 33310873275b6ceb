#include "make_human/bones.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/parallel.h"
#include "make_human/polygonise.h"
#include "make_human/separate_sheets.h"

namespace vasa::human {
namespace {

constexpr float kCell = 0.020f;         // [m] largest polygon of an organ
constexpr float kLofted = 25;           // beside thin lofted plates distances come out many times too long
constexpr float kCertain = 3;           // those of a bone's pieces are less wrong
constexpr float kFineReach = 1.3f;      // how far beyond a leaf a piece's wish for fine polygons counts
constexpr float kLargestCell = 16e-3f;  // [m] largest polygon of a bone

struct Tissue {
  const char* name;
  const char* mesh;
  vec4 colour;
};
constexpr Tissue kTissues[] = {{"bone", "bones", {0.83f, 0.79f, 0.68f, 1}},
                               {"cartilage", "cartilage", {0.72f, 0.79f, 0.80f, 1}},
                               {"teeth", "teeth", {0.95f, 0.94f, 0.90f, 1}}};

struct Surface {
  TriangleMesh mesh;
  std::vector<vec3> normals;
};

// Flat places need fewer polygons than the octree gives them: the cheapest edges go. What is left is still
// dense enough that distances to a bone's vertices tell distances to the bone (body/bone_field.h).
constexpr float kKeptShare = 0.5f, kThinningError = 0.15e-3f;  // of the triangles; [m]

/// Takes out pairs of triangles that lie on one another back to back: what is left of a fold.
void dropFolds(std::vector<uvec3>& triangles) {
  std::map<std::array<std::uint32_t, 3>, std::vector<std::size_t>> byCorners;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<std::uint32_t, 3> corners{triangles[i].x, triangles[i].y, triangles[i].z};
    std::sort(corners.begin(), corners.end());
    byCorners[corners].push_back(i);
  }
  std::vector<char> folded(triangles.size(), 0);
  for (const auto& [corners, owners] : byCorners)
    for (std::size_t k = 0; k + 1 < owners.size(); k += 2) folded[owners[k]] = folded[owners[k + 1]] = 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!folded[i]) triangles[kept++] = triangles[i];
  triangles.resize(kept);
}

TriangleMesh thinned(const TriangleMesh& mesh) {
  std::vector<uvec3> fewer(mesh.triangles.size());
  const float* first = &mesh.positions[0].x;
  const float scale = meshopt_simplifyScale(first, mesh.positions.size(), sizeof(vec3));
  const std::size_t wanted = 3 * std::size_t(kKeptShare * float(fewer.size()));
  fewer.resize(meshopt_simplify(&fewer[0].x, &mesh.triangles[0].x, 3 * fewer.size(), first,
                                mesh.positions.size(), sizeof(vec3), wanted, kThinningError / scale, 0,
                                nullptr) /
               3);
  dropFolds(fewer);
  TriangleMesh result;
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> numbers(mesh.positions.size(), kUnused);
  for (uvec3 t : fewer) {
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& number = numbers[t[k]];
      if (number == kUnused) {
        number = std::uint32_t(result.positions.size());
        result.positions.push_back(mesh.positions[t[k]]);
      }
      t[k] = number;
    }
    result.triangles.push_back(t);
  }
  separateSheets(result);
  return result;
}

/// The form's own slope is smoother than the polygons'; in a sharp groove it may point elsewhere.
std::vector<vec3> smoothNormals(const BoneForm& form, const TriangleMesh& mesh) {
  std::vector<vec3> normals = vertexNormals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const vec3 slope = form.gradient(mesh.positions[i]);
    const float length = glm::length(slope);
    if (length > 0.05f && glm::dot(slope, normals[i]) > 0.5f * length) normals[i] = slope / length;
  }
  return normals;
}

/// The octree's largest leaf, so that its smallest is the finest cell.
float coarseCell(float finest) {
  float cell = finest;
  for (int level = 0; level < 3 && 2 * cell <= kLargestCell; ++level) cell *= 2;
  return cell;
}

Surface surfaceOf(const BoneForm& form) {
  Surface result;
  const ImplicitSurface surface{[&](vec3 p) { return form.distance(p); },
                                [&](vec3 p, float reach) { return form.cellSize(p, kFineReach * reach); },
                                form.bounds(), kCertain};
  result.mesh = thinned(polygonise(surface, coarseCell(form.finestCell())));
  result.normals = smoothNormals(form, result.mesh);
  return result;
}

void append(SkinnedMesh& to, const Surface& from, int joint, bool mirror) {
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
  Surface solid;
  solid.mesh =
      polygonise({[&](vec3 p) { return shape.distance(p); },
                  [&](vec3 p, float reach) { return shape.cellSize(p, kLofted * reach); }, shape.bounds()},
                 kCell);
  solid.normals = vertexNormals(solid.mesh);
  append(to, solid, rig.points[std::size_t(shape.parts.front().path.front())].joint, false);
}

}  // namespace

std::vector<SkinnedMesh> makeBones(const std::vector<BoneForm>& forms, const Rig& rig) {
  std::vector<Surface> surfaces(forms.size());
  parallelFor(forms.size(), 1, [&](std::size_t i) { surfaces[i] = surfaceOf(forms[i]); });
  std::vector<SkinnedMesh> meshes;
  for (const Tissue& tissue : kTissues) {
    SkinnedMesh& mesh = meshes.emplace_back();
    mesh.name = tissue.mesh;
    mesh.colour = tissue.colour;
    for (std::size_t i = 0; i < forms.size(); ++i) {
      if (forms[i].tissue != tissue.name) continue;
      const RigPoint& left = rig.points[std::size_t(forms[i].joint)];
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
