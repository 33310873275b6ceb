#include "render/tessellate_pass.h"

#include "shared/tessellate.h"
#include "spirv/cap_comp.h"
#include "spirv/tessellate_comp.h"

namespace vasa {
namespace {

constexpr std::uint32_t kGroup = 64;

}  // namespace

TessellatePass::TessellatePass(gpu::Device& device)
    : sweeps_(device, {spirv::tessellate_comp, sizeof(shared::TessellatePush)}),
      caps_(device, {spirv::cap_comp, sizeof(shared::TessellatePush)}) {}

void TessellatePass::record(VkCommandBuffer commands, const Input& input) const {
  const SweepShape& shape = input.tubes.shape();
  const shared::TessellatePush push{
      .points = input.points,
      .knots = input.knots,
      .sweeps = input.tubes.sweeps(),
      .caps = input.tubes.caps(),
      .tables = input.tubes.tables(),
      .vertices = input.vertices,
      .first = input.batch.first,
      .count = input.batch.count,
      .around = shape.around,
      .along = shape.along,
  };
  if (input.batch.caps)
    caps_.dispatch(commands, push, gpu::groupsFor(input.batch.count, kGroup));
  else
    sweeps_.dispatch(commands, push, gpu::groupsFor(input.batch.count * (shape.along + 1), kGroup));
}

}  // namespace vasa
