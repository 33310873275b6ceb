#include "scene/growth_room.h"

#include <algorithm>
#include <optional>

#include "body/point_tree.h"
#include "body/skin_field.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "core/kept.h"
#include "core/parallel.h"

namespace vasa {
namespace {

constexpr float kBelowSkin = 0.8f;  // share of the way to a vertex of the skin that curves may take
constexpr float kFacing = 0.3f;     // least cosine between the skin's normal and the way to it
constexpr float kBehind = 0.95f;    // vertices beyond this share of that way are the same wall's
constexpr std::array<float, 5> kProbes{0, 0.25f, 0.5f, 0.75f, 1};  // places on the span
constexpr const char* kKind = "rooms";

// What is kept of a site.
struct Room {
  float reach;
  std::array<vec4, shared::kGrowthWalls> wall;
};

std::uint64_t keyOf(const Body& body, float most, const PosedNetwork& rest,
                    std::span<const shared::SweepRecord> spans, std::span<const std::uint8_t> grows) {
  std::uint64_t key = hashOf(std::span<const float>(&most, 1));
  if (const SkinnedMesh* skin = skinOf(body))
    key = hashOf(std::span(skin->mesh.triangles), hashOf(std::span(skin->mesh.positions), key));
  return hashOf(grows, hashOf(spans, hashOf(rest.knotFrames, hashOf(rest.points, key))));
}

bool restore(std::span<const std::byte> bytes, std::span<const std::uint8_t> grows,
             std::span<shared::GrowthSite> sites) {
  ByteReader in(bytes);
  std::vector<Room> rooms;
  if (!in.takeAll(rooms) ||
      rooms.size() != std::size_t(std::ranges::count_if(grows, [](std::uint8_t own) { return own != 0; })))
    return false;
  auto room = rooms.begin();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!grows[i]) continue;
    sites[i].reach = room->reach;
    std::ranges::copy(room->wall, sites[i].wall);
    ++room;
  }
  return true;
}

void keepRooms(std::uint64_t key, std::span<const std::uint8_t> grows,
               std::span<const shared::GrowthSite> sites) {
  std::vector<Room> rooms;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!grows[i]) continue;
    std::ranges::copy(sites[i].wall, rooms.emplace_back(Room{sites[i].reach, {}}).wall.begin());
  }
  ByteWriter out;
  out.addAll(std::span<const Room>(rooms));
  keep(kKind, key, out.bytes());
}

}  // namespace

struct GrowthRoom::Skin {
  PointCloud cloud;
  std::vector<vec3> normals;  // unit
  std::optional<PointTree> tree;
};

GrowthRoom::GrowthRoom(const Body& body, float most) : skin_(std::make_unique<Skin>()), most_(most) {
  if (const SkinnedMesh* skin = skinOf(body)) skin_->cloud.points = skin->mesh.positions;
  if (skin_->cloud.points.empty()) return;
  skin_->normals.resize(skin_->cloud.points.size(), vec3(0));
  for (const uvec3& t : skinOf(body)->mesh.triangles) {
    const auto& p = skin_->cloud.points;
    const vec3 normal = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
    for (int i = 0; i < 3; ++i) skin_->normals[t[i]] += normal;
  }
  for (vec3& normal : skin_->normals) normal /= std::max(glm::length(normal), 1e-30f);
  skin_->tree.emplace(3, skin_->cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  skin_->tree->buildIndex();
}

GrowthRoom::~GrowthRoom() = default;

void GrowthRoom::measure(const PosedNetwork& rest, const shared::SweepRecord& span,
                         shared::GrowthSite& site) const {
  site.reach = most_;
  if (!skin_->tree) return;
  struct Place {
    vec3 at, normal;  // in the sections' axes
  };
  std::vector<Place> skin;
  for (const float t : kProbes) {
    const Section section = sectionOn(rest, span, t);
    const mat3 inverse = glm::transpose(mat3(section.frame.u, section.frame.v, section.frame.tangent));
    std::vector<std::pair<unsigned, float>> near;
    skin_->tree->radiusSearch(&section.centre.x, most_ * most_ / (kBelowSkin * kBelowSkin), near,
                              nanoflann::SearchParams());
    for (const auto& [vertex, unused] : near)
      skin.push_back(
          {inverse * (skin_->cloud.points[vertex] - section.centre), inverse * skin_->normals[vertex]});
  }
  const auto nearest = [&] {
    return std::ranges::min_element(skin, {}, [](const Place& p) { return glm::dot(p.at, p.at); });
  };
  for (vec4& wall : site.wall) {
    const auto found = nearest();
    if (found == skin.end()) return;
    // Along the skin where that faces the vessel: between its vertices it may be nearer than they are.
    const float distance = glm::length(found->at), depth = glm::dot(found->normal, found->at);
    const bool faces = depth > kFacing * distance;
    const vec3 normal = faces ? found->normal : distance > 0 ? found->at / distance : vec3(0, 0, 1);
    const float offset = faces ? depth : distance;
    wall = vec4(normal, kBelowSkin * offset);
    std::erase_if(skin, [&](const Place& p) { return glm::dot(normal, p.at) >= kBehind * offset; });
  }
  if (const auto found = nearest(); found != skin.end())
    site.reach = std::min(most_, kBelowSkin * glm::length(found->at));
}

void measureRooms(const Body& body, float most, const PosedNetwork& rest,
                  std::span<const shared::SweepRecord> spans, std::span<const std::uint8_t> grows,
                  std::span<shared::GrowthSite> sites) {
  const std::uint64_t key = keyOf(body, most, rest, spans, grows);
  if (const auto kept = findKept(kKind, key))
    if (restore(*kept, grows, sites)) return;
  const GrowthRoom room(body, most);
  parallelFor(sites.size(), 16, [&](std::size_t i) {
    if (grows[i]) room.measure(rest, spans[i], sites[i]);
  });
  keepRooms(key, grows, sites);
}

}  // namespace vasa
