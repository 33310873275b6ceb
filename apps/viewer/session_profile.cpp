#include "viewer/session.h"

// Table III: what `vasa profile` measures of a clip by default, a frame at a time, so that the window stays
// alive.
namespace vasa::viewer {
namespace {

constexpr std::uint32_t kWidth = 1280, kHeight = 720;

ProfileSetting settingOf(const Scene& scene, const Clip* clip, bool avoid) {
  const Aabb all = motionBounds(scene, clip);
  constexpr float aspect = float(kWidth) / float(kHeight);
  Camera whole = cameraFrom(View::front, all, aspect);
  whole.verticalAngle = glm::radians(CameraChoice{}.angleDegrees);
  whole = focusOn(whole, all, aspect);
  return {.scene = &scene,
          .clip = clip,
          .meshes = {},
          .render = {.width = kWidth, .height = kHeight, .samples = 1},
          .look = {},
          .camera =
              [&scene, whole](const FrameMaker& maker) {
                Camera camera = whole;
                camera.position += wayOverFloor(scene, maker.pose());
                camera.target += wayOverFloor(scene, maker.pose());
                return camera;
              },
          .avoid = avoid};
}

}  // namespace

void Session::profile() {
  if (std::exchange(state_.wishProfile, false) && document_) {
    const bool running = profiling_;
    profiler_.reset();
    profiling_ = !running;
    if (profiling_) {
      state_.playback.playing = false;
      const auto& clips = document_->scene.body.clips;
      const Clip* clip = state_.playback.clip >= 0 ? &clips[std::size_t(state_.playback.clip)] : nullptr;
      profiler_ = std::make_unique<Profiler>(
          device_, settingOf(document_->scene, clip, state_.forces.avoid),
          std::vector<ProfileQuads>{{{4, 5}}, {{4, 10}}, {{8, 5}}, {{8, 10}}, {{}, kAutoPixelError}});
    }
    panelFrames_ = kRestingFrames;
  }
  if (!profiling_) return;
  const std::size_t before = profiler_->done();
  profiling_ = profiler_->step();
  if (profiler_->done() != before) panelFrames_ = kRestingFrames;
  report_.profile = profiler_->rows();
}

}  // namespace vasa::viewer
