#include "body/deform.h"

#include <algorithm>
#include <cassert>

#include "core/parallel.h"

namespace vasa {
namespace {

constexpr std::size_t kBlocksPerTask = 4;

/// Calls visit(point, its records) for every point, block by block in parallel.
template <class Visit>
void forEachPoint(const Binding& binding, const Visit& visit) {
  parallelFor(binding.firstRecord.size(), kBlocksPerTask, [&](std::size_t block) {
    const BindingRecord* record = binding.records.data() + binding.firstRecord[block];
    const std::size_t end = std::min<std::size_t>(binding.pointCount, (block + 1) * Binding::kBlock);
    for (std::size_t i = block * Binding::kBlock; i < end; ++i) {
      const BindingRecord* first = record;
      for (std::uint32_t share = 0; share < kWholeShare; ++record) share += record->share;
      visit(i, std::span(first, record));
    }
  });
}

/// Where the records of one point take it.
/// @param turn   moves p by one joint's own motion, in rest space
/// @param place  moves p by a station's whole motion
template <class Turn, class Place>
vec3 placed(std::span<const BindingRecord> records, vec3 rest, const Turn& turn, const Place& place) {
  if (records.size() == 1) return place(records[0].station(), rest);
  vec3 p = rest, mean(0);
  for (const BindingRecord& record : records) {
    if (record.share == 0) {
      p = turn(record.station(), p);
      continue;
    }
    mean += float(record.share) / float(kWholeShare) * place(record.station(), p);
    p = rest;
  }
  return mean;
}

template <class Turn, class Place>
void movePoints(const Binding& binding, std::span<const vec4> rest, std::span<vec4> out, const Turn& turn,
                const Place& place) {
  assert(rest.size() == binding.pointCount && out.size() == binding.pointCount);
  forEachPoint(binding, [&](std::size_t i, std::span<const BindingRecord> records) {
    out[i] = vec4(placed(records, vec3(rest[i]), turn, place), rest[i].w);
  });
}

}  // namespace

std::vector<Station> mainStations(const Binding& binding) {
  std::vector<Station> stations(binding.pointCount);
  forEachPoint(binding, [&](std::size_t i, std::span<const BindingRecord> records) {
    const auto greatest =
        std::max_element(records.begin(), records.end(),
                         [](const BindingRecord& a, const BindingRecord& b) { return a.share < b.share; });
    stations[i] = greatest->station();
  });
  return stations;
}

void Deformer::run(std::span<const vec4> rest, const Pose& pose, std::span<vec4> out) {
  pose_.run(binding_->spines, pose);
  movePoints(
      *binding_, rest, out, [this](Station station, vec3 p) { return pose_.turn(station, p); },
      [this](Station station, vec3 p) { return pose_.place(station, p); });
}

void Deformer::run(const Network& network, const Pose& pose, std::span<vec4> out) {
  run(network.points(), pose, out);
  pinEnds(network, out);
}

void Deformer::rotations(std::span<quat> out) const {
  assert(out.size() == binding_->pointCount);
  forEachPoint(*binding_, [&](std::size_t i, std::span<const BindingRecord> records) {
    quat chained(1, 0, 0, 0);
    std::size_t k = 0;
    for (; records[k].share == 0; ++k) chained = pose_.turning(records[k].station()) * chained;
    out[i] = pose_.rotation(records[k].station()) * chained;
  });
}

// A vertebra's one limb moves it by a similarity, which four places tell.
void Deformer::vertebrae(std::span<mat4> out) const {
  const BindingRecord* record = binding_->vertebrae.data();
  for (mat4& motion : out) {
    const BindingRecord* first = record;
    while (record->share == 0) ++record;
    const std::span records(first, ++record);
    const auto place = [&](vec3 p) {
      return placed(
          records, p, [this](Station station, vec3 q) { return pose_.turn(station, q); },
          [this](Station station, vec3 q) { return pose_.place(station, q); });
    };
    const vec3 origin = place(vec3(0));
    motion[3] = vec4(origin, 1);
    for (int k = 0; k < 3; ++k) {
      vec3 unit(0);
      unit[k] = 1;
      motion[k] = vec4(place(unit) - origin, 0);
    }
  }
}

}  // namespace vasa
