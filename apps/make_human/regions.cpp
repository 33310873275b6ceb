#include "make_human/regions.h"

#include <algorithm>

#include "math/closest_point.h"

namespace vasa::human {
namespace {

constexpr float kHeartLayer = 2.5e-3f;
constexpr float kMostBack = 4e-3f;  // [m] that a place is moved at a time

float distanceToLine(vec3 p, const std::vector<vec3>& places) {
  float best = glm::distance(p, places.front());
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    best = std::min(best, glm::distance(p, glm::mix(places[i], places[i + 1],
                                                    closestOnSegment(p, places[i], places[i + 1]))));
  return best;
}

/// The organ of a region's side: `right lung`, or the right one of a pair of kidneys.
void findOrgan(Table& table, std::size_t row, Side side, std::span<const BoneForm> organs, Region& region) {
  const std::string_view name = table.text(row, "places");
  const std::string own = std::string(sidePrefix(side)).append(name);
  for (const BoneForm& organ : organs) {
    if (organ.name != own && organ.name != name) continue;
    region.organ = &organ;
    region.mirrored = organ.paired && side == Side::right;
    return;
  }
  table.fault(row, "no organ " + quoted(name));
}

std::vector<int> vesselsNamed(Table& table, std::size_t row, std::string_view column,
                              const VesselRows& vessels, Side side) {
  std::vector<int> result;
  for (std::string_view name : split(table.text(row, column), ';')) {
    if (name.empty()) continue;
    result.push_back(vessels.find(side, name));
    if (result.back() < 0) table.fault(row, "no vessel " + quoted(name));
  }
  return result;
}

}  // namespace

float Region::depth(vec3 p, const Surroundings& around) const {
  return organ ? -organ->distance(mirrored ? human::mirrored(p) : p) : around.depth(p);
}

vec3 Region::outwards(vec3 p, const Surroundings& around) const {
  if (!organ) return glm::normalize(around.skin.gradient(p));
  const vec3 slope = organ->gradient(mirrored ? human::mirrored(p) : p);
  const float length = glm::length(slope);
  if (length < 0.1f) return vec3(0);
  return (mirrored ? human::mirrored(slope) : slope) / length;
}

bool Region::contains(vec3 p, const Surroundings& around) const {
  if (shape == Shape::ellipsoid) {
    const float r = glm::length((p - places.front()) / size);
    if (r > 1 || r < inner) return false;
  } else if (shape == Shape::flesh) {
    if (distanceToLine(p, places) > size.x) return false;
  } else if (shape == Shape::heart) {
    const auto place = around.heart.at(p, kHeartLayer);
    if (!place || place->distance < 0) return false;
  }
  const float below = depth(p, around);
  return below >= leastDepth && below <= mostDepth;
}

vec3 Region::back(vec3 p, float radius, const Surroundings& around) const {
  if (shape == Shape::ellipsoid && inner > 0) {
    const vec3 q = p - places.front();
    const float r = glm::length(q / size);
    if (r > 1) return q * (1 / r - 1);
    if (r < inner && r > 0) return q * (inner / r - 1);
  }
  if (shape == Shape::heart) {
    const auto place = around.heart.at(p, 0.03f);
    if (place && place->distance > kHeartLayer + radius)
      return (kHeartLayer + radius - place->distance) * place->outwards;
  }
  if (!organ && mostDepth > 0.5f) return vec3(0);
  const float below = depth(p, around);
  if (organ && below < leastDepth) return std::max(below - leastDepth, -kMostBack) * outwards(p, around);
  return below > mostDepth ? std::min(below - mostDepth, kMostBack) * outwards(p, around) : vec3(0);
}

Aabb Region::bounds(const Surroundings& around) const {
  Aabb box;
  if (shape == Shape::heart) {
    box = around.heart.bounds();
    box.low -= kHeartLayer;
    box.high += kHeartLayer;
    return box;
  }
  if (organ) {
    for (const Aabb bounds = organ->bounds(); vec3 p : {bounds.low, bounds.high})
      box.add(mirrored ? human::mirrored(p) : p, std::max(-leastDepth, 0.0f));
    return box;
  }
  const vec3 reachOut = shape == Shape::flesh ? vec3(size.x) : size;
  for (vec3 p : places) {
    box.add(p - reachOut);
    box.add(p + reachOut);
  }
  return box;
}

Result<std::vector<Region>> readRegions(const std::filesystem::path& path, const VesselRows& vessels,
                                        const Rig& rig, std::span<const BoneForm> organs) {
  Result<Table> table = Table::read(path);
  if (!table.ok()) return table.error();
  std::vector<Region> regions;
  for (std::size_t r = 0; r < table->rowCount(); ++r)
    for (Side side : sidesOf(table->text(r, "side"))) {
      Region region;
      region.name = std::string(sidePrefix(side)).append(table->text(r, "region"));
      const std::string_view shape = table->text(r, "shape");
      region.shape = shape == "ellipsoid" ? Region::Shape::ellipsoid
                     : shape == "heart"   ? Region::Shape::heart
                     : shape == "organ"   ? Region::Shape::organ
                                          : Region::Shape::flesh;
      if (region.shape == Region::Shape::flesh && shape != "flesh")
        table->fault(r, "unknown shape " + quoted(shape));
      if (region.shape == Region::Shape::organ) {
        findOrgan(*table, r, side, organs, region);
      } else {
        region.places = table->take(r, rig.places(table->text(r, "places"), side));
        if (region.places.empty() && region.shape != Region::Shape::heart)
          table->fault(r, "a region has a place");
      }
      if (region.shape == Region::Shape::ellipsoid)
        region.size = 1e-3f * table->take(r, parseVector(table->text(r, "size_mm")));
      if (region.shape == Region::Shape::flesh) region.size.x = table->millimetres(r, "size_mm");
      region.inner = table->numberOr(r, "inner", 0);
      region.leastDepth = 1e-3f * table->numberOr(r, "depth_least_mm", 2);
      region.mostDepth = 1e-3f * table->numberOr(r, "depth_most_mm", 1000);
      region.leaders = vesselsNamed(*table, r, "leaders", vessels, side);
      region.companions = vesselsNamed(*table, r, "companions", vessels, side);
      region.share = table->number(r, "share");
      region.reach = table->millimetres(r, "reach_mm");
      region.tip = table->millimetres(r, "tip_mm");
      if (region.leaders.empty()) table->fault(r, "a region has a leader");
      if (!(region.share > 0 && region.reach > 0 && region.tip > 0))
        table->fault(r, "sizes must be positive");
      regions.push_back(std::move(region));
    }
  if (!table->state().ok()) return table->state().error();
  return regions;
}

}  // namespace vasa::human
