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
vec3 placed(const SpinePose& pose, std::span<const BindingRecord> records, vec3 rest) {
  if (records.size() == 1) return pose.place(records[0].station(), rest);
  vec3 p = rest, mean(0);
  for (const BindingRecord& record : records) {
    if (record.share == 0) {
      p = pose.turn(record.station(), p);
      continue;
    }
    mean += float(record.share) / float(kWholeShare) * pose.place(record.station(), p);
    p = rest;
  }
  return mean;
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
  assert(rest.size() == binding_->pointCount && out.size() == binding_->pointCount);
  pose_.run(binding_->spines, pose);
  forEachPoint(*binding_, [&](std::size_t i, std::span<const BindingRecord> records) {
    out[i] = vec4(placed(pose_, records, vec3(rest[i])), rest[i].w);
  });
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
    const auto place = [&](vec3 p) { return placed(pose_, records, p); };
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
