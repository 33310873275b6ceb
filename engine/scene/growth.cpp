#include "scene/growth.h"

#include <algorithm>
#include <cmath>

#include "body/mesh_role.h"
#include "body/skin_field.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "core/kept.h"
#include "core/log.h"
#include "core/parallel.h"
#include "scene/beds.h"
#include "surface/tessellate.h"

namespace vasa {
namespace {

constexpr float kTableHeight = 1.75f;  // [m] of the body that the tables' lengths are for
constexpr float kCube = 0.004f;        // [m] of such a body's tissue: half of the thinnest layer over bones
constexpr float kWayWithoutSkin = 0.012f;  // [m] that trees reach where no skin bounds the tissue
constexpr float kWide = 0.6f;  // in cubes: vessels wider than this keep capillaries out of their lumen
constexpr const char* kKind = "beds";

// Spans of vessels that are drawn at all: not those that others run in the place of.
std::vector<bool> drawnSpans(const SweepTable& table) {
  std::vector<bool> drawn(table.spanCount);
  for (const std::uint32_t span : table.spanOfSweep) drawn[span] = true;
  return drawn;
}

// A vessel's span, and what the tables say of it.
struct Looked {
  std::uint8_t region = 255;
  bool source = false;  // trees hang on it, or nothing grows around it
  bool againstFlow = false;
  std::size_t side = 0;
};

// Puts places on all spans, half a cube apart at most: sources of beds on those that are, lumen in wide ones.
void lookAlong(const std::vector<Looked>& looked, const std::vector<GrowthRegion>& regions, Tissue& tissue,
               BedWish& wish) {
  for (std::uint32_t i = 0; i < looked.size(); ++i) {
    const shared::SweepRecord& span = wish.spans[i];
    const float length =
        glm::distance(sectionOn(wish.rest, span, 0).centre, sectionOn(wish.rest, span, 1).centre);
    const auto steps = std::uint32_t(std::ceil(std::min(length / (0.5f * tissue.cell), 1000.0f))) + 1;
    for (std::uint32_t k = 0; k < steps; ++k) {
      const float t = (float(k) + 0.5f) / float(steps);
      const Section section = sectionOn(wish.rest, span, t);
      if (section.radius > kWide * tissue.cell) tissue.clear(section.centre, section.radius);
      if (!looked[i].source) continue;
      const bool grows = regions[looked[i].region].system != GrowthRegion::kNoSystem;
      wish.sources[looked[i].side].push_back({.at = section.centre,
                                              .radius = section.radius,
                                              .span = i,
                                              .t = t,
                                              .region = grows ? looked[i].region : std::uint8_t(255),
                                              .againstFlow = looked[i].againstFlow});
    }
  }
}

// Meshes that the tables know as organs, and what fills them.
struct Organs {
  std::vector<OrganRoom> rooms;
  std::vector<std::uint8_t> regions;  // one a room; 255: nothing grows there
};

Organs organsOf(const Body& body, const std::vector<GrowthRegion>& regions, float scale) {
  Organs organs;
  for (const SkinnedMesh& mesh : body.meshes) {
    const GrowthRegion* region = regionOfOrgan(regions, mesh.name);
    if (!region || roleNamed(mesh.name) == MeshRole::skin || isSolid(mesh)) continue;
    if (organs.rooms.size() + 1 == Tissue::kHollow) {
      logWarning("of the body's organs the first 254 have capillaries of their own");
      break;
    }
    const bool grows = region->system != GrowthRegion::kNoSystem;
    organs.rooms.push_back({&mesh, region->wall * scale});
    organs.regions.push_back(grows ? std::uint8_t(region - regions.data()) : std::uint8_t(255));
  }
  return organs;
}

// Which organs each vessel feeds: one a vessel and room.
std::vector<char> feedsOf(const Network& network, const std::vector<GrowthRegion>& regions,
                          const Organs& organs) {
  std::vector<char> feeds;
  for (const Vessel& vessel : network.vessels())
    for (const std::uint8_t region : organs.regions)
      feeds.push_back(region == 255 || namesVessel(regions[region], vessel.name, vessel.ontologyId));
  return feeds;
}

// Within an organ that has vessels of its own nothing hangs on those that only run through it.
void leaveOutPassing(const std::vector<char>& feeds, const Tissue& tissue, BedWish& wish) {
  const std::size_t rooms = wish.regionOfRoom.size();
  for (std::vector<BedSource>& sources : wish.sources) {
    const auto roomOf = [&](const BedSource& source) {
      const std::int32_t cube = tissue.numberAt(source.at);
      const std::uint8_t room = cube < 0 ? Tissue::kCommon : tissue.rooms[std::size_t(cube)];
      return room == Tissue::kHollow ? Tissue::kCommon : room;
    };
    const auto isOwn = [&](const BedSource& source, std::size_t room) {
      return feeds[wish.spans[source.span].vessel * rooms + room - 1] != 0;
    };
    std::vector<char> hasOwn(rooms + 1, 0);
    for (const BedSource& source : sources)
      if (const std::size_t room = roomOf(source); room != Tissue::kCommon && isOwn(source, room))
        hasOwn[room] = 1;
    std::erase_if(sources, [&](const BedSource& source) {
      const std::size_t room = roomOf(source);
      return hasOwn[room] && !isOwn(source, room);
    });
  }
}

std::vector<vec3> placesOf(std::span<const vec4> points) {
  std::vector<vec3> places;
  for (const vec4& p : points) places.emplace_back(p);
  return places;
}

// All that beds depend on.
std::uint64_t keyOf(const Body& body, const GrowthRules& rules, const std::vector<GrowthRegion>& regions,
                    const Organs& organs, std::span<const char> feeds, const BedWish& wish,
                    const std::vector<Looked>& looked) {
  std::uint64_t key = hashed(rules.tables, 0);
  for (const GrowthRegion& region : regions) {
    key = hashed(std::array{float(region.system), region.bed, region.inBone ? 1.0f : 0.0f}, key);
  }
  for (const SkinnedMesh& mesh : body.meshes) {
    if (&mesh != skinOf(body) && !isSolid(mesh)) continue;
    key = hashOf(std::span(mesh.mesh.triangles), hashOf(std::span(mesh.mesh.positions), key));
  }
  for (std::size_t i = 0; i < organs.rooms.size(); ++i) {
    const SkinnedMesh& mesh = *organs.rooms[i].mesh;
    key = hashed(std::array{organs.rooms[i].wall, float(organs.regions[i])}, key);
    key = hashOf(std::span(mesh.mesh.triangles), hashOf(std::span(mesh.mesh.positions), key));
  }
  for (const Looked& one : looked)
    key = hashed(std::array{std::uint32_t(one.region), std::uint32_t(one.source),
                            std::uint32_t(one.side) | std::uint32_t(one.againstFlow) << 1},
                 key);
  key = hashOf(feeds, key);
  return hashOf(wish.spans, hashOf(wish.rest.knotFrames, hashOf(wish.rest.points, key)));
}

bool restore(std::span<const std::byte> bytes, CapillaryBeds& beds) {
  ByteReader in(bytes);
  return in.takeAll(beds.beds) && in.takeAll(beds.regionOfBed) && beds.beds.size() == beds.regionOfBed.size();
}

CapillaryBeds growthBeds(const Scene& scene, const GrowthRules& rules,
                         const std::vector<GrowthRegion>& regions, const SweepTable& table) {
  const Network& network = scene.network;
  std::vector<quat> frames(table.knotCount);
  networkFrames(network, network.points(), restReferences(network), frames);
  const std::vector<Station> stations = mainStations(scene.binding);
  const std::vector<bool> drawn = drawnSpans(table);
  CapillaryBeds beds{.spans = wholeSpans(network), .beds = {}, .regionOfBed = {}, .regionOfSpan = {}};
  const float height = scene.body.height();  // of vessels alone none is known
  const float scale = (height > 0 ? height : network.bodyHeight()) / kTableHeight;
  const Organs organs = organsOf(scene.body, regions, scale);
  BedWish wish{.rules = rules,
               .regions = regions,
               .regionOfRoom = organs.regions,
               .rest = {table, network.points(), frames},
               .spans = beds.spans,
               .sources = {},
               .scale = scale};
  std::vector<Looked> looked(beds.spans.size());
  parallelFor(looked.size(), 16, [&](std::size_t i) {
    const shared::SweepRecord& span = beds.spans[i];
    const Vessel& vessel = network.vessels()[span.vessel];
    const JointId joint = stations[span.point + 1].joint;
    const GrowthRegion* region = regionOf(
        regions, {vessel.name, vessel.ontologyId, scene.body.skeleton.joints[joint.value].name, vessel.kind});
    const bool artery = vessel.kind == VesselKind::artery;
    if (!drawn[i] || !region ||
        !(artery || vessel.kind == VesselKind::vein || vessel.kind == VesselKind::portalVein))
      return;
    const float radius = sectionOn(wish.rest, span, 0.5f).radius;
    const bool fits = region->system == GrowthRegion::kNoSystem ||
                      (radius >= region->thinnest * wish.scale && radius <= region->thickest * wish.scale);
    const auto points = network.pointsOf(vessel);
    looked[i] = {std::uint8_t(region - regions.data()), fits, points.front().w < points.back().w,
                 artery ? 0u : 1u};
  });
  for (const Looked& one : looked)
    beds.regionOfSpan.push_back(
        one.source && regions[one.region].system != GrowthRegion::kNoSystem ? one.region : std::uint8_t(255));
  const std::vector<char> feeds = feedsOf(network, regions, organs);
  const std::uint64_t key = keyOf(scene.body, rules, regions, organs, feeds, wish, looked);
  if (const auto kept = findKept(kKind, key))
    if (restore(*kept, beds)) return beds;
  Tissue tissue = tissueOf(scene.body, kCube * wish.scale, placesOf(network.points()),
                           kWayWithoutSkin * wish.scale, organs.rooms);
  wish.mostWay = tissue.hasSkin ? std::numeric_limits<float>::infinity() : kWayWithoutSkin * wish.scale;
  lookAlong(looked, regions, tissue, wish);
  leaveOutPassing(feeds, tissue, wish);
  shareOut(tissue, wish, beds);
  ByteWriter out;
  out.addAll(std::span<const shared::GrowthBed>(beds.beds));
  out.addAll(std::span<const std::uint8_t>(beds.regionOfBed));
  keep(kKind, key, out.bytes());
  return beds;
}

}  // namespace

Result<SceneGrowth> loadGrowth(const Scene& scene, const std::filesystem::path& folder,
                               const SweepTable& table) {
  auto growth = readGrowth(folder);
  if (growth) settleGrowth(*growth, scene, table);
  return growth;
}

Result<SceneGrowth> readGrowth(const std::filesystem::path& folder) {
  SceneGrowth growth;
  auto rules = readGrowthRules(folder / "capillaries.lsys");
  if (!rules) return rules.error();
  auto regions = readRegions(folder / "regions.csv", *rules);
  if (!regions) return regions.error();
  growth.rules = std::move(*rules);
  growth.regions = std::move(*regions);
  return growth;
}

void settleGrowth(SceneGrowth& growth, const Scene& scene, const SweepTable& table) {
  growth.beds = growthBeds(scene, growth.rules, growth.regions, table);
}

}  // namespace vasa
