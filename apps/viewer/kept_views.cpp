#include "viewer/kept_views.h"

#include <algorithm>
#include <cmath>

namespace vasa::viewer {

ViewChoice viewOf(Orbit orbit, unsigned number) {
  const bool orthographic = orbit.orthographic();
  orbit.setOrthographic(false);
  const Camera camera = orbit.camera(0, 1);
  const double degrees = double(glm::degrees(camera.verticalAngle));
  return {number, camera.position, camera.target, float(std::round(degrees * 1000) / 1000), orthographic};
}

void keepView(std::vector<ViewChoice>& views, const ViewChoice& view) {
  std::erase_if(views, [&](const ViewChoice& other) { return other.number == view.number; });
  views.insert(std::ranges::upper_bound(views, view.number, {}, &ViewChoice::number), view);
}

bool goToView(const std::vector<ViewChoice>& views, unsigned number, Orbit& orbit) {
  const auto view = std::ranges::find(views, number, &ViewChoice::number);
  if (view == views.end()) return false;
  orbit.take({.position = view->position,
              .target = view->target,
              .verticalAngle = glm::radians(view->angleDegrees)});
  orbit.setOrthographic(view->orthographic);
  return true;
}

}  // namespace vasa::viewer
