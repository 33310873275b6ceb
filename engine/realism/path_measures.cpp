#include "realism/path_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve/frame.h"

namespace vasa {
namespace {

constexpr std::size_t kBendStep = 5, kWindow = 10;  // stations, a millimetre apart

quat turnAt(const Network& network, const VesselPath::Station& station, std::span<const quat> rotations) {
  const Vessel& vessel = network.vessel(station.vessel);
  const auto [span, t] = locate(station.parameter, vessel.spanCount());
  const vec4 weights = deBoorWeights(span, vessel.spanCount(), t);
  const quat first = rotations[vessel.firstPoint + span];
  quat sum(0, 0, 0, 0);
  for (std::uint32_t l = 0; l < 4; ++l) {
    const quat own = rotations[vessel.firstPoint + span + l];
    sum = sum + own * (weights[int(l)] * (glm::dot(own, first) < 0 ? -1.0f : 1.0f));
  }
  return glm::normalize(sum);
}

std::vector<vec3> tangentsOf(std::span<const vec4> places) {
  std::vector<vec3> tangents;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const vec3 step = vec3(places[std::min(i + 1, places.size() - 1)] - places[i > 0 ? i - 1 : 0]);
    const float length = glm::length(step);
    tangents.push_back(length > 0 ? step / length : tangents.empty() ? vec3(0, 1, 0) : tangents.back());
  }
  return tangents;
}

std::vector<Frame> framesOf(std::span<const vec4> places, std::span<const vec3> tangents, vec3 start) {
  const std::vector<vec3> points(places.begin(), places.end());
  std::vector<Frame> frames(points.size());
  minimisingFrames(points, tangents, start, frames);
  return frames;
}

// Twist of the wall since rest up to each station [radians]: a mark that does not twist at rest is carried
// along by the surroundings and compared with one that does not twist in the pose.
std::vector<float> twistAlong(const Network& network, const VesselPath& path, std::span<const vec4> rest,
                              std::span<const vec4> posed, std::span<const quat> rotations) {
  const std::vector<vec3> before = tangentsOf(rest), now = tangentsOf(posed);
  const auto marks =
      framesOf(rest, before, std::abs(before.front().x) < 0.8f ? vec3(1, 0, 0) : vec3(0, 0, 1));
  const auto still =
      framesOf(posed, now, turnAt(network, path.stations.front(), rotations) * marks.front().u);
  std::vector<float> twist{0};
  for (std::size_t i = 1; i < posed.size(); ++i) {
    const vec3 wall = turnAt(network, path.stations[i], rotations) * marks[i].u;
    float angle = std::atan2(glm::dot(wall, still[i].v), glm::dot(wall, still[i].u));
    angle += 2 * kPi * std::round((twist.back() - angle) / (2 * kPi));
    twist.push_back(angle);
  }
  return twist;
}

std::vector<float> lengthsOf(std::span<const vec4> places) {
  std::vector<float> along{0};
  for (std::size_t i = 1; i < places.size(); ++i)
    along.push_back(along.back() + glm::distance(vec3(places[i - 1]), vec3(places[i])));
  return along;
}

}  // namespace

PathMeasures measurePath(const Network& network, const VesselPath& path, std::span<const vec4> points,
                         std::span<const quat> rotations) {
  const std::vector<vec4> rest = path.places(network, network.points()), posed = path.places(network, points);
  const std::vector<float> restAlong = lengthsOf(rest), along = lengthsOf(posed);
  const std::size_t last = posed.size() - 1;
  PathMeasures measures;
  measures.length = along.back();
  measures.strain = along.back() / restAlong.back() - 1;
  measures.chordByArc = glm::distance(vec3(posed.front()), vec3(posed.back())) / along.back();
  for (const vec4& place : posed) measures.meanRadius += place.w / float(posed.size());

  const std::size_t window = std::min(kWindow, last);
  measures.leastStrain = std::numeric_limits<float>::infinity();
  for (std::size_t i = window; i <= last; ++i)
    measures.leastStrain = std::min(
        measures.leastStrain, (along[i] - along[i - window]) / (restAlong[i] - restAlong[i - window]) - 1);

  const std::size_t step = std::clamp<std::size_t>(last / 2, 1, kBendStep);
  double turned = 0, over = 0, most = 0;
  for (std::size_t i = step; i + step <= last; ++i) {
    const vec3 in(posed[i] - posed[i - step]), out(posed[i + step] - posed[i]);
    const double angle = std::atan2(glm::length(glm::cross(in, out)), glm::dot(in, out));
    const double length = 0.5 * (double(along[i + step]) - along[i - step]), share = 1.0 / double(step);
    turned += angle * share, over += length * share;
    if (length > 0) most = std::max(most, angle / length);
  }
  measures.meanCurvature = over > 0 ? float(turned / over) : 0;
  measures.leastBendRadius = most > 0 ? float(1 / most) : std::numeric_limits<float>::infinity();

  if (rotations.empty()) return measures;
  const std::vector<float> twist = twistAlong(network, path, rest, posed, rotations);
  measures.twist = twist.back();
  for (std::size_t i = window; i <= last; ++i)
    measures.greatestTwist = std::max(measures.greatestTwist, std::abs(twist[i] - twist[i - window]) /
                                                                  (restAlong[i] - restAlong[i - window]));
  return measures;
}

}  // namespace vasa
