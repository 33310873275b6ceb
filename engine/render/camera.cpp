#include "render/camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vasa {
namespace {

constexpr float kMargin = 1.08f;     // 4 % on each side
constexpr float kSmallest = 0.01f;   // [m] least extent that is looked at
constexpr float kNearShare = 0.02f;  // near plane as a share of the distance

vec3 corner(const Aabb& box, int index) {
  return {index & 1 ? box.high.x : box.low.x, index & 2 ? box.high.y : box.low.y,
          index & 4 ? box.high.z : box.low.z};
}

// The least distance from the box's centre at which its eight corners are in the picture.
float fittingDistance(const Camera& camera, const Aabb& box, float aspect) {
  const mat3 axes = cameraAxes(camera);
  const float slopeY = std::tan(camera.verticalAngle / 2) / kMargin, slopeX = slopeY * aspect;
  float distance = 0;
  for (int i = 0; i < 8; ++i) {
    const vec3 offset = (corner(box, i) - box.centre()) * axes;  // in the camera's axes
    distance =
        std::max({distance, std::abs(offset.x) / slopeX + offset.z, std::abs(offset.y) / slopeY + offset.z});
  }
  return distance;
}

float fittingHeight(const Camera& camera, const Aabb& box, float aspect) {
  const mat3 axes = cameraAxes(camera);
  float half = 0;
  for (int i = 0; i < 8; ++i) {
    const vec3 offset = (corner(box, i) - box.centre()) * axes;
    half = std::max({half, std::abs(offset.y), std::abs(offset.x) / aspect});
  }
  return 2 * half * kMargin;
}

}  // namespace

mat3 cameraAxes(const Camera& camera) {
  const vec3 back = glm::normalize(camera.position - camera.target);
  const vec3 side = glm::cross(camera.up, back);
  const float length = glm::length(side);
  const vec3 right = length > 1e-6f ? side / length : anyPerpendicular(back);
  return {right, glm::cross(back, right), back};
}

mat4 viewProjection(const Camera& camera, float aspect) {
  const mat3 axes = cameraAxes(camera);
  mat4 view(glm::transpose(axes));
  view[3] = vec4(-camera.position * axes, 1);
  mat4 projection(0.0f);
  if (camera.orthographicHeight > 0) {
    const float depth = camera.farDistance - camera.nearDistance;
    projection[0][0] = 2 / (camera.orthographicHeight * aspect);
    projection[1][1] = -2 / camera.orthographicHeight;
    projection[2][2] = 1 / depth;
    projection[3][2] = camera.farDistance / depth;
    projection[3][3] = 1;
  } else {
    const float focal = 1 / std::tan(camera.verticalAngle / 2);
    projection[0][0] = focal / aspect;
    projection[1][1] = -focal;
    projection[2][3] = -1;
    projection[3][2] = camera.nearDistance;
  }
  return projection * view;
}

std::optional<View> viewNamed(std::string_view name) {
  constexpr std::string_view names[] = {"front", "back", "left", "right", "top"};
  const auto found = std::find(std::begin(names), std::end(names), name);
  if (found == std::end(names)) return std::nullopt;
  return View(found - std::begin(names));
}

Camera cameraFrom(View view, const Aabb& box, float aspect) {
  static const vec3 towards[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
  Camera camera;
  camera.target = box.centre();
  camera.position = camera.target + towards[int(view)];
  if (view == View::top) camera.up = {0, 0, -1};
  return focusOn(camera, box, aspect);
}

Camera orthographic(Camera camera, float reach) {
  const vec3 away = camera.position - camera.target;
  const float distance = glm::length(away), back = std::max(0.0f, 2 * reach - distance);
  camera.orthographicHeight = 2 * distance * std::tan(camera.verticalAngle / 2);
  camera.position += back / distance * away;
  camera.farDistance = distance + 2 * reach + back;
  return camera;
}

Camera focusOn(const Camera& camera, const Aabb& box, float aspect) {
  assert(!box.empty() && aspect > 0);
  Aabb room = box;
  const vec3 missing = 0.5f * glm::max(vec3(kSmallest) - box.extent(), vec3(0));
  room.low -= missing;
  room.high += missing;
  Camera result = camera;
  const vec3 back = cameraAxes(camera)[2];
  const float distance = fittingDistance(camera, room, aspect);
  result.target = room.centre();
  result.position = result.target + distance * back;
  result.nearDistance = kNearShare * distance;
  if (camera.orthographicHeight > 0) {
    result.orthographicHeight = fittingHeight(camera, room, aspect);
    result.farDistance = result.nearDistance + 4 * distance + glm::length(room.extent());
  }
  return result;
}

}  // namespace vasa
