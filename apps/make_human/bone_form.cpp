#include "make_human/bone_form.h"

#include <algorithm>
#include <cmath>

#include "make_human/smooth_union.h"
#include "math/closest_point.h"

// The distance to an ellipsoid-like piece with half axes a, b and cap c: with k = |(u/a, v/b, e/c)|, e the
// excess over the tube's end, the surface is k = 1 and (k - 1) / |grad k| is the distance to first order.
// A cap flatter than the section would have a rim too sharp for the polygons: such an end is a plane, and its
// rim is rounded by c.
namespace vasa::human {
namespace {

/// p in a piece's own directions, and its half axes there.
struct Local {
  vec3 at{0}, half{1};
};

float distanceTo(const Local& local, float square) {
  const vec3 x = glm::abs(local.at) / local.half;
  const bool round = square == 2;
  const float sum = round ? x.x * x.x + x.y * x.y : std::pow(x.x, square) + std::pow(x.y, square);
  const float rho = round ? std::sqrt(sum) : std::pow(sum, 1 / square);
  const float k = std::sqrt(rho * rho + x.z * x.z);
  const float least = std::min(local.half.x, local.half.y);
  if (k < 1e-4f) return -least;
  vec3 slope{0, 0, x.z / local.half.z / k};
  if (sum > 0) {
    const float outer = rho / sum * rho / k;
    slope.x = outer * (round ? x.x : std::pow(x.x, square - 1)) / local.half.x;
    slope.y = outer * (round ? x.y : std::pow(x.y, square - 1)) / local.half.y;
  }
  return std::max((k - 1) / glm::length(slope), -least);
}

/// Beyond a tube's end.
float distanceToCap(const Local& local, float square) {
  const float cap = local.half.z;
  if (cap >= std::min(local.half.x, local.half.y)) return distanceTo(local, square);
  const float side = distanceTo({vec3(local.at.x, local.at.y, 0), local.half}, square);
  const vec2 over{std::max(side + cap, 0.0f), std::abs(local.at.z)};
  return std::max(glm::length(over) - cap, side);
}

}  // namespace

float BonePiece::distance(vec3 p) const {
  if (stations.size() == 1) {
    const Station& s = stations[0];
    const vec3 q = p - s.centre;
    return distanceTo({{glm::dot(q, s.across), glm::dot(q, s.up), glm::dot(q, glm::cross(s.across, s.up))},
                       {s.width, s.height, capStart}},
                      square);
  }
  std::size_t best = 0;
  float share = 0, nearest = 1e9f;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const float t = closestOnSegment(p, stations[i].centre, stations[i + 1].centre);
    const vec3 q = p - glm::mix(stations[i].centre, stations[i + 1].centre, t);
    const float square2 = glm::dot(q, q);
    if (square2 < nearest) nearest = square2, best = i, share = t;
  }
  const Station &a = stations[best], &b = stations[best + 1];
  const vec3 q = p - glm::mix(a.centre, b.centre, share);
  const bool atStart = best == 0 && share == 0, atEnd = best + 2 == stations.size() && share == 1;
  Local local;
  local.at = {glm::dot(q, glm::normalize(glm::mix(a.across, b.across, share))),
              glm::dot(q, glm::normalize(glm::mix(a.up, b.up, share))), 0};
  local.half = {glm::mix(a.width, b.width, share), glm::mix(a.height, b.height, share),
                atStart ? capStart : capEnd};
  if (!atStart && !atEnd) return distanceTo(local, square);
  local.at.z = glm::dot(q, glm::normalize(b.centre - a.centre));
  return distanceToCap(local, square);
}

float BoneForm::distance(vec3 p) const { return unionDistance(pieces, p, true); }
vec3 BoneForm::gradient(vec3 p) const { return slopeOf(*this, p); }
float BoneForm::cellSize(vec3 p, float reach) const { return unionCellSize(pieces, p, reach); }
Aabb BoneForm::bounds() const { return unionBounds(pieces); }

float BoneForm::finestCell() const {
  float finest = 1;
  for (const BonePiece& piece : pieces) finest = std::min(finest, piece.cell);
  return finest;
}

}  // namespace vasa::human
