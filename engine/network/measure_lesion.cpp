#include "network/measure_lesion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve/arc_length.h"

namespace vasa {
namespace {

constexpr float kStationsOfRadius = 0.25f;  // of a vessel's least radius, apart: a lesion is longer than that
constexpr float kFinestStation = 1e-4f, kFewestStations = 200;

constexpr float kParallel = 1;  // radii of way without a change, after which a wall counts as healthy

// The shoulder of a lesion at `from`, seen in one direction; sign 1: where the radius is largest, -1: least.
// `most` is the largest of all: farther off than that makes up for there is nothing to look for.
std::size_t shoulder(std::span<const ProfileStation> stations, std::size_t from, int direction, float sign,
                     float most) {
  std::size_t best = from;
  float bestValue = sign * stations[from].radius;
  for (std::size_t i = from; direction > 0 ? i + 1 < stations.size() : i > 0;) {
    i = direction > 0 ? i + 1 : i - 1;
    const float cost = kTaper * std::abs(stations[i].along - stations[from].along);
    if (most - cost < bestValue) break;
    const float value = sign * stations[i].radius - cost;
    if (value > bestValue) bestValue = value, best = i;
    if (best != from &&
        std::abs(stations[i].along - stations[best].along) > kParallel * stations[best].radius)
      break;
  }
  return best;
}

// The lesion around an extreme station.
template <class Kind>
std::optional<Kind> lesionAt(std::span<const ProfileStation> stations, std::size_t at, float sign,
                             float most) {
  const std::size_t before = shoulder(stations, at, -1, sign, most),
                    after = shoulder(stations, at, 1, sign, most);
  if (after == at || before == at) return std::nullopt;
  Kind lesion;
  lesion.along = stations[at].along, lesion.radius = stations[at].radius;
  lesion.proximal = stations[before].along, lesion.distal = stations[after].along;
  const float way = lesion.distal - lesion.proximal;
  lesion.proximalRadius = stations[before].radius, lesion.distalRadius = stations[after].radius;
  // Beside an aneurysm one shoulder is the aneurysm: vessels do not widen downstream, nor thin faster than
  // kTaper.
  if (sign > 0) {
    lesion.distalRadius = std::min(lesion.distalRadius, lesion.proximalRadius);
    lesion.proximalRadius = std::min(lesion.proximalRadius, lesion.distalRadius + kTaper * way);
  }
  lesion.reference = std::lerp(lesion.proximalRadius, lesion.distalRadius,
                               way > 0 ? (lesion.along - lesion.proximal) / way : 0);
  return lesion;
}

template <class Kind>
std::optional<Kind> worst(std::span<const ProfileStation> stations, float sign) {
  std::optional<Kind> found;
  float most = -std::numeric_limits<float>::infinity();
  for (const ProfileStation& station : stations) most = std::max(most, sign * station.radius);
  const auto severity = [&](const Lesion& lesion) { return sign * (1 - lesion.radius / lesion.reference); };
  for (std::size_t i = 1; i + 1 < stations.size(); ++i) {
    const float here = sign * stations[i].radius;
    if (sign * stations[i - 1].radius < here || sign * stations[i + 1].radius < here) continue;
    const auto lesion = lesionAt<Kind>(stations, i, sign, most);
    if (lesion && severity(*lesion) > 0 && (!found || severity(*lesion) > severity(*found))) found = lesion;
  }
  return found;
}

}  // namespace

float lesionStep(std::span<const vec4> points) {
  const float thinnest = std::ranges::min(points, {}, &vec4::w).w;
  const float finest = std::min(kStationsOfRadius * thinnest, ArcLength(points).length() / kFewestStations);
  return std::max(finest, kFinestStation);
}

std::optional<Stenosis> worstStenosis(std::span<const ProfileStation> stations) {
  return worst<Stenosis>(stations, 1);
}

std::optional<Aneurysm> widestAneurysm(std::span<const ProfileStation> stations) {
  return worst<Aneurysm>(stations, -1);
}

}  // namespace vasa
