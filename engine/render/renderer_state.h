#pragma once
#include <array>
#include <optional>

#include "gpu/device.h"
#include "gpu/timer.h"
#include "render/capillary_pass.h"
#include "render/drawn_vessels.h"
#include "render/frame_stages.h"
#include "render/occlusion_pass.h"
#include "render/picture.h"
#include "render/renderer.h"
#include "render/rounds.h"
#include "render/skin_pass.h"

// What a renderer holds: of its own sources, not of what uses it. How a frame goes is in renderer.cpp, what
// its parts record in frame_parts.cpp, and what drawing costs where everything is kept in static_draw.cpp.
namespace vasa {

inline constexpr VkPipelineStageFlags2 kTemplateStages =
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT |
    VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | gpu::kAttachmentStages |
    VK_PIPELINE_STAGE_2_TRANSFER_BIT;

inline std::array<float, 4> clearColour(const Look& look) {
  if (look.transparent) return {0, 0, 0, 0};
  const vec4 c = linearColour(look.background);
  return {c.x, c.y, c.z, 1};
}

inline bool anyVessels(const Look& look) {
  return look.drawArteries || look.drawVeins || look.drawOtherVessels;
}

struct Renderer::State {
  State(gpu::Device& device, const Network& network, MeshSet posable, const RenderOptions& chosen);

  /// All at once. Capillaries wait until it is known that all vessels have had their room, since they cost
  /// more than all else.
  void draw(const RenderInput& input);
  void begin(const RenderInput& input);
  bool step();
  bool settleRounds(const Look& look);
  void take(const Network& network, const RenderOptions& other);
  void grow(const Growth* growth, const CapillaryWish& wish);
  /// @param tubes  written by DrawnVessels::recordStatic()
  double timeStatic(const StaticTubes& tubes, const RenderInput& input);
  shared::DetailView viewOf(const Camera& camera, const Look& look) const;

  gpu::Device& device;
  RenderOptions options;
  void setColours(std::span<const std::uint32_t> given);

  DrawnVessels vessels;
  MeshSet meshes;
  FrameUpload upload;
  SkinPass skinPass;
  gpu::Target target;
  SurfacePass surfacePass;
  std::optional<OcclusionPass> occlusionPass;
  Rounds rounds;
  std::uint32_t timedRounds = 1;  // that the timer has room for
  std::optional<CapillaryPass> capillaries;
  gpu::Buffer readBack;
  std::optional<gpu::GpuTimer> timer;
  gpu::GpuTimer staticTimer;
  FrameTimes times;
  std::vector<MeshSet::Level> levels;  // of the picture that was started last
  bool transparent = false;
  bool partial = false, cull = true;  // of this frame

  enum class Part { start, meshes, rounds, patches, occlusion, capillaries, organs, end, done };
  struct Frame {
    shared::DrawPush push;
    Camera camera;
    Look look;
    std::span<const MeshSet::Level> levels;
    float heartScale;
    bool waits;
    std::uint32_t rounds;  // of tubes and forks
    bool patched, occludes, grows;
    bool sliced;    // a slice at a time is recorded
    bool split;     // bones and heart are a stretch of their own
    bool wholeEnd;  // nothing comes between the last round and what is translucent
    Part next = Part::start;
    std::uint32_t round = 0;  // the next one
    std::size_t batch = 0;    // likewise, of capillaries
  };
  std::optional<Frame> begun;  // a picture in slices

 private:
  /// Takes what is in the input's spans.
  Frame start(const RenderInput& input, bool sliced);
  void makeRoom();
  static Part partFrom(const Frame& frame, Part from);
  /// What comes next.
  void record(VkCommandBuffer commands, Frame& frame);
  /// What comes next, and more until a part is next.
  void drawUntil(Part part, Frame& frame);
  void recordStart(VkCommandBuffer commands, const Frame& frame);
  void recordMeshes(VkCommandBuffer commands, const Frame& frame);
  void recordRound(VkCommandBuffer commands, Frame& frame);
  void recordEnd(VkCommandBuffer commands, const Frame& frame);
  void recordTranslucent(VkCommandBuffer commands, const Frame& frame, MeshRole role);
  void recordOrgans(VkCommandBuffer commands, const Frame& frame);
  void recordPatches(VkCommandBuffer commands, const Frame& frame);
  DrawnVessels::Frame ofVessels() { return {upload, *timer, cull}; }
  void recordOcclusion(VkCommandBuffer commands, const Frame& frame);
  void recordCapillaries(VkCommandBuffer commands, const Frame& frame, std::size_t from, std::size_t to);
};

}  // namespace vasa
