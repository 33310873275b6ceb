#include "collide/bounding_boxes.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace vasa {
namespace {

constexpr float kRounding = 4e-7f;  // of a coordinate: a few units in its last place

mat3 principalAxes(std::span<const vec3> points, vec3 mean) {
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
  for (const vec3& p : points) {
    const Eigen::Vector3f d(p.x - mean.x, p.y - mean.y, p.z - mean.z);
    covariance += d * d.transpose();
  }
  const float scale = covariance.trace();
  if (!(scale > 0)) return mat3(1);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(covariance / scale);
  const auto& v = solver.eigenvectors();
  return {vec3(v(0, 0), v(1, 0), v(2, 0)), vec3(v(0, 1), v(1, 1), v(2, 1)), vec3(v(0, 2), v(1, 2), v(2, 2))};
}

int largest(vec3 v) { return v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2; }

}  // namespace

AlignedBox AlignedBox::around(std::span<const vec3> points) {
  AlignedBox box{points.front(), points.front()};
  for (const vec3& p : points) box.low = glm::min(box.low, p), box.high = glm::max(box.high, p);
  return box;
}

void AlignedBox::corners(std::span<vec3, 8> out) const {
  for (std::size_t i = 0; i < 8; ++i)
    out[i] = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
}

vec3 AlignedBox::longest() const {
  vec3 axis(0);
  axis[largest(high - low)] = 1;
  return axis;
}

OrientedBox OrientedBox::around(std::span<const vec3> points) {
  vec3 mean(0);
  for (const vec3& p : points) mean += p;
  mean /= float(points.size());
  OrientedBox box;
  box.axes = principalAxes(points, mean);
  vec3 low(0), high(0);
  for (const vec3& p : points) {
    const vec3 along = (p - mean) * box.axes;  // dot products with the axes
    low = glm::min(low, along), high = glm::max(high, along);
  }
  box.centre = mean + box.axes * (0.5f * (low + high));
  const vec3 size = glm::abs(box.centre) + high - low;
  box.half = 0.5f * (high - low) + kRounding * (size.x + size.y + size.z);
  return box;
}

bool OrientedBox::meets(const OrientedBox& other) const {
  // Keeps products of parallel axes, which separate nothing, from deciding.
  constexpr float kParallel = 1e-6f;
  const mat3 r = glm::transpose(axes) * other.axes;  // r[j][i]: this box's axis i along the other's j
  const vec3 t = (other.centre - centre) * axes;
  mat3 s;
  for (int j = 0; j < 3; ++j) s[j] = glm::abs(r[j]) + kParallel;
  for (int i = 0; i < 3; ++i)
    if (std::abs(t[i]) > half[i] + other.half.x * s[0][i] + other.half.y * s[1][i] + other.half.z * s[2][i])
      return false;
  for (int j = 0; j < 3; ++j)
    if (std::abs(glm::dot(t, r[j])) > other.half[j] + glm::dot(half, s[j])) return false;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const float own = half[i1] * s[j][i2] + half[i2] * s[j][i1];
      const float others = other.half[j1] * s[j2][i] + other.half[j2] * s[j1][i];
      if (std::abs(t[i2] * r[j][i1] - t[i1] * r[j][i2]) > own + others) return false;
    }
  return true;
}

void OrientedBox::corners(std::span<vec3, 8> out) const {
  for (std::size_t i = 0; i < 8; ++i)
    out[i] = centre + axes * (half * vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
}

vec3 OrientedBox::longest() const { return axes[largest(half)]; }

}  // namespace vasa
