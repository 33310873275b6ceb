#include "scene/tissue.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "body/mesh_role.h"
#include "body/skin_field.h"
#include "body/skin_shell.h"
#include "core/cancellation.h"
#include "core/parallel.h"
#include "math/aabb.h"

namespace vasa {
namespace {

// Lines run beside the cubes' middles by these shares of a side, so that none meets a vertex of round
// coordinates.
constexpr float kBesideA = 0.5013f, kBesideB = 0.4979f;
constexpr std::array<std::uint32_t, 4> kSteps{0, 10, 14, 17};  // tenths: over a face, an edge, a corner

struct Crossing {
  std::uint32_t line;
  float along;
  int sense;
};

std::size_t indexOf(const ivec3& size, ivec3 place) {
  return (std::size_t(place.z) * std::size_t(size.y) + std::size_t(place.y)) * std::size_t(size.x) +
         std::size_t(place.x);
}

// Where lines along an axis cross a mesh; in cubes from the grid's corner.
std::vector<Crossing> crossingsOf(const Tissue& tissue, const TriangleMesh& mesh, int axis) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::vector<Crossing> crossings;
  Checkpoints checkpoints;
  for (const uvec3& t : mesh.triangles) {
    checkpoints.pass();
    std::array<vec3, 3> p;
    for (int i = 0; i < 3; ++i) p[std::size_t(i)] = (mesh.positions[t[i]] - tissue.low) / tissue.cell;
    const auto cross = [&](const vec3& o, const vec3& u, float x, float y) {
      return (u[a] - o[a]) * (y - o[b]) - (u[b] - o[b]) * (x - o[a]);
    };
    const float area = cross(p[0], p[1], p[2][a], p[2][b]);
    if (area == 0) continue;
    const auto range = [&](int own, float beside) {
      const auto [low, high] = std::minmax({p[0][own], p[1][own], p[2][own]});
      return std::pair(std::max(int(std::ceil(low - beside)), 0),
                       std::min(int(std::floor(high - beside)), tissue.size[own] - 1));
    };
    const auto rangeA = range(a, kBesideA), rangeB = range(b, kBesideB);
    for (int i = rangeA.first; i <= rangeA.second; ++i)
      for (int j = rangeB.first; j <= rangeB.second; ++j) {
        const float x = float(i) + kBesideA, y = float(j) + kBesideB;
        const float u = cross(p[1], p[2], x, y) / area, v = cross(p[2], p[0], x, y) / area, w = 1 - u - v;
        if (u < 0 || v < 0 || w < 0) continue;
        crossings.push_back({std::uint32_t(i) * std::uint32_t(tissue.size[b]) + std::uint32_t(j),
                             u * p[0][axis] + v * p[1][axis] + w * p[2][axis], area > 0 ? -1 : 1});
      }
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& l, const Crossing& r) {
    return l.line != r.line ? l.line < r.line : l.along != r.along ? l.along < r.along : l.sense < r.sense;
  });
  return crossings;
}

// One a place of the grid: how many axes see it inside of the mesh.
std::vector<std::uint8_t> insideVotes(const Tissue& tissue, const TriangleMesh& mesh) {
  std::array<std::vector<Crossing>, 3> all;
  parallelFor(3, 1, [&](std::size_t axis) { all[axis] = crossingsOf(tissue, mesh, int(axis)); });
  std::vector<std::uint8_t> votes(tissue.at.size());
  for (int axis = 0; axis < 3; ++axis) {
    checkpoint();
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const std::vector<Crossing>& crossings = all[std::size_t(axis)];
    for (std::size_t first = 0; first < crossings.size();) {
      const std::uint32_t line = crossings[first].line;
      ivec3 place(0);
      place[a] = int(line / std::uint32_t(tissue.size[b]));
      place[b] = int(line % std::uint32_t(tissue.size[b]));
      int winding = 0;
      for (; first < crossings.size() && crossings[first].line == line; ++first) {
        winding += crossings[first].sense;
        const bool more = first + 1 < crossings.size() && crossings[first + 1].line == line;
        if (winding == 0 || !more) continue;
        const int from = std::max(int(std::ceil(crossings[first].along - 0.5f)), 0);
        const int to = std::min(int(std::ceil(crossings[first + 1].along - 0.5f)), tissue.size[axis]);
        for (place[axis] = from; place[axis] < to; ++place[axis]) ++votes[indexOf(tissue.size, place)];
      }
    }
  }
  return votes;
}

// Calls visit(index in the grid) for all cubes whose middles lie within `reach` of p.
template <class Visit>
void forCubesAround(const Tissue& tissue, vec3 p, float reach, const Visit& visit) {
  const ivec3 low = glm::max(ivec3(glm::floor((p - reach - tissue.low) / tissue.cell)), ivec3(0)),
              high = glm::min(ivec3(glm::floor((p + reach - tissue.low) / tissue.cell)), tissue.size - 1);
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (const ivec3 place(x, y, z); glm::distance(tissue.centreOf(place), p) <= reach)
          visit(indexOf(tissue.size, place));
}

// Takes what lies deeper than an organ's wall out of its room.
void hollowOut(Tissue& tissue, std::span<const OrganRoom> organs) {
  for (std::size_t room = 0; room < organs.size(); ++room) {
    if (organs[room].wall <= 0) continue;
    std::vector<char> within(tissue.count());
    for (std::size_t i = 0; i < tissue.count(); ++i) within[i] = tissue.rooms[i] == room + 1;
    const std::vector<std::uint32_t> depths = depthsIn(tissue, within);
    for (std::size_t i = 0; i < tissue.count(); ++i) {
      if (!within[i] || depths[i] == 0) continue;
      if ((0.1f * float(depths[i]) + 0.5f) * tissue.cell <= organs[room].wall) continue;
      tissue.rooms[i] = Tissue::kHollow;
      if (tissue.kinds[i] == Tissue::Kind::flesh) tissue.kinds[i] = Tissue::Kind::lumen;
    }
  }
}

}  // namespace

void Tissue::clear(vec3 centre, float radius) {
  forCubesAround(*this, centre, radius, [&](std::size_t i) {
    if (at[i] >= 0 && kinds[std::size_t(at[i])] == Kind::flesh) kinds[std::size_t(at[i])] = Kind::lumen;
  });
}

std::int32_t Tissue::numberAt(ivec3 place) const {
  for (int i = 0; i < 3; ++i)
    if (place[i] < 0 || place[i] >= size[i]) return -1;
  return at[indexOf(size, place)];
}

Tissue tissueOf(const Body& body, float cell, std::span<const vec3> near, float reach,
                std::span<const OrganRoom> organs) {
  Tissue tissue;
  tissue.cell = cell;
  const SkinnedMesh* skin = skinOf(body);
  TriangleMesh surface;
  Aabb bounds;
  if (skin) {
    surface = meshAtRest(body, *skin);
    for (const vec3& p : surface.positions) bounds.add(p);
  } else {
    for (const vec3& p : near) bounds.add(p, reach);
  }
  if (bounds.empty()) return tissue;
  tissue.hasSkin = skin != nullptr;
  tissue.low = bounds.low - cell;
  tissue.size = ivec3(glm::ceil(bounds.extent() / cell)) + 2;
  tissue.at.resize(std::size_t(tissue.size.x) * std::size_t(tissue.size.y) * std::size_t(tissue.size.z));
  std::vector<std::uint8_t> inside(tissue.at.size());
  if (skin)
    inside = insideVotes(tissue, surface);
  else
    for (const vec3& p : near) forCubesAround(tissue, p, reach, [&](std::size_t i) { inside[i] = 3; });
  std::vector<std::uint8_t> rooms(tissue.at.size(), Tissue::kCommon);
  for (std::size_t room = organs.size(); room-- > 0;) {
    const std::vector<std::uint8_t> votes = insideVotes(tissue, meshAtRest(body, *organs[room].mesh));
    for (std::size_t i = 0; i < votes.size(); ++i)
      if (votes[i] >= 2) rooms[i] = std::uint8_t(room + 1);
  }
  std::vector<std::uint8_t> solid(tissue.at.size());
  for (const SkinnedMesh& mesh : body.meshes) {
    if (&mesh == skin || !isSolid(mesh)) continue;
    const std::vector<std::uint8_t> votes = insideVotes(tissue, meshAtRest(body, mesh));
    // What keeps vessels out of an organ (the heart) is no bone in its wall.
    const bool keepsOut = roleNamed(mesh.name) == MeshRole::keepOut;
    for (std::size_t i = 0; i < votes.size(); ++i)
      if (!keepsOut || rooms[i] == Tissue::kCommon) solid[i] = std::max(solid[i], votes[i]);
  }
  std::size_t i = 0;
  for (int z = 0; z < tissue.size.z; ++z) {
    checkpoint();
    for (int y = 0; y < tissue.size.y; ++y)
      for (int x = 0; x < tissue.size.x; ++x, ++i) {
        tissue.at[i] = inside[i] >= 2 ? std::int32_t(tissue.places.size()) : -1;
        if (tissue.at[i] < 0) continue;
        tissue.places.emplace_back(x, y, z);
        tissue.kinds.push_back(solid[i] >= 2 ? Tissue::Kind::solid : Tissue::Kind::flesh);
        tissue.rooms.push_back(rooms[i]);
      }
  }
  hollowOut(tissue, organs);
  return tissue;
}

TissueWays waysFrom(const Tissue& tissue, const std::vector<TissueWays::Source>& sources,
                    const std::vector<char>& through, std::uint32_t toll) {
  TissueWays ways;
  ways.length.assign(tissue.count(), TissueWays::kFar);
  ways.before.assign(tissue.count(), -1);
  ways.source.assign(tissue.count(), -1);
  std::vector<std::vector<std::int32_t>> buckets(kSteps.back() + toll + 1);  // by length, in a ring
  std::size_t waiting = 0;
  for (const TissueWays::Source& source : sources) {
    const auto cube = std::size_t(source.cube);
    if (!through[cube] || ways.length[cube] == 0) continue;
    ways.length[cube] = 0;
    ways.before[cube] = source.cube;
    ways.source[cube] = source.name;
    buckets[0].push_back(source.cube);
    ++waiting;
  }
  for (std::uint32_t length = 0; waiting > 0; ++length) {
    checkpoint();
    std::vector<std::int32_t> front;
    front.swap(buckets[length % buckets.size()]);
    waiting -= front.size();
    for (const std::int32_t from : front) {
      if (ways.length[std::size_t(from)] != length) continue;  // a shorter way was found since
      const ivec3 place = tissue.places[std::size_t(from)];
      for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
          for (int x = -1; x <= 1; ++x) {
            const std::int32_t to = tissue.numberAt(place + ivec3(x, y, z));
            if (to < 0 || !through[std::size_t(to)]) continue;
            const bool leaves = tissue.rooms[std::size_t(from)] != tissue.rooms[std::size_t(to)];
            const std::uint32_t own =
                length + kSteps[std::size_t(x * x + y * y + z * z)] + (leaves ? toll : 0);
            if (own >= ways.length[std::size_t(to)]) continue;
            ways.length[std::size_t(to)] = own;
            ways.before[std::size_t(to)] = from;
            ways.source[std::size_t(to)] = ways.source[std::size_t(from)];
            buckets[own % buckets.size()].push_back(to);
            ++waiting;
          }
    }
  }
  return ways;
}

std::vector<std::uint32_t> depthsIn(const Tissue& tissue, const std::vector<char>& part) {
  constexpr std::array kOverFaces{ivec3(1, 0, 0),  ivec3(-1, 0, 0), ivec3(0, 1, 0),
                                  ivec3(0, -1, 0), ivec3(0, 0, 1),  ivec3(0, 0, -1)};
  std::vector<TissueWays::Source> rim;
  Checkpoints checkpoints;
  for (std::size_t i = 0; i < tissue.count(); ++i) {
    checkpoints.pass();
    const bool outermost = std::ranges::any_of(kOverFaces, [&](ivec3 step) {
      const std::int32_t beside = tissue.numberAt(tissue.places[i] + step);
      return beside < 0 || !part[std::size_t(beside)];
    });
    if (outermost) rim.push_back({std::int32_t(i), 0});
  }
  return waysFrom(tissue, rim, part).length;
}

}  // namespace vasa
