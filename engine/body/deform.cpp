#include "body/deform.h"

#include <algorithm>
#include <cassert>

#include "core/parallel.h"
#include "math/direction.h"

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

/// A vertebra's one limb moves it by a similarity, which four places tell.
template <class Place>
mat4 similarity(const Place& place) {
  const vec3 origin = place(vec3(0));
  return mat4(vec4(place(vec3(1, 0, 0)) - origin, 0), vec4(place(vec3(0, 1, 0)) - origin, 0),
              vec4(place(vec3(0, 0, 1)) - origin, 0), vec4(origin, 1));
}

mat4 ribMotion(const AxialBone& rib, const mat4& vertebra, vec3 front) {
  const vec3 root(vertebra * vec4(rib.root, 1)), carried(vertebra * vec4(rib.place, 1));
  const mat3 linear = glm::mat3_cast(turnBetween(carried - root, front - root)) * mat3(vertebra);
  mat4 motion(linear);
  motion[3] = vec4(root - linear * rib.root, 1);
  return motion;
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

void Deformer::axialBones(const Body& body, std::span<mat4> out) const {
  const std::vector<AxialBone>& bones = body.axialBones;
  const BindingRecord* record = binding_->axialBones.data();
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const BindingRecord* first = record;
    while (record->share == 0) ++record;
    const auto place = [&, records = std::span(first, ++record)](vec3 p) {
      return placed(pose_, records, p);
    };
    out[b] = bones[b].vertebra == kNone ? similarity(place)
                                        : ribMotion(bones[b], out[bones[b].vertebra], place(bones[b].place));
  }
  for (std::size_t b = 0; b < bones.size(); ++b) {  // from where the meshes are bound
    const Skeleton::Joint& carrier = body.skeleton.joints[bones[b].carrier.value];
    out[b] = out[b] * carrier.restWorld * carrier.inverseBind;
  }
}

}  // namespace vasa
