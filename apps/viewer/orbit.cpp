#include "viewer/orbit.h"

#include <algorithm>
#include <cmath>

namespace vasa::viewer {
namespace {

constexpr float kNearest = 0.005f, kFarthest = 200;  // [m]
constexpr float kNearShare = 0.02f;
constexpr float kStraightUp = 0.5f * kPi;

float fitted(float angle) { return std::remainder(angle, 2 * kPi); }

}  // namespace

vec3 Orbit::backwards() const {
  return {std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), std::cos(yaw_) * std::cos(pitch_)};
}

// Up follows the pitch, so that straight above and below the picture does not flip.
Camera Orbit::plain() const {
  Camera camera;
  camera.target = pivot_;
  camera.position = pivot_ + distance_ * backwards();
  camera.up = {-std::sin(yaw_) * std::sin(pitch_), std::cos(pitch_), -std::cos(yaw_) * std::sin(pitch_)};
  camera.verticalAngle = angle_;
  return camera;
}

void Orbit::orbit(vec2 turn) {
  yaw_ = fitted(yaw_ - turn.x);
  pitch_ = std::clamp(pitch_ + turn.y, -kStraightUp, kStraightUp);
}

void Orbit::pan(vec2 pixels, float height) {
  const float metres = 2 * distance_ * std::tan(angle_ / 2) / std::max(height, 1.0f);
  const mat3 axes = cameraAxes(plain());
  pivot_ += metres * (-pixels.x * axes[0] + pixels.y * axes[1]);
}

void Orbit::dolly(float steps, vec2 place) {
  const float before = distance_;
  distance_ = std::clamp(distance_ * std::pow(0.9f, steps), kNearest, kFarthest);
  const mat3 axes = cameraAxes(plain());
  const float moved = (before - distance_) * std::tan(angle_ / 2);
  pivot_ += moved * (place.x * axes[0] + place.y * axes[1]);
}

void Orbit::look(View view) {
  yaw_ = view == View::back ? kPi : view == View::left ? kPi / 2 : view == View::right ? -kPi / 2 : 0;
  pitch_ = view == View::top ? kStraightUp : 0;
}

void Orbit::lookFromBelow() {
  yaw_ = 0;
  pitch_ = -kStraightUp;
}

void Orbit::frame(const Aabb& box, float aspect) {
  if (box.empty()) return;
  const Camera close = focusOn(plain(), box, aspect);
  pivot_ = close.target;
  distance_ = std::clamp(glm::distance(close.position, close.target), kNearest, kFarthest);
}

void Orbit::take(const Camera& camera) {
  const vec3 back = camera.position - camera.target;
  pivot_ = camera.target;
  distance_ = std::clamp(glm::length(back), kNearest, kFarthest);
  pitch_ = std::asin(std::clamp(back.y / distance_, -1.0f, 1.0f));
  if (std::abs(back.x) + std::abs(back.z) > 1e-6f) yaw_ = std::atan2(back.x, back.z);
  angle_ = camera.verticalAngle;
  orthographic_ = camera.orthographicHeight > 0;
}

Camera Orbit::camera(float cut, float reach) const {
  Camera camera = plain();
  const float least = kNearShare * distance_;
  camera.nearDistance = least;
  if (orthographic_) camera = vasa::orthographic(camera, reach);
  if (cut > 0) {
    const float middle = glm::distance(camera.position, pivot_);
    camera.nearDistance = std::max(least, middle - reach + 2 * reach * cut);
  }
  return camera;
}

}  // namespace vasa::viewer
