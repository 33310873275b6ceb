#include <algorithm>
#include <cmath>
#include <limits>

#include "body/skinning.h"
#include "network/pick.h"
#include "viewer/paint.h"
#include "viewer/projection.h"
#include "viewer/session.h"

// What a click in the picture means.
namespace vasa::viewer {
namespace {

constexpr float kReachPixels = 2.5f;  // of an ordinary screen, of a click
constexpr float kSeenThrough = 0.9f;  // opacity below which one can click what lies behind
constexpr float kSlack = 0.002f;      // [m] a vessel in a bone's groove is no vessel behind it

// In the picture's pixels, from its top left corner.
Ray rayThrough(const Camera& camera, vec2 place, vec2 size) {
  const mat3 axes = cameraAxes(camera);
  const float tangent = std::tan(camera.verticalAngle / 2);
  const vec2 across = vec2(place.x - size.x / 2, size.y / 2 - place.y) * 2.0f / size.y;
  if (camera.orthographicHeight > 0) {
    const vec2 metres = across * (camera.orthographicHeight / 2);
    return {camera.position + metres.x * axes[0] + metres.y * axes[1], -axes[2], camera.nearDistance};
  }
  const vec3 way = tangent * (across.x * axes[0] + across.y * axes[1]) - axes[2];
  return {camera.position, glm::normalize(way), camera.nearDistance * glm::length(way)};
}

// Leaves out what of the ray a plane cuts off before its visible part. @return where that ends
float keepTo(Ray& ray, vec4 plane) {
  const float there = glm::dot(vec3(plane), ray.origin) + plane.w,
              rate = glm::dot(vec3(plane), ray.direction);
  if (rate > 0) ray.from = std::max(ray.from, -there / rate);
  return rate < 0 ? -there / rate : there < 0 && rate == 0 ? 0 : std::numeric_limits<float>::infinity();
}

// Where a ray meets a triangle (Möller, Trumbore 1997); infinity where it does not.
float meets(const Ray& ray, vec3 a, vec3 b, vec3 c) {
  constexpr float none = std::numeric_limits<float>::infinity();
  const vec3 ab = b - a, ac = c - a, across = glm::cross(ray.direction, ac);
  const float size = glm::dot(ab, across);
  if (size == 0) return none;
  const vec3 from = ray.origin - a, side = glm::cross(from, ab);
  const float u = glm::dot(from, across) / size, v = glm::dot(ray.direction, side) / size;
  if (u < 0 || v < 0 || u + v > 1) return none;
  const float distance = glm::dot(ac, side) / size;
  return distance >= ray.from ? distance : none;
}

bool hides(MeshRole role, const Look& look) {
  if (look.style == LookStyle::xray) return false;
  switch (role) {
    case MeshRole::bones:
      return look.drawBones && look.boneOpacity >= kSeenThrough;
    case MeshRole::heart:
      return look.drawHeart && look.heartOpacity >= kSeenThrough;
    case MeshRole::other:
      return look.drawOther && look.otherOpacity >= kSeenThrough;
    case MeshRole::skin:
      return look.drawSkin && look.skinOpacity >= kSeenThrough;
    case MeshRole::organs:
    case MeshRole::keepOut:
      break;  // always let light through
  }
  return false;
}

// How far along the ray a bone, the heart or whole skin begins to hide what lies behind.
float hiddenBehind(const Document& document, const PosedBody& body, const Look& look, const Ray& ray) {
  float nearest = std::numeric_limits<float>::infinity();
  std::vector<vec3> places;
  for (const SkinnedMesh& mesh : document.scene.body.meshes) {
    if (!hides(roleNamed(mesh.name), look)) continue;
    skinPositions(mesh, body.jointMatrices, places);
    for (const uvec3& t : mesh.mesh.triangles)
      nearest = std::min(nearest, meets(ray, places[t.x], places[t.y], places[t.z]));
  }
  return nearest + kSlack;
}

}  // namespace

// By a bone, the heart or whole skin, from where the camera is.
bool Session::isHidden(vec3 place) const {
  const Rect rect = pictureRect();
  const Camera camera = cameraNow();
  const auto seen = seenAt(place, camera, rect);
  if (!seen) return false;
  Ray ray = rayThrough(camera, *seen - vec2(rect.left, rect.top), {rect.width, rect.height});
  if (camera.cut) keepTo(ray, *camera.cut);
  return hiddenBehind(*document_, *body_, state_.look, ray) < glm::dot(place - ray.origin, ray.direction);
}

// What can be seen at a place of the picture.
std::optional<VesselPlace> Session::vesselAt(vec2 place) const {
  const Rect rect = pictureRect();
  const Camera camera = cameraNow();
  Ray ray = rayThrough(camera, place, {rect.width, rect.height});
  const float farthest = camera.cut ? keepTo(ray, *camera.cut) : std::numeric_limits<float>::infinity();
  const std::vector<char> shown = shownVessels(*document_, state_);
  const float slack = kReachPixels * ui_.scale() * 2 * std::tan(state_.orbit.angle() / 2) / rect.height;
  auto hit = pick(
      document_->scene.network, body_->points, ray, [&](VesselId v) { return shown[v.value] != 0; }, slack);
  if (hit && (hit->distance > farthest || hit->distance > hiddenBehind(*document_, *body_, state_.look, ray)))
    hit.reset();
  return hit ? std::optional(VesselPlace{hit->vessel, hit->parameter}) : std::nullopt;
}

// Names what a pointer rests on. Meshes before it make that cost a picture's time, so not while it moves.
void Session::lookUnderPointer() {
  constexpr double kRests = 0.15;  // [s]
  if (movedAt_ < 0 || !document_ || !body_ || now_ - movedAt_ < kRests) return;
  movedAt_ = -1;
  const Rect rect = pictureRect();
  const bool can = !ui_.wantsPointer() && !pointer_.dragging() && !poseTool_.held() && !editor_.held() &&
                   !state_.playback.playing && rect.holds(pointer_.place());
  const auto under = can ? vesselAt(pointer_.place() - vec2(rect.left, rect.top)) : std::nullopt;
  if (under != state_.pointedAt) panelFrames_ = kRestingFrames;
  state_.pointedAt = under;
}

// Of a joint's handle while posing, else of the vessel there, which becomes the chosen one.
void Session::openContext(vec2 place) {
  state_.context = {.opens = true};
  const Rect rect = pictureRect();
  if (state_.posing) {
    const auto handle =
        handleAt(jointHandles(*document_->mannequin, body_->pose, cameraNow(), rect, ui_.scale()),
                 place + vec2(rect.left, rect.top), ui_.scale());
    if (handle) state_.context.joint = document_->mannequin->grips()[handle->grip].limb.joints.back().joint;
    if (handle) state_.joint = state_.context.joint;
    if (handle) return;
  }
  const auto under = vesselAt(place);
  if (!under) return;
  state_.context.vessel = true;
  const auto chosen = chosenVessels(state_);
  if (std::ranges::find(chosen, under->vessel) == chosen.end()) state_.alsoChosen.clear();
  // One of several that are chosen stays one of them.
  else if (state_.selected->vessel != under->vessel) {
    std::erase(state_.alsoChosen, under->vessel);
    state_.alsoChosen.push_back(state_.selected->vessel);
  }
  state_.selected = under;
  if (state_.outliner.on) revealChoice(state_, *document_->groups);
}

void Session::click(const Click& click) {
  if (!document_ || !body_) return;
  if (click.right) return openContext(click.place);
  const Rect rect = pictureRect();
  const Camera camera = cameraNow();
  const auto place = vesselAt(click.place);
  if (state_.editing && editor_.click(click.place, place, *document_, *body_, camera, rect, state_)) return;
  if (state_.measuring && place) {
    if (!state_.from || state_.to)
      state_.from = place, state_.to.reset();
    else
      state_.to = place;
  } else if (!state_.measuring) {
    const bool add = pointer_.control() && place && state_.selected;
    state_.alsoChosen = add ? chosenVessels(state_) : std::vector<VesselId>{};
    state_.selected = place;
    if (!place) state_.isolate = false;
    if (state_.outliner.on) revealChoice(state_, *document_->groups);
  }
  if (click.twice && state_.selected) state_.wishFocus = true;
}

}  // namespace vasa::viewer
