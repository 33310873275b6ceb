#pragma once
#include <CLI/CLI.hpp>

#include "render/camera.h"
#include "scene/frame.h"

namespace vasa::cli {

/// --camera and --focus, on top of what the scene file says.
struct CameraOptions {
  std::string camera, focus;
  float distance = 0;  ///< 0: as the scene says
};
void addCameraOptions(CLI::App& sub, CameraOptions& options);
Result<CameraChoice> chooseCamera(CameraChoice fromScene, const CameraOptions& options);

/// Gives each frame its camera: one that stands still where it was put, one that goes along with the body and
/// holds its whole motion, or one that goes with a subject. A function of the scene, the clip and the frame's
/// pose.
class CameraMan {
 public:
  static Result<CameraMan> create(const CameraChoice& choice, const Scene& scene, const Clip* clip,
                                  float aspect);
  Camera at(const Scene& scene, const Pose& pose, std::span<const vec4> points) const;

 private:
  Camera still_;
  bool goesAlong_ = false;
  std::optional<Subject> subject_;
  float reach_ = 0;        // [m] across the scene, for an orthographic camera; 0: perspective
  vec3 subjectOffset_{0};  // from the subject's middle to the camera
};

}  // namespace vasa::cli
