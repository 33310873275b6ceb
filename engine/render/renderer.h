#pragma once
#include <algorithm>
#include <chrono>
#include <memory>
#include <span>

#include "body/body.h"
#include "core/image.h"
#include "growth/plan.h"
#include "render/camera.h"
#include "render/look.h"
#include "render/mesh_levels.h"
#include "surface/sweep_table.h"
#include "surface/sweep_template.h"

namespace vasa::gpu {
class Device;
class Image;
}  // namespace vasa::gpu

namespace vasa {

/// [pixels] error of `--quads auto`: RenderOptions::pixelError.
constexpr float kAutoPixelError = 0.25f;
/// [pixels] of bones, heart and skin beside it: none is so thin as a vessel, and normals stay those of the
/// mesh.
constexpr float meshPixelError(float pixelError) {
  constexpr float kLeastMeshPixelError = 0.6f;
  return pixelError <= 0 ? 0 : std::max(kLeastMeshPixelError, 1.5f * pixelError);
}

/// What is settled for a renderer's life.
struct RenderOptions {
  std::uint32_t width = 1280, height = 720;  ///< [pixels] 1 to the device's limit
  std::uint32_t samples = 4;                 ///< a pixel: 1 or 4
  SweepShape shape;                          ///< quads around and along every sweep
  /// [pixels] > 0: quads by size on the picture (surface/detail.h), with this error at most; `shape` is not
  /// used. Bones, heart and skin are drawn with fewer triangles too, within meshPixelError(), half that with
  /// 4 samples.
  float pixelError = 0;
  /// Of the meshes, read at construction; without pixelError the finest is drawn. nullptr: made where
  /// pixelError asks for them.
  const BodyLevels* levels = nullptr;
  const Skeleton* skeleton = nullptr;  ///< of the meshes, for those that are made; nullptr: they stay at rest
  /// Vessels join smoothly, or as the network's patches have it; false: they end inside one another.
  bool forks = true;
  /// makeSweepTable() of the network, read at construction: planning forks takes a while. nullptr: made.
  const SweepTable* table = nullptr;
  bool cull = true;  ///< leave out triangles that cannot be seen; the picture is the same to the bit
  std::uint32_t supersample = 1;  ///< pixels drawn in each direction for one of the picture's, 1 to 4
  bool bgra = false;              ///< Renderer::picture() has blue first, as windows do
  bool occlusion = false;         ///< Look::occlusion counts; takes 8 bytes a pixel, 12 with 4 samples
  /// [bytes] of each of two templates, which tubes and forks are written to and drawn from by turns: all the
  /// vertex memory that they take, however many there are. No less than what a few sweeps may need is taken
  /// (some 0.3 MB at most).
  std::uint32_t templateBytes = (1u << 20) - 4096;
  const Growth* growth = nullptr;  ///< of the capillaries, must outlive the renderer; nullptr: none are drawn
  CapillaryWish capillaries;       ///< which of them
  std::uint32_t seed = 1;          ///< of their shapes
  /// Have the driver compile the forks' shader in the background where else it would hold up all pictures (a
  /// CPU driver, several seconds, once on a machine): see RenderInput::waits.
  bool compileBehind = false;
  /// Take times() on the device's clock. That puts barriers around every stage, which costs a little and
  /// keeps a device from writing one template while it draws the other; the pictures are the same.
  bool timed = true;
};

/// One frame. All spans are read before draw() or begin() returns.
struct RenderInput {
  std::span<const vec4> points;         ///< de Boor points, as Network::points()
  std::span<const quat> knotFrames;     ///< networkFrames() of them (surface/sweep_table.h)
  std::span<const mat4> jointMatrices;  ///< a joint's world · inverseBind; empty where there are no meshes
  Camera camera;
  Look look;
  float heartScale = 1;  ///< of the heart's mesh (FrameMaker::heartScale)
  /// Until the driver has compiled the forks' shader; false: the picture is without forks until then.
  bool waits = true;
};

/// [ms] of the latest frame: upload and total by the host's clock, the others by the device's, which are 0
/// where the device has no clock or RenderOptions::timed is off.
struct FrameTimes {
  double upload = 0;       ///< host: points, frames and joints into the device's reach
  double tessellate = 0;   ///< compute passes that write vertices of tubes and caps
  double forks = 0;        ///< compute passes that write vertices of forks
  double draw = 0;         ///< rasterising tubes, caps and forks
  double capillaries = 0;  ///< growing and drawing capillaries
  double meshes = 0;       ///< skinning and drawing bones, heart, skin; clearing and resolving
  double total = 0;        ///< host: from draw() to the finished picture
};

/// Capillaries of the latest frame.
struct CapillaryCounts {
  std::uint64_t trees = 0, curves = 0;
  std::uint64_t wishedCurves = 0;  ///< without the budget
  /// Device and upload memory for all that has to do with them, the ring included.
  std::uint64_t bytes = 0;
  std::uint64_t ringBytes = 0;  ///< for their vertices
};

/// Draws a network in a body, off screen. A frame is a function of the input alone: nothing of an earlier
/// frame shows in it. Throws gpu::Error. One thread at a time.
class Renderer {
 public:
  /// @param network  several networks are drawn as one merged network (network/merge.h)
  /// @param meshes   read, not kept
  Renderer(gpu::Device& device, const Network& network, std::span<const SkinnedMesh> meshes,
           const RenderOptions& options);
  /// With the meshes of another renderer of the same device and body, and their levels, which are there once.
  Renderer(gpu::Device& device, const Network& network, const Renderer& sameBody,
           const RenderOptions& options);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Colours of the network's spans from the next frame on (packColour), vessel after vessel; alpha 0 hides a
  /// span, its cap and the forks whose trunk begins in it, any other alpha shows it. Empty goes back to the
  /// colours of the vessels' kinds.
  void setSweepColours(std::span<const std::uint32_t> colours);

  /// Draws and waits until the picture is done.
  void draw(const RenderInput& input);

  /// The same picture in slices, so that a program can do something else between them: begin() takes the
  /// input, each step() draws meshes, some of the vessels, their shade, some thousands of capillaries, or
  /// what is translucent. False: the picture is whole. Until then there is none; draw(), begin() and what
  /// changes the renderer leave it as it is.
  void begin(const RenderInput& input);
  bool step();

  /// Another network in the same body from the next frame on, or the same with other quads: meshes, pipelines
  /// and size stay, so that it takes as long as its tables take to upload. Without capillaries: grow().
  /// @param options  of which shape, pixelError, forks and table count; who takes other quads gives `levels`
  /// at
  ///                 construction
  void take(const Network& network, const RenderOptions& options);
  /// Other capillaries from the next frame on; colours are those of the vessels' kinds again.
  /// @param growth  of the network; must outlive the renderer, or stay until others are taken; nullptr: none
  void grow(const Growth* growth, const CapillaryWish& wish);

  /// Pictures of another size from the next frame on. Network, meshes and pipelines stay.
  void resize(std::uint32_t width, std::uint32_t height);

  /// The latest draw()'s picture on the device: RenderOptions::supersample times the size in each direction,
  /// sRGB, in the layout that copies read from. Until the next draw() or resize().
  const gpu::Image& picture() const;

  /// The picture of the latest draw().
  Image readBack();

  /// Whether pictures have their forks from now on, or will within so long: RenderInput::waits.
  bool isSettled(std::chrono::milliseconds within) const;

  FrameTimes times() const;
  CapillaryCounts capillaryCounts() const;

  /// For comparison with times().draw and .tessellate: the time [ms, minimum of `repeats`] to draw the same
  /// tubes and caps from vertex buffers that hold all of them, with nothing else: no compute, no meshes, no
  /// clearing. Takes memory for every vertex. 0 without a clock on the device.
  double staticDraw(const RenderInput& input, unsigned repeats);

  std::uint64_t triangleCount() const;  ///< of tubes and caps, seen or not; 0 if the picture decides
  std::uint64_t drawnTriangleCount()
      const;  ///< of the latest frame's, those that may be seen, without patches
  std::uint32_t sweepCount() const;
  std::uint64_t templateBytes()
      const;  ///< device memory for all that batches of tubes write, and for patches
  const RenderOptions& options() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vasa
