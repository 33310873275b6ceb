#include "render/tube_set.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "gpu/transfer.h"
#include "render/look.h"
#include "surface/detail.h"

namespace vasa {
namespace {

shared::TubeTables tablesOf() {
  shared::TubeTables tables{};
  std::copy(spanClassMatrices().begin(), spanClassMatrices().end(), tables.spanClass);
  for (std::uint32_t m = shared::kMinAround; m <= shared::kMaxAround; ++m)
    tables.step[m] = ringDirections(m)[1], tables.halfStep[m] = ringDirections(2 * m)[1];
  std::copy(aroundErrors().begin(), aroundErrors().end(), tables.aroundError);
  const std::vector<vec2> angles = capAngles();
  std::copy(angles.begin(), angles.end(), tables.polar);
  return tables;
}

std::uint32_t withKind(std::uint32_t colour, std::uint32_t kind) { return (colour & 0xffffffu) | kind << 24; }

std::uint32_t capsOf(const shared::SweepRecord& sweep) { return std::uint32_t(std::popcount(sweep.caps)); }

}  // namespace

std::vector<std::uint32_t> kindColours(const Network& network) {
  std::vector<std::uint32_t> colours;
  for (const Vessel& vessel : network.vessels())
    colours.insert(colours.end(), vessel.spanCount(),
                   withKind(packColour(colourOf(vessel.kind)), std::uint32_t(vessel.kind)));
  return colours;
}

std::vector<std::uint32_t> recoloured(std::vector<std::uint32_t> kindColours,
                                      std::span<const std::uint32_t> given) {
  assert(given.empty() || given.size() == kindColours.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    kindColours[i] = withKind(given[i], given[i] >> 24 ? kindColours[i] >> 24 : kHiddenKind);
  return kindColours;
}

TubeSet::TubeSet(gpu::Device& device, const Network& network, const TubeDetail& detail,
                 std::uint32_t templateBytes)
    : table_(!detail.forks  ? makeSweepTable(network, planWithoutForks(network))
             : detail.table ? *detail.table
                            : makeSweepTable(network)),
      detail_(detail),
      vesselCount_(std::uint32_t(network.vessels().size())) {
  assert(detail.automatic() || detail.shape.valid());
  detail_.table = nullptr;  // it need not stay
  constexpr VkDeviceSize blockBytes = sizeof(shared::TubeVertex) * shared::kBlockVertices;
  for (;; groupSweeps_ /= 2) {
    groupBlocks_ = blocksOfGroups(groupSweeps_);
    if (groupSweeps_ == shared::kLeastGroup || 2 * blockBytes * groupBlocks_ <= templateBytes) break;
  }
  const shared::TubeTables tables = tablesOf();
  sweeps_ = gpu::makeBuffer(device, "sweeps", std::span<const shared::SweepRecord>(table_.sweeps));
  tables_ = gpu::makeBuffer(device, "tube tables", std::span(&tables, 1));
  colours_ = gpu::Buffer(device, {"sweep colours", 4 * table_.sweeps.size()});
  setSpanColours(device, kindColours(network));
}

// The most that any group of so many sweeps needs.
std::uint32_t TubeSet::blocksOfGroups(std::uint32_t sweeps) const {
  const std::uint32_t total = std::uint32_t(table_.sweeps.size()), along = detail_.mostAlong();
  std::uint32_t most = 0;
  for (std::uint32_t first = 0; first < total; first += sweeps) {
    std::uint32_t strips = 0, vertices = 0;
    for (std::uint32_t i = first; i < std::min(first + sweeps, total); ++i) {
      const std::uint32_t own = along + shared::kCapRings * capsOf(table_.sweeps[i]);
      strips += own;
      vertices += inBlocks((own + 1) * detail_.mostAround());
    }
    most = std::max(most, blocksFor(vertices, 6 * strips * detail_.mostAround()));
  }
  return most;
}

std::uint64_t TubeSet::triangleCount() const {
  if (detail_.automatic()) return 0;
  std::uint64_t strips = table_.sweeps.size() * detail_.shape.along;
  for (const shared::SweepRecord& sweep : table_.sweeps) strips += shared::kCapRings * capsOf(sweep);
  return 2 * strips * detail_.shape.around;
}

void TubeSet::setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours) {
  assert(spanColours.size() == table_.spanCount);
  std::vector<std::uint32_t> all;
  for (const std::uint32_t span : table_.spanOfSweep) all.push_back(spanColours[span]);
  gpu::uploadBytes(device, colours_, std::as_bytes(std::span(all)));
}

}  // namespace vasa
