#include "render/tube_set.h"

#include <algorithm>
#include <cassert>

#include "gpu/transfer.h"
#include "render/look.h"
#include "shared/tessellate.h"

namespace vasa {
namespace {

// The template's triangles for `copies` items whose vertices lie one behind the other.
std::vector<std::uint32_t> repeatedIndices(const std::vector<uvec3>& triangles, std::uint32_t vertices,
                                           std::uint32_t copies) {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t(copies) * triangles.size() * 3);
  for (std::uint32_t copy = 0; copy < copies; ++copy)
    for (const uvec3& t : triangles)
      for (int i = 0; i < 3; ++i) indices.push_back(t[i] + copy * vertices);
  return indices;
}

shared::TessellateTables tablesOf(const SweepShape& shape) {
  shared::TessellateTables tables{};
  std::copy(spanClassMatrices().begin(), spanClassMatrices().end(), tables.spanClass);
  const std::vector<vec2> directions = ringDirections(shape.around), angles = capAngles();
  std::copy(directions.begin(), directions.end(), tables.direction);
  std::copy(angles.begin(), angles.end(), tables.polar);
  return tables;
}

std::uint32_t withKind(std::uint32_t colour, std::uint32_t kind) {
  return (colour & 0xffffffu) | kind << 24;
}

template <class T>
gpu::Buffer uploaded(gpu::Device& device, const char* name, const std::vector<T>& values) {
  return gpu::makeBuffer(device, name, std::span<const T>(values));
}

}  // namespace

TubeSet::TubeSet(gpu::Device& device, const Network& network, const SweepShape& shape, std::uint32_t batchSweeps)
    : table_(makeSweepTable(network)), shape_(shape) {
  assert(shape.valid() && batchSweeps > 0);
  makeBatches(batchSweeps);
  makeIndices(device, batchSweeps);
  std::vector<std::uint32_t> caps;
  for (const CapEnd& cap : table_.caps) caps.push_back(2 * cap.sweep + (cap.last ? 1 : 0));
  const shared::TessellateTables tables = tablesOf(shape);
  sweeps_ = uploaded(device, "sweeps", table_.sweeps);
  caps_ = uploaded(device, "caps", caps);
  tables_ = gpu::makeBuffer(device, "tessellation tables", std::span(&tables, 1));
  colours_ = gpu::Buffer(device, {"sweep colours", 4 * (table_.sweeps.size() + table_.caps.size())});
  for (const std::uint32_t vessel : table_.vesselOfSweep) {
    const VesselKind kind = network.vessels()[vessel].kind;
    kindColours_.push_back(withKind(packColour(colourOf(kind)), std::uint32_t(kind)));
  }
  setSweepColours(device, {});
}

void TubeSet::makeBatches(std::uint32_t batchSweeps) {
  const auto cut = [&](bool caps, std::size_t total) {
    for (std::uint32_t first = 0; first < total; first += batchSweeps)
      batches_.push_back({caps, first, std::min(batchSweeps, std::uint32_t(total) - first)});
  };
  cut(false, table_.sweeps.size());
  cut(true, table_.caps.size());
  for (const TubeBatch& batch : batches_)
    templateBytes_ = std::max(templateBytes_, VkDeviceSize(batch.count) * verticesPerItem(batch) *
                                                  sizeof(shared::TubeVertex));
}

void TubeSet::makeIndices(gpu::Device& device, std::uint32_t batchSweeps) {
  const auto copies = [&](std::size_t total) { return std::min(batchSweeps, std::uint32_t(total)); };
  sweepIndices_ = uploaded(device, "sweep indices",
                           repeatedIndices(sweepTriangles(shape_), shape_.sweepVertices(), copies(table_.sweeps.size())));
  capIndices_ = uploaded(device, "cap indices",
                         repeatedIndices(capTriangles(shape_), shape_.capVertices(), copies(table_.caps.size())));
}

std::uint64_t TubeSet::triangleCount() const {
  return std::uint64_t(table_.sweeps.size()) * shape_.sweepTriangles() +
         std::uint64_t(table_.caps.size()) * shape_.capTriangles();
}

std::uint32_t TubeSet::verticesPerItem(const TubeBatch& batch) const {
  return batch.caps ? shape_.capVertices() : shape_.sweepVertices();
}

std::uint32_t TubeSet::firstColour(const TubeBatch& batch) const {
  return batch.first + (batch.caps ? std::uint32_t(table_.sweeps.size()) : 0);
}

void TubeSet::drawBatch(VkCommandBuffer commands, const TubeBatch& batch) const {
  const gpu::Buffer& indices = batch.caps ? capIndices_ : sweepIndices_;
  const std::uint32_t triangles = batch.caps ? shape_.capTriangles() : shape_.sweepTriangles();
  vkCmdBindIndexBuffer(commands, indices.handle(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands, 3 * triangles * batch.count, 1, 0, 0, 0);
}

void TubeSet::setSweepColours(gpu::Device& device, std::span<const std::uint32_t> colours) {
  assert(colours.empty() || colours.size() == table_.sweeps.size());
  std::vector<std::uint32_t> all = kindColours_;
  for (std::size_t i = 0; i < colours.size(); ++i)
    all[i] = withKind(colours[i], colours[i] >> 24 ? kindColours_[i] >> 24 : kHiddenKind);
  for (const CapEnd& cap : table_.caps) all.push_back(all[cap.sweep]);
  gpu::uploadBytes(device, colours_, std::as_bytes(std::span(all)));
}

}  // namespace vasa
