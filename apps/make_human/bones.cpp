#include "make_human/bones.h"

#include <algorithm>
#include <cmath>

#include "make_human/polygonise.h"

namespace vasa::human {
namespace {

constexpr int kSides = 8;
constexpr float kStep = 0.014f;  // between the rings of a tube
constexpr float kCell = 0.020f;  // largest polygon of a free form

/// One ring of a tube: half width across, half height along `up` as far as the tube's direction lets it.
struct Ring {
  vec3 centre{0};
  float width = 0, height = 0;
};

void addInfluences(SkinnedMesh& mesh, int joint) {
  SkinInfluence influence;
  influence.joints[0] = std::uint16_t(joint);
  influence.weights.x = 1;
  mesh.influences.resize(mesh.mesh.positions.size(), influence);
}

/// Closes rings of equal size to a solid, with a point at either end.
void addRings(SkinnedMesh& to, const std::vector<std::vector<vec3>>& rings, vec3 start, vec3 end) {
  TriangleMesh& mesh = to.mesh;
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  mesh.positions.push_back(start);
  for (const auto& ring : rings) mesh.positions.insert(mesh.positions.end(), ring.begin(), ring.end());
  const std::uint32_t last = std::uint32_t(mesh.positions.size());
  mesh.positions.push_back(end);
  const auto at = [&](std::size_t ring, int side) {
    return first + 1 + std::uint32_t(ring * kSides + side % kSides);
  };
  for (int k = 0; k < kSides; ++k) {
    mesh.triangles.push_back({first, at(0, k + 1), at(0, k)});
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      mesh.triangles.push_back({at(r, k), at(r, k + 1), at(r + 1, k)});
      mesh.triangles.push_back({at(r, k + 1), at(r + 1, k + 1), at(r + 1, k)});
    }
    mesh.triangles.push_back({at(rings.size() - 1, k), at(rings.size() - 1, k + 1), last});
  }
}

Ring catmullRom(const std::vector<Ring>& rings, std::size_t i, float t) {
  const Ring &b = rings[i], &c = rings[i + 1];
  const Ring &a = rings[i > 0 ? i - 1 : i], &d = rings[std::min(i + 2, rings.size() - 1)];
  const auto blend = [t](auto p, auto q, auto r, auto s) {
    return 0.5f * (2.0f * q + (r - p) * t + (2.0f * p - 5.0f * q + 4.0f * r - s) * t * t +
                   (3.0f * q - p - 3.0f * r + s) * t * t * t);
  };
  const auto size = [&](float p, float q, float r, float s) {
    return std::clamp(blend(p, q, r, s), std::min(q, r), std::max(q, r));
  };
  return {blend(a.centre, b.centre, c.centre, d.centre), size(a.width, b.width, c.width, d.width),
          size(a.height, b.height, c.height, d.height)};
}

void addTube(SkinnedMesh& to, const std::vector<Ring>& stations) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const int steps = std::max(2, int(glm::distance(stations[i].centre, stations[i + 1].centre) / kStep));
    for (int k = 0; k < steps; ++k) rings.push_back(catmullRom(stations, i, float(k) / float(steps)));
  }
  rings.push_back(stations.back());
  const auto direction = [&](std::size_t i) {
    return glm::normalize(rings[std::min(i + 1, rings.size() - 1)].centre - rings[i > 0 ? i - 1 : 0].centre);
  };
  std::vector<std::vector<vec3>> outline;
  const auto addRing = [&](vec3 centre, const Ring& size, float scale, vec3 tangent) {
    const vec3 reference = std::abs(tangent.y) < 0.8f ? vec3(0, 1, 0) : vec3(0, 0, 1);
    const vec3 across = glm::normalize(glm::cross(reference, tangent)), up = glm::cross(tangent, across);
    outline.emplace_back();
    for (int k = 0; k < kSides; ++k) {
      const float angle = 2 * kPi * float(k) / float(kSides);
      outline.back().push_back(
          centre + scale * (std::cos(angle) * size.width * across + std::sin(angle) * size.height * up));
    }
  };
  const auto capOf = [](const Ring& ring) {
    return std::min(0.8f * std::min(ring.width, ring.height),
                    0.006f + 0.25f * std::min(ring.width, ring.height));
  };
  const vec3 first = direction(0), last = direction(rings.size() - 1);
  addRing(rings.front().centre - 0.6f * capOf(rings.front()) * first, rings.front(), 0.75f, first);
  for (std::size_t i = 0; i < rings.size(); ++i) addRing(rings[i].centre, rings[i], 1, direction(i));
  addRing(rings.back().centre + 0.6f * capOf(rings.back()) * last, rings.back(), 0.75f, last);
  addRings(to, outline, rings.front().centre - capOf(rings.front()) * first,
           rings.back().centre + capOf(rings.back()) * last);
}

void addBall(SkinnedMesh& to, vec3 centre, vec3 half) {
  constexpr int kRows = 7;
  std::vector<std::vector<vec3>> outline(kRows);
  for (int row = 0; row < kRows; ++row) {
    const float polar = kPi * float(row + 1) / float(kRows + 1);
    for (int k = 0; k < kSides; ++k) {
      const float angle = -2 * kPi * float(k) / float(kSides);
      outline[std::size_t(row)].push_back(centre + half * vec3(std::sin(polar) * std::cos(angle),
                                                               -std::cos(polar),
                                                               std::sin(polar) * std::sin(angle)));
    }
  }
  addRings(to, outline, centre - vec3(0, half.y, 0), centre + vec3(0, half.y, 0));
}

Result<std::vector<vec2>> parseRadii(std::string_view text) {
  std::vector<vec2> radii;
  for (std::string_view part : split(text, ' ')) {
    if (part.empty()) continue;
    const std::vector<std::string_view> both = split(part, '*');
    const Result<float> width = parseNumber(both.front()), height = parseNumber(both.back());
    if (!width.ok()) return width.error();
    if (!height.ok()) return height.error();
    radii.emplace_back(1e-3f * *width, 1e-3f * *height);
  }
  return radii;
}

void addBone(SkinnedMesh& to, Table& table, std::size_t row, const Rig& rig, Side side) {
  const std::string_view name = table.text(row, "joint");
  const int joint = rig.find(side == Side::right ? mirroredName(name) : std::string(name));
  const std::vector<vec3> places = table.take(row, rig.places(table.text(row, "places"), side));
  const std::vector<vec2> radii = table.take(row, parseRadii(table.text(row, "radii_mm")));
  if (joint < 0) return table.fault(row, "no joint " + quoted(name));
  if (table.text(row, "shape") == "ball") {
    if (places.size() != 1 || radii.size() != 3)
      return table.fault(row, "a ball has one place and three half axes");
    addBall(to, places[0], {radii[0].x, radii[1].x, radii[2].x});
  } else {
    if (places.size() < 2 || radii.size() != places.size())
      return table.fault(row, "a tube has a radius for every place");
    std::vector<Ring> rings;
    for (std::size_t i = 0; i < places.size(); ++i) rings.push_back({places[i], radii[i].x, radii[i].y});
    addTube(to, rings);
  }
  addInfluences(to, rig.points[std::size_t(joint)].joint);
}

void addFreeForm(SkinnedMesh& to, const Shape& shape, const Rig& rig) {
  const TriangleMesh solid =
      polygonise({[&](vec3 p) { return shape.distance(p); },
                  // Beside thin plates distances come out many times too long.
                  [&](vec3 p, float reach) { return shape.cellSize(p, 25 * reach); }, shape.bounds()},
                 kCell);
  const std::uint32_t first = std::uint32_t(to.mesh.positions.size());
  to.mesh.positions.insert(to.mesh.positions.end(), solid.positions.begin(), solid.positions.end());
  for (const uvec3& t : solid.triangles) to.mesh.triangles.push_back(t + first);
  addInfluences(to, rig.points[std::size_t(shape.parts.front().path.front())].joint);
}

/// One free form for each joint that moves parts of the shape.
void addFreeForms(SkinnedMesh& to, const Shape& shape, const Rig& rig) {
  for (int joint : rig.joints) {
    Shape group;
    for (const Part& part : shape.parts)
      if (part.path.front() == joint) group.parts.push_back(part);
    if (!group.parts.empty()) addFreeForm(to, group, rig);
  }
}

}  // namespace

Result<SkinnedMesh> makeBones(const std::filesystem::path& bones, const Shape& shape, const Rig& rig) {
  Result<Table> table = Table::read(bones);
  if (!table.ok()) return table.error();
  SkinnedMesh mesh;
  mesh.name = "bones";
  mesh.colour = {0.83f, 0.79f, 0.68f, 1};
  for (std::size_t r = 0; r < table->rowCount(); ++r)
    for (Side side : sidesOf(table->text(r, "side"))) addBone(mesh, *table, r, rig, side);
  if (!table->state().ok()) return table->state().error();
  addFreeForms(mesh, shape, rig);
  mesh.normals = vertexNormals(mesh.mesh);
  return mesh;
}

SkinnedMesh makeSolid(std::string name, vec4 colour, const Shape& shape, const Rig& rig) {
  SkinnedMesh mesh;
  mesh.name = std::move(name);
  mesh.colour = colour;
  addFreeForms(mesh, shape, rig);
  mesh.normals = vertexNormals(mesh.mesh);
  return mesh;
}

}  // namespace vasa::human
