#include "make_human/organs.h"

#include <algorithm>

#include "core/parallel.h"
#include "make_human/form_surface.h"
#include "make_human/path_weights.h"
#include "make_human/table.h"

namespace vasa::human {
namespace {

constexpr float kOrganError = 0.3e-3f;                          // [m]
constexpr float kPressStep = 2e-3f;                             // [m] along a vessel
constexpr float kGrooveWider = 0.6e-3f;                         // [m] than the vessel's wall
constexpr float kNarrowest = 1.7e-3f;                           // [m] that the polygons can show
constexpr float kGrooveBlend = 2.5e-3f, kGrooveCell = 2.5e-3f;  // [m]
constexpr float kDeepestGroove = 9e-3f;  // [m] below the surface: what lies deeper goes through the organ

void addGroove(BoneForm& form, BonePiece& groove) {
  if (groove.stations.size() > 1) {
    groove.capStart = groove.stations.front().width;
    groove.capEnd = groove.stations.back().width;
    form.pieces.push_back(groove);
  }
  groove.stations.clear();
  groove.bounds = {};
}

/// A groove along a vessel: a tube a little wider than it, open outwards also where the vessel has sunk in.
void carveGroove(BoneForm& form, std::span<const vec4> points) {
  const BoneForm uncut = form;
  BonePiece groove;
  groove.carve = true;
  groove.blend = kGrooveBlend;
  groove.cell = kGrooveCell;
  const auto spans = float(spanCount(points));
  for (float u = 0; u <= spans; u += 0.125f) {
    const vec4 at = evaluate(points, u);
    const vec3 p(at), way(evaluateDerivative(points, u));
    const float distance = uncut.distance(p), radius = std::max(at.w + kGrooveWider, kNarrowest);
    if (distance < -kDeepestGroove) addGroove(form, groove);
    if (distance < -kDeepestGroove || glm::length(way) == 0) continue;
    if (!groove.stations.empty() && glm::distance(p, groove.stations.back().centre) < kPressStep) continue;
    const vec3 along = glm::normalize(way);
    vec3 up = uncut.gradient(p);
    up -= glm::dot(up, along) * along;
    if (glm::length(up) < 0.1f) up = anyPerpendicular(along);
    up = glm::normalize(up);
    const float sunk = std::max(at.w - distance, 0.0f);
    const float height = radius + 0.5f * sunk;
    groove.stations.push_back({p + 0.5f * sunk * up, glm::cross(up, along), up, radius, height});
    groove.bounds.add(groove.stations.back().centre - height);
    groove.bounds.add(groove.stations.back().centre + height);
  }
  addGroove(form, groove);
}

/// What vessels ask of each form.
Result<void> carveGrooves(Table& table, const Network& network, std::vector<BoneForm>& forms) {
  const auto vessels = network.vessels();
  for (std::size_t row = 0; row < forms.size(); ++row)
    for (std::string_view name : split(table.text(row, "grooves"), ';')) {
      if (name.empty()) continue;
      const auto found = std::ranges::find(vessels, name, &Vessel::name);
      if (found == vessels.end()) table.fault(row, "no vessel " + quoted(name));
      if (!table.state().ok()) return table.state();
      carveGroove(forms[row], network.pointsOf(*found));
    }
  return table.state();
}

void append(SkinnedMesh& to, const FormSurface& from, const std::vector<int>& path, const Rig& rig,
            bool mirror) {
  const auto first = std::uint32_t(to.mesh.positions.size());
  for (std::size_t i = 0; i < from.normals.size(); ++i) {
    const vec3 p = mirror ? mirrored(from.mesh.positions[i]) : from.mesh.positions[i];
    to.mesh.positions.push_back(p);
    to.normals.push_back(mirror ? mirrored(from.normals[i]) : from.normals[i]);
    Weights weights(rig.joints.size(), 0);
    addPathWeights(path, rig, upPath(path, rig, p), 1, weights);
    to.influences.push_back(strongest(weights));
  }
  for (const uvec3& t : from.mesh.triangles)
    to.mesh.triangles.push_back(first + (mirror ? uvec3(t.x, t.z, t.y) : t));
}

}  // namespace

Result<std::vector<BoneForm>> readOrganForms(const std::filesystem::path& tables, const Rig& rig) {
  return readBoneForms(tables / "organs.csv", tables / "organ_forms.csv", rig, {"organ", "colour"});
}

Result<std::vector<SkinnedMesh>> makeOrgans(const std::filesystem::path& tables, std::vector<BoneForm> forms,
                                            const Rig& rig, const Network& vessels) {
  Result<Table> table = Table::read(tables / "organs.csv");
  if (!table.ok()) return table.error();
  std::vector<vec4> colours;
  for (std::size_t row = 0; row < forms.size(); ++row) {
    const vec3 colour = table->take(row, parseVector(forms[row].tissue));
    colours.emplace_back(colour, table->number(row, "opacity"));
  }
  if (!table->state().ok()) return table->state().error();
  if (const Result<void> carved = carveGrooves(*table, vessels, forms); !carved.ok()) return carved.error();
  std::vector<FormSurface> surfaces(forms.size());
  parallelFor(forms.size(), 1, [&](std::size_t i) { surfaces[i] = surfaceOf(forms[i], kOrganError); });
  std::vector<SkinnedMesh> organs(forms.size());
  for (std::size_t i = 0; i < organs.size(); ++i) {
    const BoneForm& form = forms[i];
    organs[i].name = "organ: " + form.name;
    organs[i].colour = colours[i];
    append(organs[i], surfaces[i], form.path, rig, false);
    if (form.paired) append(organs[i], surfaces[i], form.path, rig, true);
  }
  return organs;
}

}  // namespace vasa::human
