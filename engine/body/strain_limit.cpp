#include "body/strain_limit.h"

#include <algorithm>
#include <vector>

#include "body/point_tree.h"
#include "body/strain.h"
#include "core/cancellation.h"

namespace vasa {
namespace {

constexpr float kAround = 0.03f;     // of the body's height
constexpr int kMostRounds = 200;     // of all steps
constexpr float kHostShare = 0.25f;  // of a move of an end on a host's side, beside a free point's
constexpr float kWithin = 1.01f;     // of the limit: where steps are held to
constexpr float kShortest = 1e-5f;   // [m] of a step that tells anything

struct Piece {
  std::uint32_t vessel, first, last;  // points of the network, both included
  float before = 0;                   // [m]
  vec3 middle{0};                     // before
  float around = 1;                   // by what the vessels around it changed their length
};

float lengthOf(std::span<const vec4> points, std::uint32_t first, std::uint32_t last) {
  float sum = 0;
  for (std::uint32_t i = first; i < last; ++i) sum += glm::distance(vec3(points[i]), vec3(points[i + 1]));
  return sum;
}

// Control polygons stand for their curves.
std::vector<Piece> piecesOf(const Network& network, std::span<const vec4> before) {
  std::vector<Piece> pieces;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const std::uint32_t end = vessel.firstPoint + vessel.pointCount - 1;
    for (std::uint32_t first = vessel.firstPoint; first < end;) {
      std::uint32_t last = first;
      float length = 0;
      while (last < end && length < kStrainPiece)
        length += glm::distance(vec3(before[last]), vec3(before[last + 1])), ++last;
      // What is left over belongs to the last piece.
      if (lengthOf(before, last, end) < 0.5f * kStrainPiece)
        last = end, length = lengthOf(before, first, end);
      if (length > kShortest) pieces.push_back({v, first, last, length, vec3(before[(first + last) / 2]), 1});
      first = last;
    }
  }
  return pieces;
}

// The median of the changes around each piece, each piece counted by its length.
void lookAround(const Network& network, std::span<const vec4> points, std::vector<Piece>& pieces) {
  PointCloud cloud;
  std::vector<float> ratio;
  for (const Piece& piece : pieces) {
    cloud.points.push_back(piece.middle);
    ratio.push_back(lengthOf(points, piece.first, piece.last) / piece.before);
  }
  const PointTree tree(3, cloud);
  const float reach = kAround * network.bodyHeight();
  std::vector<std::pair<std::uint32_t, float>> found, near;  // near: ratio, length
  for (Piece& piece : pieces) {
    checkpoint();
    tree.radiusSearch(&piece.middle.x, reach * reach, found, nanoflann::SearchParams(32, 0, true));
    std::ranges::sort(found, {}, [&](const auto& one) { return std::pair(ratio[one.first], one.first); });
    float whole = 0, sum = 0;
    for (const auto& one : found) whole += pieces[one.first].before;
    for (const auto& one : found) {
      sum += pieces[one.first].before;
      piece.around = ratio[one.first];
      if (sum >= 0.5f * whole) break;
    }
    piece.around = std::max(piece.around, 1e-3f);
  }
}

// How far from the limit a piece is: above 1 beyond it.
float excessOf(const Piece& piece, std::span<const vec4> points) {
  const float change = std::max(lengthOf(points, piece.first, piece.last), 1e-6f) / piece.before;
  return std::max(change / piece.around, piece.around / change) / kMostUnevenStrain;
}

class Limiter {
 public:
  Limiter(const Network& network, std::span<const vec4> before, std::span<vec4> points)
      : network_(network), before_(before), points_(points), endOf_(points.size()) {
    for (std::uint32_t n = 0; n < network.nodes().size(); ++n)
      for (const VesselEnd& end : network.ends(network.nodes()[n])) endOf_[network_.pointOf(end)] = n + 1;
  }

  void hold(const Piece& piece) {
    const float limit = kMostUnevenStrain / kWithin;
    for (std::uint32_t i = piece.first; i < piece.last; ++i) {
      const float was = glm::distance(vec3(before_[i]), vec3(before_[i + 1]));
      const vec3 way = vec3(points_[i + 1]) - vec3(points_[i]);
      const float is = glm::length(way);
      if (was < kShortest || !(is > 0)) continue;
      const float wanted = std::clamp(is, was * piece.around / limit, was * piece.around * limit);
      if (wanted == is) continue;
      const float a = easeOf(i), b = easeOf(i + 1);
      const vec3 change = (is - wanted) / (is * (a + b)) * way;
      move(i, a * change), move(i + 1, -b * change);
    }
  }

 private:
  const Node* nodeAt(std::uint32_t point) const {
    return endOf_[point] ? &network_.nodes()[endOf_[point] - 1] : nullptr;
  }
  float easeOf(std::uint32_t point) const {
    const Node* node = nodeAt(point);
    return node && node->host ? kHostShare : 1;
  }
  // Ends with all that meets them; of a host the points around, so that its side moves by as much.
  void move(std::uint32_t point, vec3 by) {
    const Node* node = nodeAt(point);
    if (!node) {
      points_[point] += vec4(by, 0);
      return;
    }
    for (const VesselEnd& end : network_.ends(*node)) points_[network_.pointOf(end)] += vec4(by, 0);
    if (!node->host) return;
    const Vessel& host = network_.vessel(node->host->vessel);
    const SpanParameter at = locate(node->host->parameter, host.spanCount());
    const vec4 weights = deBoorWeights(at.span, host.spanCount(), at.t);
    const float share = 1 / glm::dot(weights, weights);
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t own = host.firstPoint + at.span + std::uint32_t(k);
      if (!endOf_[own]) points_[own] += vec4(share * weights[k] * by, 0);
    }
  }

  const Network& network_;
  std::span<const vec4> before_;
  std::span<vec4> points_;
  std::vector<std::uint32_t> endOf_;  // of each point, its node's number and 1; 0: none
};

}  // namespace

StrainLimitReport limitStrain(const Network& network, std::span<const vec4> before, std::span<vec4> points) {
  std::vector<Piece> pieces = piecesOf(network, before);
  lookAround(network, points, pieces);
  StrainLimitReport report;
  std::uint32_t beyond = 0;
  for (const Piece& piece : pieces) beyond += excessOf(piece, points) > 1;
  Limiter limiter(network, before, points);
  std::uint32_t left = beyond;
  for (int round = 0; round < kMostRounds && left > 0; ++round) {
    checkpoint();
    for (const Piece& piece : pieces)
      if (excessOf(piece, points) > 1) limiter.hold(piece);
    pinEnds(network, points);
    left = 0;
    for (const Piece& piece : pieces) left += excessOf(piece, points) > 1;
  }
  for (const Piece& piece : pieces)
    if (const float excess = excessOf(piece, points); excess > 1)
      report.worst = std::max(report.worst, kMostUnevenStrain * excess);
  report.beyond = left;
  report.held = beyond > left ? beyond - left : 0;
  return report;
}

}  // namespace vasa
