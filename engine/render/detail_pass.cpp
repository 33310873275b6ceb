#include "render/detail_pass.h"

#include <cmath>

#include "gpu/barrier.h"
#include "gpu/device.h"
#include "gpu/transfer.h"
#include "render/surface_pass.h"
#include "spirv/around_comp.h"
#include "spirv/measure_comp.h"

namespace vasa {
namespace {

constexpr std::uint32_t kGroupVessels = 64;

// Sides of the view volume, from rows of the matrix (Gribb, Hartmann 2001). Clip space holds -w <= x, y <= w,
// z <= w.
void setPlanes(shared::DetailView& view, const mat4& rows) {
  const vec4 sides[5]{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                      rows[3] - rows[2]};
  for (int i = 0; i < 5; ++i) view.planes[i] = sides[i] / glm::length(vec3(sides[i]));
}

}  // namespace

shared::DetailView detailView(const Camera& camera, const Look& look, const PictureGrid& grid,
                              const TubeDetail& detail) {
  shared::DetailView view{};
  const float width = grid.size.x, height = grid.size.y;
  const mat4 rows = glm::transpose(viewProjection(camera, width / height));
  setPlanes(view, rows);
  if (camera.orthographicHeight > 0) {
    view.depth = {0, 0, 0, 1};
    view.nearest = 1;
    view.focal = height / camera.orthographicHeight;
  } else {
    const vec3 ahead = -cameraAxes(camera)[2];
    view.depth = vec4(ahead, -glm::dot(ahead, camera.position));
    view.nearest = camera.nearDistance;
    view.reach = 1;
    view.focal = height / (2 * std::tan(camera.verticalAngle / 2));
  }
  view.tolerance = detail.pixelError;
  view.around = detail.automatic() ? 0 : detail.shape.around;
  view.along = detail.automatic() ? 0 : detail.shape.along;
  view.hiddenKinds = hiddenKinds(look);
  view.columns = width;
  view.rows = height;
  view.picture[0] = 0.5f * view.columns * (rows[0] + rows[3]) - 0.5f * rows[3];
  view.picture[1] = 0.5f * view.rows * (rows[1] + rows[3]) - 0.5f * rows[3];
  view.picture[2] = rows[3];
  view.snap = grid.snap;
  view.samples = grid.samples;
  return view;
}

PictureGrid pictureGrid(const gpu::Device& device, VkExtent2D size, std::uint32_t samples) {
  // llvmpipe moves a corner to the nearest step, but with four samples it has been seen to cover one that
  // lies 0.6 of a step beyond an edge; SwiftShader moves them, seen, by 0.8 to 1 of one, and of others it is
  // not known.
  const float steps = device.adapter().driverId == VK_DRIVER_ID_MESA_LLVMPIPE ? 0.75f : 1;
  // Of the pass's places, and of the rasteriser's.
  const float rounding = float(std::max(size.width, size.height)) * 0x1p-19f;
  const float snap = steps * std::exp2(-float(device.limits().subPixelPrecisionBits)) + rounding;
  return {{size.width, size.height}, snap, samples};
}

DetailPass::DetailPass(gpu::Device& device, const TubeSet& tubes)
    : measure_(device, {spirv::measure_comp, sizeof(shared::MeasurePush)}),
      choose_(device, {spirv::around_comp, sizeof(shared::AroundPush)}),
      view_(device, {"detail view", sizeof(shared::DetailView)}) {
  fit(device, tubes);
}

void DetailPass::fit(gpu::Device& device, const TubeSet& tubes) {
  along_ = gpu::Buffer(device, {"quads along", 4 * tubes.table().sweeps.size()});
  sizes_ = gpu::makeBuffer(device, "vessel sizes",
                           std::span<const std::uint32_t>(std::vector<std::uint32_t>(tubes.vesselCount())));
  around_ = gpu::Buffer(device, {"quads around", 4 * VkDeviceSize(tubes.vesselCount())});
}

void DetailPass::record(VkCommandBuffer commands, const TubeSet& tubes, VkDeviceAddress points,
                        const shared::DetailView& view) const {
  gpu::stageBarrier(commands, gpu::kCompute, VK_PIPELINE_STAGE_2_TRANSFER_BIT);
  vkCmdUpdateBuffer(commands, view_.handle(), 0, sizeof view, &view);
  gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_TRANSFER_BIT | gpu::kCompute, gpu::kCompute);
  const std::uint32_t sweeps = std::uint32_t(tubes.table().sweeps.size());
  measure_.dispatch(commands,
                    shared::MeasurePush{points, tubes.sweeps(), tubes.tables(), view_.address(),
                                        tubes.colours(), along_.address(), sizes_.address(), sweeps, 0},
                    gpu::groupsFor(sweeps, kGroupVessels));
  gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute);
  choose_.dispatch(commands,
                   shared::AroundPush{tubes.tables(), view_.address(), sizes_.address(), around_.address(),
                                      tubes.vesselCount(), 0},
                   gpu::groupsFor(tubes.vesselCount(), kGroupVessels));
  gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute);
}

}  // namespace vasa
