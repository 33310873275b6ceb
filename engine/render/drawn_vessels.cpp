#include "render/drawn_vessels.h"

#include "gpu/barrier.h"
#include "gpu/device.h"
#include "render/frame_stages.h"

namespace vasa {
namespace {

TubeDetail detailOf(const RenderOptions& options) {
  return {options.shape, options.pixelError, options.forks, options.table};
}

}  // namespace

DrawnVessels::DrawnVessels(gpu::Device& device, const Network& network, const RenderOptions& options)
    : device_(&device),
      samples_(options.samples),
      templateBytes_(options.templateBytes),
      ownColours_(kindColours(network)),
      tubes_(device, network, detailOf(options), templateBytes_),
      forks_(device, tubes_.table(), tubes_.detail(), templateBytes_),
      compiling_(options.compileBehind ? ForkPass::compile(device.adapter(), forks_.groupForks())
                                       : std::future<void>()),
      comingForkPass_(std::async(std::launch::async,
                                 [&device, group = forks_.groupForks()] { return ForkPass(device, group); })),
      patches_(device, tubes_.table().patches),
      detailPass_(device, tubes_),
      tubePass_(device, samples_, tubes_),
      filling_(device, tubes_, forks_, fillRoom(tubes_, forks_, everything(tubes_), templateBytes_)),
      planPass_(device),
      first_(device, filling_.room()) {
  if (!patches_.empty()) patchPass_.emplace(device);
}

void DrawnVessels::settle(bool waits) {
  if (comingForkPass_.valid() && (waits || isSettled({}))) {
    if (compiling_.valid()) compiling_.get();
    forkPass_ = comingForkPass_.get();
  }
  range_ = everything(tubes_);
  if (comingForkPass_.valid()) range_.forkEnd = range_.firstFork;
}

bool DrawnVessels::isSettled(std::chrono::milliseconds within) const {
  const auto ready = [&](const auto& future) {
    return !future.valid() || future.wait_for(within) == std::future_status::ready;
  };
  return ready(compiling_) && ready(comingForkPass_);
}

void DrawnVessels::take(const Network& network, const RenderOptions& options) {
  gpu::Device& device = *device_;
  ownColours_ = kindColours(network);
  tubes_ = TubeSet(device, network, detailOf(options), templateBytes_);
  forks_ = ForkSet(device, tubes_.table(), tubes_.detail(), templateBytes_);
  patches_ = PatchSet(device, tubes_.table().patches);
  if (filling_.groupSweeps() != tubes_.groupSweeps()) tubePass_ = TubePass(device, samples_, tubes_);
  if (filling_.groupForks() != forks_.groupForks()) {
    settle();
    forkPass_ = ForkPass(device, forks_.groupForks());
  }
  if (!patches_.empty() && !patchPass_) patchPass_.emplace(device);
  if (patches_.empty()) patchPass_.reset();
  detailPass_.fit(device, tubes_);
  filling_ = Filling(device, tubes_, forks_, fillRoom(tubes_, forks_, everything(tubes_), templateBytes_));
  first_ = Template(device, filling_.room());
  second_.reset();
  setColours({});
}

std::vector<std::uint32_t> DrawnVessels::setColours(std::span<const std::uint32_t> given) {
  std::vector<std::uint32_t> colours = recoloured(ownColours_, given);
  tubes_.setSpanColours(*device_, colours);
  forks_.setSpanColours(*device_, colours);
  patches_.setSpanColours(*device_, colours);
  return colours;
}

void DrawnVessels::makeRoom() {
  if (!second_) second_.emplace(*device_, filling_.room());
}

void DrawnVessels::recordStart(VkCommandBuffer commands, const Frame& frame,
                               const shared::DetailView& view) const {
  const auto scope = frame.timer.scope(commands, stage::kTessellate);
  filling_.recordStart(commands, range_);
  detailPass_.record(commands, tubes_, frame.upload.points(), view);
}

void DrawnVessels::recordFill(VkCommandBuffer commands, const Frame& frame, std::uint32_t round) const {
  const Template& into = templateOf(round);
  const FrameUpload& upload = frame.upload;
  const TubePass::Input input{tubes_,   detailPass_, upload.points(), upload.knots(),
                              filling_, into,        frame.cull};
  {
    const auto scope = frame.timer.scope(commands, stage::kTessellate);
    tubePass_.record(commands, input);
    gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute);
  }
  const auto scope = frame.timer.scope(commands, stage::kForks);
  if (range_.forkEnd > 0) {
    forkPass_.record(commands, input, forks_);
    gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute);
  }
  planPass_.record(commands, filling_, into);
}

void DrawnVessels::recordPatches(VkCommandBuffer commands, const Frame& frame) const {
  const auto scope = frame.timer.scope(commands, stage::kForks);
  patchPass_->record(
      commands, {tubes_, patches_, detailPass_, frame.upload.points(), frame.upload.knots(), frame.cull});
}

void DrawnVessels::recordStatic(VkCommandBuffer commands, const Frame& frame, const shared::DetailView& view,
                                const StaticTubes& all) const {
  const FrameUpload& upload = frame.upload;
  detailPass_.record(commands, tubes_, upload.points(), view);
  if (patchPass_)
    patchPass_->record(commands, {tubes_, patches_, detailPass_, upload.points(), upload.knots()});
  all.recordVertices(commands, tubePass_, forkPass_, planPass_, detailPass_, upload.points(), upload.knots());
}

void DrawnVessels::recordStaticPatches(VkCommandBuffer commands) const {
  patchPass_->recordTriangles(commands, patches_, detailPass_, false);
}

std::uint64_t DrawnVessels::triangleCount() const {
  const TubeDetail& detail = tubes_.detail();
  const std::uint64_t patches = detail.automatic() ? 0 : patches_.triangleCount(detail.shape.around);
  return tubes_.triangleCount() + forks_.triangleCount() + patches;
}

VkDeviceSize DrawnVessels::bytes() const {
  return first_.bytes() + (second_ ? second_->bytes() : 0) + filling_.state().allocated() + patches_.bytes();
}

}  // namespace vasa
