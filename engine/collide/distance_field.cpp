#include "collide/distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <thread>

#include "core/bytes.h"
#include "core/cancellation.h"
#include "core/isolated.h"
#include "math/closest_point.h"
#include "mesh/weld.h"
#include "mesh/winding_number.h"

namespace vasa {
namespace {

constexpr float kInsideFrom = 0.5f;    // winding number
constexpr float kStepMargin = 1.001f;  // of the way from corner to corner

}  // namespace

// The surface itself: made when the first brick is filled, for a field that was restored may never need it.
struct DistanceField::Exact {
  TriangleMesh mesh;
  mutable std::once_flag once;
  mutable std::unique_ptr<WindingNumber> winding;
};

const DistanceField::Exact& DistanceField::exact() const {
  std::call_once(exact_->once, [&] {
    isolated([&] {
      exact_->mesh = weld(exact_->mesh, 0);
      exact_->winding = std::make_unique<WindingNumber>(exact_->mesh.positions, exact_->mesh.triangles);
    });
  });
  return *exact_;
}

DistanceField::DistanceField(std::span<const vec3> positions, std::span<const uvec3> triangles,
                             Options options, Unfilled)
    : options_(options), exact_(std::make_unique<Exact>()) {
  exact_->mesh = {{positions.begin(), positions.end()}, {triangles.begin(), triangles.end()}};
  for (const uvec3& triangle : triangles)
    for (int k = 0; k < 3; ++k) box_.add(positions[triangle[k]], options_.band);
  if (box_.empty()) return;
  const float side = options_.cell * kBrick;
  origin_ = box_.low;
  counts_ = ivec3(glm::ceil(box_.extent() / side)) + 1;
  brickCount_ = std::size_t(counts_.x) * std::size_t(counts_.y) * std::size_t(counts_.z);
  bricks_ = std::make_unique_for_overwrite<std::atomic<std::uint32_t>[]>(brickCount_);
  for (std::size_t k = 0; k < brickCount_; ++k) bricks_[k].store(kUndecided, std::memory_order_relaxed);
}

DistanceField::DistanceField(std::span<const vec3> positions, std::span<const uvec3> triangles,
                             Options options)
    : DistanceField(positions, triangles, options, Unfilled{}) {
  if (box_.empty()) return;
  markBand();
  makeRoom();
  sortOutInside();
  measureRings();
}
DistanceField::~DistanceField() = default;
DistanceField::DistanceField(DistanceField&&) noexcept = default;

std::uint32_t DistanceField::filledBricks() const {
  return filled_ ? filled_->load(std::memory_order_relaxed) : 0;
}

// Filled bricks count in their own order here, not in the one in which threads came upon them.
void DistanceField::save(ByteWriter& out) const {
  std::vector<std::uint32_t> bricks(brickCount_);
  std::vector<float> values;
  std::uint32_t filled = 0;
  for (std::size_t k = 0; k < brickCount_; ++k) {
    bricks[k] = bricks_[k].load(std::memory_order_acquire);
    if (bricks[k] >= kUndecided) continue;
    const float* own = values_.get() + std::size_t(bricks[k]) * kValues;
    values.insert(values.end(), own, own + kValues);
    bricks[k] = filled++;
  }
  out.addAll(std::span(std::as_const(bricks)));
  out.addAll(std::span(std::as_const(values)));
}

std::optional<DistanceField> DistanceField::restored(std::span<const vec3> positions,
                                                     std::span<const uvec3> triangles, Options options,
                                                     ByteReader& in) {
  DistanceField field(positions, triangles, options, Unfilled{});
  std::vector<std::uint32_t> bricks;
  std::vector<float> values;
  if (!in.takeAll(bricks) || !in.takeAll(values) || bricks.size() != field.brickCount_ ||
      values.size() % kValues != 0)
    return {};
  if (bricks.empty()) return field;
  const std::uint32_t filled = std::uint32_t(values.size() / kValues);
  for (std::size_t k = 0; k < bricks.size(); ++k) {
    if (bricks[k] < kUndecided && bricks[k] >= filled) return {};
    field.bricks_[k].store(bricks[k], std::memory_order_relaxed);
  }
  field.makeRoom();
  std::ranges::copy(values, field.values_.get());
  *field.filled_ = filled;
  return field;
}

// Bricks that come within the band of a triangle's box have values, once they are looked at.
void DistanceField::markBand() {
  const auto& [positions, triangles] = exact().mesh;
  const float side = options_.cell * kBrick;
  Checkpoints checkpoints;
  for (const uvec3& triangle : triangles) {
    checkpoints.pass();
    Aabb box;
    for (int k = 0; k < 3; ++k) box.add(positions[triangle[k]], options_.band);
    const ivec3 low = ivec3((box.low - origin_) / side),
                high = glm::min(ivec3((box.high - origin_) / side), counts_ - 1);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) set({x, y, z}, kEmpty);
  }
}

// For the values of all bricks that have some, or may get them.
void DistanceField::makeRoom() {
  std::size_t count = 0;
  for (std::size_t k = 0; k < brickCount_; ++k) {
    const std::uint32_t brick = bricks_[k].load(std::memory_order_relaxed);
    count += brick < kUndecided || brick == kEmpty;
  }
  values_ = std::make_unique_for_overwrite<float[]>(count * kValues);
  filled_ = std::make_unique<std::atomic<std::uint32_t>>(0);
}

std::uint32_t DistanceField::fill(ivec3 at) const {
  std::atomic<std::uint32_t>& own = bricks_[indexOf(at)];
  std::uint32_t place = kEmpty;
  if (!own.compare_exchange_strong(place, kBeingFilled, std::memory_order_acquire)) {
    while ((place = own.load(std::memory_order_acquire)) == kBeingFilled) std::this_thread::yield();
    return place;
  }
  place = filled_->fetch_add(1, std::memory_order_relaxed);
  std::array<vec3, kValues> corners;
  const vec3 low = origin_ + options_.cell * kBrick * vec3(at);
  for (int k = 0; k < kValues; ++k)
    corners[std::size_t(k)] = low + options_.cell * vec3(float(k % kCorners), float(k / kCorners % kCorners),
                                                         float(k / (kCorners * kCorners)));
  const std::span<float, kValues> values(values_.get() + std::size_t(place) * kValues, kValues);
  measure(corners, values);
  giveSigns(corners, values);
  own.store(place, std::memory_order_release);
  return place;
}

// From the surface, on either side of it; the band beyond that.
void DistanceField::measure(std::span<const vec3, kValues> corners,
                            std::span<float, kValues> distances) const {
  thread_local std::vector<Triangle> near;
  // Balls around the triangles, as arrays of plain numbers: most of them are told too far in vector
  // registers.
  thread_local std::vector<float> x, y, z, radius, squared;
  const vec3 middle = 0.5f * (corners.front() + corners.back());
  near.clear();
  exact().winding->addNear(middle, glm::distance(middle, corners.front()) + options_.band, near);
  const std::size_t count = near.size();
  for (auto* each : {&x, &y, &z, &radius, &squared}) each->resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [a, b, c] = near[k];
    const vec3 centre = (a + b + c) / 3.0f;
    x[k] = centre.x, y[k] = centre.y, z[k] = centre.z;
    radius[k] = std::max({glm::distance(a, centre), glm::distance(b, centre), glm::distance(c, centre)});
  }
  for (std::size_t p = 0; p < corners.size(); ++p) {
    const vec3 point = corners[p];
    float least = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < count; ++k) {
      const float dx = x[k] - point.x, dy = y[k] - point.y, dz = z[k] - point.z;
      squared[k] = dx * dx + dy * dy + dz * dz;
      least = squared[k] < least ? squared[k] : least;
    }
    const float most = std::sqrt(least) * 1.0001f;  // the nearest triangle is no further than this
    float distance = options_.band;
    for (std::size_t k = 0; k < count; ++k) {
      if (squared[k] > (most + radius[k]) * (most + radius[k])) continue;
      const auto& [a, b, c] = near[k];
      distance = std::min(distance, glm::distance(point, closestOnTriangle(point, a, b, c).point));
    }
    distances[p] = distance;
  }
}

// No surface passes between two corners of a brick if one is farther from it than the other corner is from
// that: they are on one side, which one winding number tells for all that hang together so.
void DistanceField::giveSigns(std::span<const vec3, kValues> corners,
                              std::span<float, kValues> distances) const {
  constexpr int kStrides[] = {1, kCorners, kCorners * kCorners};
  std::array<std::uint8_t, kValues> together;
  std::array<bool, kValues> known{};
  for (int first = 0; first < kValues; ++first) {
    if (known[std::size_t(first)]) continue;
    std::size_t count = 0;
    const auto take = [&](int at) { known[std::size_t(at)] = true, together[count++] = std::uint8_t(at); };
    take(first);
    for (std::size_t k = 0; k < count; ++k) {
      const int from = together[k];
      const ivec3 corner(from % kCorners, from / kCorners % kCorners, from / (kCorners * kCorners));
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          if (corner[axis] + step < 0 || corner[axis] + step >= kCorners) continue;
          const int to = from + step * kStrides[axis];
          if (!known[std::size_t(to)] && std::max(distances[std::size_t(from)], distances[std::size_t(to)]) >
                                             kStepMargin * options_.cell)
            take(to);
        }
    }
    const auto own = std::span(together).first(count);
    const int farthest =
        *std::ranges::max_element(own, {}, [&](int at) { return distances[std::size_t(at)]; });
    if (exact().winding->at(corners[std::size_t(farthest)]) > kInsideFrom)
      for (const int at : own) distances[std::size_t(at)] = -distances[std::size_t(at)];
  }
}

// Bricks beyond the band hang together in regions, each all outside or all inside, as one winding number
// tells.
void DistanceField::sortOutInside() {
  const float side = options_.cell * kBrick;
  std::vector<ivec3> region;
  for (int z = 0; z < counts_.z; ++z, checkpoint())
    for (int y = 0; y < counts_.y; ++y)
      for (int x = 0; x < counts_.x; ++x) {
        if (brick({x, y, z}) != kUndecided) continue;
        const vec3 middle = origin_ + side * (vec3(x, y, z) + 0.5f);
        const std::uint32_t found = exact().winding->at(middle) > kInsideFrom ? kInside : kOutside;
        set({x, y, z}, found);
        region.assign(1, {x, y, z});
        for (std::size_t k = 0; k < region.size(); ++k)
          for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
              ivec3 next = region[k];
              next[axis] += step;
              if (next[axis] < 0 || next[axis] >= counts_[axis] || brick(next) != kUndecided) continue;
              set(next, found);
              region.push_back(next);
            }
      }
}

// Chessboard distance of bricks, a pass an axis.
void DistanceField::measureRings() {
  constexpr std::uint8_t kFarthest = 255;
  std::vector<std::uint8_t> rings(brickCount_);
  for (std::size_t k = 0; k < brickCount_; ++k)
    rings[k] = bricks_[k].load(std::memory_order_relaxed) == kOutside ? kFarthest : 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int first = (axis + 1) % 3, second = (axis + 2) % 3, count = counts_[axis];
    std::vector<std::uint8_t> line(static_cast<std::size_t>(count));
    ivec3 at;
    for (at[first] = 0; at[first] < counts_[first]; ++at[first])
      for (at[second] = 0; at[second] < counts_[second]; ++at[second]) {
        for (int k = 0; k < count; ++k) at[axis] = k, line[std::size_t(k)] = rings[indexOf(at)];
        for (int k = 0; k < count; ++k) {
          int least = kFarthest;
          for (int other = 0; other < count; ++other)
            least = std::min(least, std::max(int(line[std::size_t(other)]), std::abs(other - k)));
          at[axis] = k, rings[indexOf(at)] = std::uint8_t(least);
        }
      }
  }
  for (std::size_t k = 0; k < brickCount_; ++k)
    if (rings[k] > 0) bricks_[k].store(kOutside + rings[k], std::memory_order_relaxed);
}

float DistanceField::clearance(vec3 point) const {
  if (box_.empty()) return std::numeric_limits<float>::infinity();
  const vec3 in = glm::clamp(point, box_.low, box_.high);
  return in != point ? options_.band + glm::distance(in, point) : std::max(distance(point), 0.0f);
}

DistanceField::Cell DistanceField::cellAt(vec3 point) const {
  if (glm::any(glm::lessThan(point, box_.low)) || glm::any(glm::greaterThan(point, box_.high)))
    return {nullptr, options_.band, {}, {}};
  const vec3 cells = (point - origin_) / options_.cell;
  const ivec3 cell = glm::clamp(ivec3(cells), ivec3(0), counts_ * kBrick - 1);
  std::uint32_t place = brick(cell / kBrick);
  if (place >= kOutside)
    return {nullptr, options_.band + float(place - kOutside - 1) * options_.cell * kBrick, {}, {}};
  if (place == kInside) return {nullptr, -options_.band, {}, {}};
  if (place >= kBeingFilled) place = fill(cell / kBrick);
  return {values_.get() + std::size_t(place) * kValues, 0, cell % kBrick, cells - vec3(cell)};
}

float DistanceField::distanceIn(const Cell& cell) {
  if (!cell.values) return cell.beyond;
  const float* v = cell.values + (cell.corner.z * kCorners + cell.corner.y) * kCorners + cell.corner.x;
  const auto alongX = [&](int at) { return glm::mix(v[at], v[at + 1], cell.share.x); };
  const auto alongY = [&](int at) { return glm::mix(alongX(at), alongX(at + kCorners), cell.share.y); };
  return glm::mix(alongY(0), alongY(kCorners * kCorners), cell.share.z);
}

float DistanceField::distance(vec3 point) const { return distanceIn(cellAt(point)); }

// Step by step for all, so that they wait for memory together.
void DistanceField::distances(std::span<const vec4> balls, std::span<float> out) const {
  constexpr std::size_t kAtOnce = 8;
  std::array<Cell, kAtOnce> cells;
  for (std::size_t first = 0; first < balls.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, balls.size() - first);
    for (std::size_t k = 0; k < count; ++k) cells[k] = cellAt(vec3(balls[first + k]));
    for (std::size_t k = 0; k < count; ++k) out[first + k] = distanceIn(cells[k]);
  }
}

DistanceField::Sample DistanceField::at(vec3 point) const {
  const Cell cell = cellAt(point);
  if (!cell.values) return {cell.beyond, vec3(0)};
  const float* v = cell.values + (cell.corner.z * kCorners + cell.corner.y) * kCorners + cell.corner.x;
  constexpr int kY = kCorners, kZ = kCorners * kCorners;
  const vec3 f = cell.share;
  const float x00 = glm::mix(v[0], v[1], f.x), x10 = glm::mix(v[kY], v[kY + 1], f.x);
  const float x01 = glm::mix(v[kZ], v[kZ + 1], f.x), x11 = glm::mix(v[kZ + kY], v[kZ + kY + 1], f.x);
  const float y0 = glm::mix(x00, x10, f.y), y1 = glm::mix(x01, x11, f.y);
  const float dx = glm::mix(glm::mix(v[1] - v[0], v[kY + 1] - v[kY], f.y),
                            glm::mix(v[kZ + 1] - v[kZ], v[kZ + kY + 1] - v[kZ + kY], f.y), f.z);
  return {glm::mix(y0, y1, f.z), vec3(dx, glm::mix(x10 - x00, x11 - x01, f.z), y1 - y0) / options_.cell};
}

std::size_t DistanceField::bytes() const {
  return filledBricks() * std::size_t(kValues) * sizeof(float) + brickCount_ * sizeof(std::uint32_t);
}

}  // namespace vasa
