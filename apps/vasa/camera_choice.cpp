#include "camera_choice.h"

#include <fmt/format.h>

#include <charconv>

#include "core/log.h"

namespace vasa::cli {
namespace {

std::optional<vec3> parseVector(std::string_view text) {
  vec3 value;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value[axis]);
    if (error != std::errc() || !std::isfinite(value[axis])) return std::nullopt;
    text.remove_prefix(std::size_t(end - text.data()));
    if (axis < 2) {
      if (!text.starts_with(',')) return std::nullopt;
      text.remove_prefix(1);
    }
  }
  return text.empty() ? std::optional(value) : std::nullopt;
}

const std::string& nameOf(const Scene& scene, const Subject& subject) {
  return subject.vessel.valid() ? scene.network.vessel(subject.vessel).name
                                : scene.body.skeleton.joints[subject.joint.value].name;
}

// "x,y,z", "x,y,z/x,y,z" or "x,y,z/x,y,z/angle"
bool parsePlace(const std::string& text, CameraChoice& choice) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == '/')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  if (parts.size() > 3) return false;
  choice.position = parseVector(parts[0]);
  if (!choice.position) return false;
  choice.target.reset();
  if (parts.size() > 1 && !(choice.target = parseVector(parts[1]))) return false;
  if (parts.size() > 2) {
    const char* end = parts[2].data() + parts[2].size();
    const auto [stop, error] = std::from_chars(parts[2].data(), end, choice.angleDegrees);
    if (error != std::errc() || stop != end || !(choice.angleDegrees >= 1 && choice.angleDegrees <= 150))
      return false;
  }
  return true;
}

}  // namespace

void addCameraOptions(CLI::App& sub, CameraOptions& options) {
  sub.add_option(
      "--camera", options.camera,
      "front, back, left, right, top, or POSITION[/TARGET[/ANGLE]], e.g. 0,1.2,3/0,1,0/25 (metres, degrees)");
  sub.add_option("--focus", options.focus, "Vessel or joint that fills the picture and is followed");
  sub.add_option("--distance", options.distance, "How far off, as a multiple of what just fits (default 1)")
      ->check(CLI::Range(0.01, 100.0));
}

Result<CameraChoice> chooseCamera(CameraChoice choice, const CameraOptions& options) {
  if (!options.focus.empty()) choice.focus = options.focus;
  if (options.distance > 0) choice.distanceFactor = options.distance;
  if (options.camera.empty()) return choice;
  if (viewNamed(options.camera)) {
    choice.view = options.camera;
    choice.position.reset();
  } else if (!parsePlace(options.camera, choice)) {
    return Error{
        Fault::usage,
        "--camera " + options.camera +
            ": give front, back, left, right, top, or POSITION/TARGET/ANGLE such as 0,1.2,3/0,1,0/25 (metres; 1 to 150 "
            "degrees)"};
  }
  return choice;
}

Result<CameraMan> CameraMan::create(const CameraChoice& choice, const Scene& scene, const Clip* clip,
                                    float aspect) {
  CameraMan man;
  const Aabb all = motionBounds(scene, clip);
  man.reach_ = choice.orthographic ? glm::length(all.extent()) : 0;
  man.still_ = cameraFrom(viewNamed(choice.view).value_or(View::front), all, aspect);
  man.still_.verticalAngle = glm::radians(choice.angleDegrees);
  if (choice.position) {
    man.still_.position = *choice.position;
    man.still_.target = choice.target.value_or(all.centre());
    if (glm::distance(man.still_.position, man.still_.target) < 1e-4f)
      return Error{Fault::usage, "the camera stands on its target; move one of them"};
  } else if (choice.focus.empty()) {
    man.goesAlong_ = true;
    man.still_ = focusOn(man.still_, all, aspect);
    man.still_.position =
        man.still_.target + choice.distanceFactor * (man.still_.position - man.still_.target);
  }
  if (choice.focus.empty()) return man;
  const auto subject = findSubject(scene, choice.focus);
  if (!subject) return subject.error();
  if (!subject->others.empty())
    logWarning(fmt::format("--focus {} is part of {} names; \"{}\" is looked at, not \"{}\"{}", choice.focus,
                           subject->others.size() + 1, nameOf(scene, *subject), subject->others.front(),
                           subject->others.size() > 1 ? " nor the others" : ""));
  man.subject_ = *subject;
  const Aabb box = subjectBounds(scene, *subject, restPose(scene.body.skeleton), scene.network.points());
  Camera close = man.still_;
  if (!choice.position) {
    close = focusOn(man.still_, box, aspect);
    close.position = close.target + choice.distanceFactor * (close.position - close.target);
  }
  man.subjectOffset_ = close.position - box.centre();
  man.still_ = close;
  return man;
}

Camera CameraMan::at(const Scene& scene, const Pose& pose, std::span<const vec4> points) const {
  Camera camera = still_;
  if (goesAlong_) {
    camera.position += wayOverFloor(scene, pose);
    camera.target += wayOverFloor(scene, pose);
  }
  if (subject_) {
    camera.target = subjectBounds(scene, *subject_, pose, points).centre();
    camera.position = camera.target + subjectOffset_;
  }
  return reach_ > 0 ? orthographic(camera, reach_) : camera;
}

}  // namespace vasa::cli
