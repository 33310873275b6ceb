#include "render/patch_pass.h"

#include "gpu/barrier.h"
#include "gpu/transfer.h"
#include "spirv/patch_smooth_comp.h"
#include "spirv/patch_strain_comp.h"
#include "spirv/patch_triangles_comp.h"
#include "spirv/patches_comp.h"
#include "spirv/skin_comp.h"

namespace vasa {
namespace {

// Vertices of the table in whole blocks, then those of the rings.
std::uint32_t verticesOf(const PatchTable& table) { return table.seams.back().vertex + shared::kMaxAround; }

// Patches' and strips', these with room for the most vertices around.
std::uint32_t triangleRoomOf(const PatchTable& table) {
  const shared::PatchSeam& last = table.seams.back();
  return last.index / 3 + stripTriangles(last, shared::kMaxAround);
}

std::vector<shared::PatchWall> wallsOf(const PatchTable& table) {
  std::vector<shared::PatchWall> walls;
  for (const PatchTable::Patch& patch : table.patches)
    walls.push_back({patch.firstSeam, patch.seamCount, patch.firstVertex, patch.vertexCount});
  return walls;
}

constexpr std::uint32_t kGroupTriangles = shared::kPatchThreads * shared::kThreadTriangles;

}  // namespace

PatchSet::PatchSet(gpu::Device& device, const PatchTable& table)
    : seamCount_(std::uint32_t(table.seams.size())),
      patchCount_(std::uint32_t(table.patches.size())),
      vertexCount_(std::uint32_t(table.vertices.size())) {
  if (empty()) return;
  fixedTriangles_ = table.triangles.size();
  for (const shared::PatchSeam& seam : table.seams) fixedTriangles_ += seam.loopCount;
  spanOfBlock_.resize(verticesOf(table) >> shared::kBlockShift);
  for (const PatchTable::Patch& patch : table.patches) {
    const auto fill = [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t v = first; v < first + count; ++v)
        spanOfBlock_[v >> shared::kBlockShift] = patch.span;
    };
    fill(patch.firstVertex, patch.vertexCount);
    for (std::uint32_t i = 0; i < patch.seamCount; ++i)
      fill(table.seams[patch.firstSeam + i].vertex, shared::kMaxAround);
  }
  seams_ = gpu::makeBuffer(device, "patch seams", std::span<const shared::PatchSeam>(table.seams));
  shares_ = gpu::makeBuffer(device, "patch shares", std::span<const float>(table.shares));
  rest_ = gpu::makeBuffer(device, "patches at rest", std::span<const shared::SkinVertex>(table.vertices));
  joints_ = gpu::Buffer(device, {"patch joints", sizeof(shared::JointRows) * table.seams.size()});
  triangleRoom_ = triangleRoomOf(table);
  groups_ = (triangleRoom_ + kGroupTriangles - 1) / kGroupTriangles;
  all_ = gpu::Buffer(device, {"patch triangles", VkDeviceSize(12) * triangleRoom_});
  gpu::uploadBytes(device, all_, std::as_bytes(std::span(table.triangles)));
  walls_ = gpu::makeBuffer(device, "patch walls", std::span<const shared::PatchWall>(wallsOf(table)));
  firstFan_ = gpu::makeBuffer(device, "patch fans' firsts", std::span<const std::uint32_t>(table.firstFan));
  fans_ = gpu::makeBuffer(device, "patch fans", std::span<const shared::FanTriangle>(table.fans));
  strained_ = gpu::Buffer(device, {"strained patches", sizeof(shared::StrainedPatch) * table.patches.size()});
  dispatch_ = gpu::Buffer(device, {"patch smoothing", sizeof(VkDispatchIndirectCommand)});
  between_ =
      gpu::Buffer(device, {"patches between steps", sizeof(shared::TubeVertex) * table.vertices.size()});
  const VkDeviceSize vertices = inBlocks(verticesOf(table));
  draws_.vertices = gpu::Buffer(device, {.name = "patch vertices",
                                         .bytes = vertices * sizeof(shared::TubeVertex),
                                         .moreUsage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT});
  draws_.colours = gpu::Buffer(device, {"patch colours", 4 * (vertices >> shared::kBlockShift)});
  draws_.indices = gpu::Buffer(device, {"patch indices", VkDeviceSize(12) * triangleRoom_});
  draws_.draws = gpu::Buffer(device, {"patch draws", sizeof(shared::DrawCommand) * groups_});
}

VkDeviceSize PatchSet::bytes() const {
  if (empty()) return 0;
  VkDeviceSize sum = 0;
  for (const gpu::Buffer* buffer :
       {&draws_.vertices, &draws_.colours, &draws_.indices, &draws_.draws, &seams_, &shares_, &rest_,
        &joints_, &all_, &walls_, &firstFan_, &fans_, &strained_, &dispatch_, &between_})
    sum += buffer->allocated();
  return sum;
}

void PatchSet::setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours) {
  if (empty()) return;
  std::vector<std::uint32_t> colours;
  for (const std::uint32_t span : spanOfBlock_) colours.push_back(spanColours[span]);
  gpu::uploadBytes(device, draws_.colours, std::as_bytes(std::span(colours)));
}

PatchPass::PatchPass(gpu::Device& device)
    : seams_(device, {spirv::patches_comp, sizeof(shared::PatchesPush)}),
      skin_(device, {spirv::skin_comp, sizeof(shared::SkinPush)}),
      strain_(device, {spirv::patch_strain_comp, sizeof(shared::PatchStrainPush)}),
      smooth_(device, {spirv::patch_smooth_comp, sizeof(shared::PatchSmoothPush)}),
      triangles_(device, {spirv::patch_triangles_comp, sizeof(shared::PatchTrianglesPush)}) {}

void PatchPass::record(VkCommandBuffer commands, const Input& input) const {
  const PatchSet& patches = input.patches;
  const PatchDraws& draws = patches.draws_;
  seams_.dispatch(commands,
                  shared::PatchesPush{.points = input.points,
                                      .knots = input.knots,
                                      .tables = input.tubes.tables(),
                                      .seams = patches.seams_.address(),
                                      .shares = patches.shares_.address(),
                                      .around = input.detail.around(),
                                      .joints = patches.joints_.address(),
                                      .vertices = draws.vertices.address(),
                                      .indices = patches.all_.address(),
                                      .count = patches.seamCount_,
                                      .unused = 0},
                  gpu::groupsFor(patches.seamCount_, 64));
  gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute);
  skin_.dispatch(commands,
                 shared::SkinPush{.rest = patches.rest_.address(),
                                  .joints = patches.joints_.address(),
                                  .posed = draws.vertices.address(),
                                  .count = patches.vertexCount_,
                                  .jointCount = patches.seamCount_,
                                  .centre = vec3(0),
                                  .scale = 1},
                 gpu::groupsFor(patches.vertexCount_, 64));
  strain_.dispatch(commands,
                   shared::PatchStrainPush{.seams = patches.seams_.address(),
                                           .walls = patches.walls_.address(),
                                           .joints = patches.joints_.address(),
                                           .strained = patches.strained_.address(),
                                           .dispatch = patches.dispatch_.address(),
                                           .count = patches.patchCount_,
                                           .unused = 0},
                   1);
  gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT);
  smooth_.dispatchIndirect(commands,
                           shared::PatchSmoothPush{.walls = patches.walls_.address(),
                                                   .strained = patches.strained_.address(),
                                                   .firstFan = patches.firstFan_.address(),
                                                   .fans = patches.fans_.address(),
                                                   .vertices = draws.vertices.address(),
                                                   .between = patches.between_.address()},
                           patches.dispatch_);
  gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute);
  recordTriangles(commands, patches, input.detail, input.cull);
}

void PatchPass::recordTriangles(VkCommandBuffer commands, const PatchSet& patches, const DetailPass& detail,
                                bool cull) const {
  const PatchDraws& draws = patches.draws_;
  triangles_.dispatch(commands,
                      shared::PatchTrianglesPush{.vertices = draws.vertices.address(),
                                                 .all = patches.all_.address(),
                                                 .view = detail.view(),
                                                 .indices = draws.indices.address(),
                                                 .draws = draws.draws.address(),
                                                 .count = patches.triangleRoom_,
                                                 .keepAll = cull ? 0u : 1u},
                      patches.groups_);
}

}  // namespace vasa
