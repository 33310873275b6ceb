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

/// @param turn   moves p by one joint's own motion, in rest space
/// @param place  moves p by a station's whole motion
template <class Turn, class Place>
void movePoints(const Binding& binding, std::span<const vec4> rest, std::span<vec4> out, const Turn& turn,
                const Place& place) {
  assert(rest.size() == binding.pointCount && out.size() == binding.pointCount);
  forEachPoint(binding, [&](std::size_t i, std::span<const BindingRecord> records) {
    vec3 p(rest[i]);
    if (records.size() == 1) {
      out[i] = vec4(place(records[0].station(), p), rest[i].w);
      return;
    }
    vec3 mean(0);
    for (const BindingRecord& record : records) {
      if (record.share == 0) {
        p = turn(record.station(), p);
        continue;
      }
      mean += float(record.share) / float(kWholeShare) * place(record.station(), p);
      p = vec3(rest[i]);
    }
    out[i] = vec4(mean, rest[i].w);
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

}  // namespace vasa
