#pragma once
#include <memory>
#include <optional>

#include "gpu/device.h"
#include "render/renderer.h"
#include "viewer/pose_worker.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// What a picture shows; two equal ones look the same.
struct Shot {
  std::shared_ptr<const PosedBody> body;
  Camera camera;
  Look look;
  std::uint32_t width = 0, height = 0;  ///< [pixels]
  std::vector<std::uint32_t> colours;   ///< Renderer::setSweepColours()
  bool fine = false;                    ///< a still: 4 samples a pixel and ambient occlusion
  bool waits = false;                   ///< until it can have its forks (RenderInput::waits)
};

/// [ms] that slices of a picture may take before a person's wishes are looked for again.
constexpr double kSliceTime = 10;

/// Draws a document's pictures with two renderers: a fast one for what moves, with few capillaries, and one
/// for stills, which are made in slices. Each is made when it is first needed, and follows what is chosen
/// when it is used again.
class Painter {
 public:
  Painter(gpu::Device& device, std::uint32_t seed) : device_(device), seed_(seed) {}

  /// @param timed  take the stages' times, which makes pictures a little slower
  void choose(std::shared_ptr<const Document> document, const Detail& detail, bool timed);

  /// Draws and waits. The shot's body must be of the chosen document.
  void draw(const Shot& shot);
  /// The same in slices: Renderer::begin() and step(). Until step() returns false picture() is the one
  /// before.
  void begin(const Shot& shot);
  bool step();
  /// The latest picture is without forks, and would have them by now.
  bool isStale() const { return bare_ && last_ && last_->isSettled({}); }
  /// The latest picture, null before the first.
  const gpu::Image* picture() const { return last_ ? &last_->picture() : nullptr; }
  Image readBack() { return last_->readBack(); }

  FrameTimes times() const { return last_ ? last_->times() : FrameTimes{}; }
  CapillaryCounts capillaries() const { return last_ ? last_->capillaryCounts() : CapillaryCounts{}; }
  std::uint64_t triangles() const { return last_ ? last_->drawnTriangleCount() : 0; }

 private:
  struct Brush {
    std::unique_ptr<Renderer> renderer;
    std::vector<std::uint32_t> colours;
    // What it was made for. It holds no more of a document than it needs: another one may have been opened.
    std::shared_ptr<const BodyLevels> levels;
    std::shared_ptr<const SweepTable> table;
    std::shared_ptr<const Document> grown;  // where its capillaries grow
    Detail detail;
    bool timed = false;
  };
  Brush& brush(const Shot& shot);
  Renderer& prepared(const Shot& shot);

  gpu::Device& device_;
  std::uint32_t seed_;
  std::shared_ptr<const Document> document_;
  Detail detail_;
  bool timed_ = false;
  Brush live_, still_;
  Renderer* last_ = nullptr;
  bool compiled_ = false;  // the forks' shader
  bool bare_ = false;      // what is shown is without forks
};

}  // namespace vasa::viewer
