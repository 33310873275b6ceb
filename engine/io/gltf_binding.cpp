#include "io/gltf_binding.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/direction.h"

namespace vasa::gltf {
namespace {

constexpr float kSamePose = 1e-3f;     // of the skeleton's size
constexpr float kAnotherUnit = 0.69f;  // logarithm of 2
constexpr float kTurnedLinks =
    0.3f;  // mean cosine between links in both poses below which the space is another

bool sound(const mat4& m) {
  const float determinant = std::abs(glm::determinant(mat3(m)));
  return std::isfinite(determinant) && determinant > 1e-12f && std::isfinite(glm::dot(m[3], m[3]));
}

// T R S of a matrix, where it is one.
std::optional<JointTransform> parts(const mat4& m) {
  JointTransform out;
  out.translation = vec3(m[3]);
  mat3 axes(m);
  for (int i = 0; i < 3; ++i) out.scale[i] = glm::length(axes[i]);
  if (glm::determinant(axes) < 0) out.scale.x = -out.scale.x;
  for (int i = 0; i < 3; ++i) axes[i] /= out.scale[i];
  out.rotation = glm::normalize(glm::quat_cast(axes));
  const float size = difference(m, mat4(0));
  if (!(difference(out.matrix(), m) <= kSamePose * std::max(size, 1e-6f))) return std::nullopt;
  return out;
}

struct Link {
  vec3 bound, posed;
};

// From each of the skin's joints to the nearest one above it that the skin has, too.
std::vector<Link> linksOf(const Skeleton& skeleton, const BoundSkin& skin,
                          const std::vector<std::optional<mat4>>& bound) {
  std::vector<Link> links;
  for (const JointId joint : skin.joints) {
    JointId above = skeleton.joints[joint.value].parent;
    while (above.valid() && !bound[above.value]) above = skeleton.joints[above.value].parent;
    if (!above.valid()) continue;
    links.push_back(
        {vec3((*bound[joint.value])[3] - (*bound[above.value])[3]),
         vec3(skeleton.joints[joint.value].restWorld[3] - skeleton.joints[above.value].restWorld[3])});
  }
  return links;
}

// As those of a skin without matrices, whose vertices are stored beside their joints: no pose of a body.
bool inOnePlace(const std::vector<Link>& links) {
  float bound = 0, posed = 0;
  for (const Link& link : links)
    bound = std::max(bound, glm::length(link.bound)), posed = std::max(posed, glm::length(link.posed));
  return posed > 0 && !(bound > 1e-6f * posed);
}

float likeness(const std::vector<Link>& links, const mat3& turn) {
  float sum = 0, weight = 1e-12f;
  for (const Link& link : links) {
    const float length = glm::length(link.bound) * glm::length(link.posed);
    sum += glm::dot(turn * link.bound, link.posed), weight += length;
  }
  return sum / weight;
}

// Poses turn and move joints, but leave them their size: half of the joints are right.
float unitOfPacked(const Skeleton& skeleton, const BoundSkin& skin) {
  std::vector<float> units;
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    units.push_back(std::cbrt(std::abs(
        glm::determinant(mat3(skeleton.joints[skin.joints[i].value].restWorld * skin.inverseBinds[i])))));
  const auto middle = units.begin() + std::ptrdiff_t(units.size() / 2);
  std::ranges::nth_element(units, middle);
  return *middle;
}

// The unit is the world's or the nodes', whichever is nearer; poses stretch links, but do not double them.
float unitOf(const Skeleton& skeleton, const std::vector<Link>& links) {
  float bound = 0, posed = 0;
  for (const Link& link : links) bound += glm::length(link.bound), posed += glm::length(link.posed);
  const float measured = bound > 0 ? posed / bound : 1.0f;
  const float ofNodes = glm::length(vec3(skeleton.rootTransform[0]));
  const auto off = [&](float unit) { return std::abs(std::log(measured / unit)); };
  const float scale = ofNodes > 0 && off(ofNodes) < off(1) ? ofNodes : 1.0f;
  return off(scale) > kAnotherUnit ? measured : scale;
}

// The first of the world, the nodes above and their turns by right angles that is likely enough, else the
// likeliest.
mat4 spaceOf(const Skeleton& skeleton, const BoundSkin& skin, const std::vector<std::optional<mat4>>& bound,
             const std::vector<Link>& links) {
  const mat4& above = skeleton.rootTransform;
  const float scale = skin.packed ? unitOfPacked(skeleton, skin) : unitOf(skeleton, links);
  const mat3 nodes = sound(above) ? glm::mat3_cast(rotationOf(above)) : mat3(1);
  const bool inNodes = likeness(links, nodes) > likeness(links, mat3(1)) + 1e-3f;
  mat3 turn = inNodes ? nodes : mat3(1);
  if (likeness(links, turn) < kTurnedLinks)
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {1.0f, -1.0f})
        for (int quarter = 0; quarter < 4; ++quarter) {
          vec3 x(0), y(0);
          x[axis] = side, y[(axis + 1 + quarter % 2) % 3] = quarter < 2 ? 1.0f : -1.0f;
          const mat3 tried = mat3(x, y, glm::cross(x, y));
          if (likeness(links, tried) > likeness(links, turn) + 1e-3f) turn = tried;
        }
  mat4 space(scale * turn);
  space[3] = vec4(inNodes ? vec3(above[3]) : vec3(0), 1);
  if (!skin.packed) return space;
  const JointId topmost = *std::ranges::min_element(skin.joints, {}, &JointId::value);  // parents come first
  space[3] += skeleton.joints[topmost.value].restWorld[3] - space * (*bound[topmost.value])[3];
  return space;
}

bool isPosed(const Skeleton& skeleton, const BoundSkin& skin) {
  const auto at = [&](std::size_t i) {
    return skeleton.joints[skin.joints[i].value].restWorld * skin.inverseBinds[i];
  };
  float size = 0;
  for (const JointId joint : skin.joints)
    size = std::max(size, difference(skeleton.joints[joint.value].restWorld, mat4(0)));
  for (std::size_t i = 1; i < skin.joints.size(); ++i)
    if (!(difference(at(i), at(0)) <= kSamePose * size)) return true;
  return false;
}

}  // namespace

float difference(const mat4& a, const mat4& b) {
  float largest = 0;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) largest = std::max(largest, std::abs(a[i][k] - b[i][k]));
  return largest;
}

const BoundSkin* largestSkin(const std::vector<BoundSkin>& skins) {
  const auto largest =
      std::ranges::max_element(skins, {}, [](const BoundSkin& skin) { return skin.joints.size(); });
  return largest == skins.end() ? nullptr : &*largest;
}

bool restAtBinding(Skeleton& skeleton, const std::vector<BoundSkin>& skins) {
  const BoundSkin* const largest = largestSkin(skins);
  if (!largest || !isPosed(skeleton, *largest)) return false;
  std::vector<std::optional<mat4>> bound(skeleton.joints.size());
  for (std::size_t i = 0; i < largest->joints.size(); ++i) {
    if (!sound(largest->inverseBinds[i])) return false;
    bound[largest->joints[i].value] = glm::inverse(largest->inverseBinds[i]);
  }
  const std::vector<Link> links = linksOf(skeleton, *largest, bound);
  if (inOnePlace(links)) return false;
  const mat4 space = spaceOf(skeleton, *largest, bound, links);
  Skeleton moved = skeleton;
  for (std::size_t j = 0; j < moved.joints.size(); ++j) {
    Skeleton::Joint& joint = moved.joints[j];
    const mat4 above =
        joint.parent.valid() ? moved.joints[joint.parent.value].restWorld : moved.rootTransform;
    joint.restWorld = bound[j] ? space * *bound[j] : above * joint.rest.matrix();
    if (!bound[j]) continue;
    if (!sound(above)) return false;
    const auto rest = parts(glm::inverse(above) * joint.restWorld);
    if (!rest) return false;
    joint.rest = *rest;
  }
  skeleton = std::move(moved);
  return true;
}

}  // namespace vasa::gltf
