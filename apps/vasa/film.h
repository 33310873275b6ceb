#pragma once
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atlas/colouring.h"
#include "camera_choice.h"
#include "frame_output.h"
#include "gpu/device.h"
#include "io/video.h"
#include "plate/plate.h"
#include "render/renderer.h"
#include "scene/frame.h"
#include "scene/growth.h"

namespace vasa::cli {

/// What is to be drawn, settled before the first frame.
struct FilmJob {
  SceneFile choice;
  Scene scene;
  const Clip* clip = nullptr;
  Clip timing;  ///< of the frames
  CameraMan camera;
  Look look;
  RenderOptions render;
  SweepTable table;
  std::unique_ptr<SceneGrowth> growth;  ///< none without capillaries
  FrameRange range;
  Shard shard;
  std::optional<FramePattern> pattern;  ///< of the pictures' files
  bool printed = false;                 ///< the picture goes to standard output
  std::string video;                    ///< file; empty: none
  bool resume = false;                  ///< keeps pictures of an earlier, stopped run
  bool highlightContacts = false;
  std::uint64_t runHash = 0;  ///< tells this run's pictures from another's
  PictureSize size;           ///< of what is written
  std::optional<plate::PlateStyle>
      page;                 ///< labels beside the picture, which is smaller then than what is written
  std::vector<char> shown;  ///< one a vessel
  atlas::Colouring colouring = atlas::Colouring::kind;
  atlas::VesselGroups groups;
};

/// Draws the frames of a job and hands each picture on; encoding and writing go on beside the next frame's
/// drawing.
class Film {
 public:
  /// @param job  must outlive this
  Film(const FilmJob& job, const FrameOptions& frame, gpu::Device& device);

  /// Fails with resumeMismatch where a picture that is there is another run's; else as files and the device
  /// do. What was written stays.
  Result<void> run();

  CapillaryCounts capillaries() const { return renderer_.capillaryCounts(); }

  std::uint32_t drawn = 0, kept = 0;
  float largestStep = 0;       ///< [m] of a control point between consecutive frames
  float largestJointStep = 0;  ///< [m] of a joint: what the motion itself asks for
  std::uint32_t largestStepFrame = 0;

 private:
  Result<void> makeFrame(std::uint32_t frame);
  Result<Image> withLabels(Image picture, const Camera& camera) const;
  std::vector<std::uint32_t> withoutHidden(std::vector<std::uint32_t> colours) const;
  void highlightContacts();
  Result<bool> isPresent(std::uint32_t frame) const;
  std::string stamp(std::uint32_t frame) const;
  Result<void> write(std::uint32_t frame, const Image& picture);
  Result<void> finishWriting();
  void noteStep(std::uint32_t frame);

  const FilmJob& job_;
  std::future<std::unique_ptr<FrameMaker>> making_;
  Renderer renderer_;
  std::unique_ptr<FrameMaker> maker_;
  std::optional<VideoWriter> video_;
  std::future<Result<void>> writing_;
  std::vector<vec4> previous_;
  Pose previousPose_;
  std::uint32_t previousFrame_ = 0;
};

}  // namespace vasa::cli
