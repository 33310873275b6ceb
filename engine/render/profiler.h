#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "scene/frame.h"

namespace vasa {

/// A tessellation to be measured.
struct ProfileQuads {
  SweepShape shape;
  float pixelError = 0;  ///< [pixels] > 0: by size on the picture, `shape` is not used
};

/// One tessellation's row of the paper's Table III: medians over changing poses, after warm-up.
struct ProfileRow {
  ProfileQuads quads;
  std::uint32_t sweeps = 0;
  std::uint64_t triangles = 0;  ///< seen or not; those drawn where the picture decides
  std::vector<std::pair<std::string, double>>
      stages;  ///< "frame_ms", "pose_ms" ... "static_draw_ms", in a frame's order
  CapillaryCounts capillaries;
  std::uint64_t templateBytes = 0;

  double fps() const;
  std::string name() const;  ///< "8x5" or "auto"
};

/// Stages of a frame under the names that reports use ("detect_ms"), and what they took [ms], in a frame's
/// order.
using StageTimes = std::vector<std::pair<const char*, double>>;
/// @param avoided  with the stages of avoidance
StageTimes shapeStages(const FrameReport& report, bool avoided);
/// @param capillaries  with theirs
StageTimes pictureStages(const FrameTimes& times, bool capillaries);

/// What is to be measured.
struct ProfileSetting {
  const Scene* scene = nullptr;
  const Clip* clip = nullptr;           ///< nullptr: the rest pose again and again
  std::span<const SkinnedMesh> meshes;  ///< drawn beside the vessels
  RenderOptions render;                 ///< but its quads
  Look look;
  std::function<Camera(const FrameMaker&)> camera;
  bool avoid = true;
  std::uint32_t frames = 40;  ///< a row, each another pose
};

/// Measures one row after the other, a frame a step, so that an app can go on between two steps. Whole frames
/// are timed in one pass, as an app draws them: the next frame's shape is made on a thread of its own while
/// this one is drawn
/// ("frame_ms" from one picture to the next, "latency_ms" from a pose to its picture), and every eighth
/// picture is drawn once more from ready buffers ("static_draw_ms"). Stages are timed in another, one after
/// the other: taking the device's times puts barriers between them ("solve_ms" all of a shape, "picture_ms"
/// all of a picture).
class Profiler {
 public:
  Profiler(gpu::Device& device, ProfileSetting setting, std::vector<ProfileQuads> quads);
  ~Profiler();

  /// Makes the next frame. @return false once all rows are done
  bool step();
  std::size_t done() const { return rows_.size(); }
  std::size_t total() const { return wanted_.size(); }
  const std::vector<ProfileRow>& rows() const { return rows_; }

 private:
  struct Pass;
  struct FrameTime {
    double frame = 0, latency = 0, solve = 0, picture = 0;  // [ms]
  };
  void startPass(bool timed);
  void note(const FrameTime& time, const FrameReport& shape);
  void finishRow();

  gpu::Device& device_;
  ProfileSetting setting_;
  std::vector<ProfileQuads> wanted_;
  std::vector<ProfileRow> rows_;
  std::vector<std::pair<std::string, std::vector<double>>> samples_;
  std::vector<double> staticDraws_;
  std::unique_ptr<Pass> pass_;
};

}  // namespace vasa
