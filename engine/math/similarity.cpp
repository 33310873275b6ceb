#include "math/similarity.h"

#include <algorithm>
#include <array>
#include <cmath>

// Horn, "Closed-form solution of absolute orientation using unit quaternions": the turn is the eigenvector of
// the largest eigenvalue of a symmetric 4 x 4 matrix, found here by squaring it: only that one is left in the
// end.
namespace vasa {
namespace {

using Matrix = std::array<std::array<double, 4>, 4>;

constexpr int kSquarings = 40;
constexpr double kLine = 1e-6;  // of the spread: what lies in a line tells no turn about it

quat largestEigenvector(Matrix m) {
  // Shifted to be positive, so that the largest is the largest in size.
  double shift = 0;
  for (const auto& row : m)
    for (const double v : row) shift += std::abs(v);
  for (std::size_t i = 0; i < 4; ++i) m[i][i] += shift;
  for (int step = 0; step < kSquarings; ++step) {
    Matrix square{};
    double size = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t j = 0; j < 4; ++j) square[i][k] += m[i][j] * m[j][k];
        size = std::max(size, std::abs(square[i][k]));
      }
    for (auto& row : square)
      for (double& v : row) v /= size;
    m = square;
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (m[i][i] > m[best][best]) best = i;
  return glm::normalize(quat(float(m[0][best]), float(m[1][best]), float(m[2][best]), float(m[3][best])));
}

quat shortestTurn(dvec3 from, dvec3 to) {
  from = glm::normalize(from), to = glm::normalize(to);
  const double cosine = glm::dot(from, to);
  if (cosine < -0.999999) return glm::angleAxis(kPi, anyPerpendicular(vec3(from)));
  return glm::normalize(quat(float(1 + cosine), vec3(glm::cross(from, to))));
}

}  // namespace

Similarity fitSimilarity(std::span<const std::pair<vec3, vec3>> pairs, bool rigid) {
  Similarity fit;
  if (pairs.empty()) return fit;
  dvec3 from(0), to(0);
  for (const auto& [a, b] : pairs)
    from += dvec3(a) / double(pairs.size()), to += dvec3(b) / double(pairs.size());
  glm::dmat3 s(0);
  double spreadFrom = 0, spreadTo = 0;
  dvec3 along(0);  // the longest way in the first places, and what becomes of it
  dvec3 alongTo(0);
  for (const auto& [a, b] : pairs) {
    const dvec3 p = dvec3(a) - from, q = dvec3(b) - to;
    s += glm::outerProduct(p, q);
    spreadFrom += glm::dot(p, p), spreadTo += glm::dot(q, q);
    if (glm::dot(p, p) > glm::dot(along, along)) along = p, alongTo = q;
  }
  if (spreadFrom > 0 && spreadTo > 0) {
    double off = 0;
    for (const auto& pair : pairs) {
      const dvec3 p = dvec3(pair.first) - from,
                  aside = p - glm::dot(p, along) / glm::dot(along, along) * along;
      off += glm::dot(aside, aside);
    }
    if (!rigid) fit.scale = float(std::sqrt(spreadTo / spreadFrom));
    // glm is column by column: s[k][i] is the sum of p_i q_k.
    const auto S = [&](int i, int k) { return s[k][i]; };
    const Matrix n{{{S(0, 0) + S(1, 1) + S(2, 2), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0)},
                    {S(1, 2) - S(2, 1), S(0, 0) - S(1, 1) - S(2, 2), S(0, 1) + S(1, 0), S(2, 0) + S(0, 2)},
                    {S(2, 0) - S(0, 2), S(0, 1) + S(1, 0), -S(0, 0) + S(1, 1) - S(2, 2), S(1, 2) + S(2, 1)},
                    {S(0, 1) - S(1, 0), S(2, 0) + S(0, 2), S(1, 2) + S(2, 1), -S(0, 0) - S(1, 1) + S(2, 2)}}};
    fit.turn = off > kLine * spreadFrom ? largestEigenvector(n) : shortestTurn(along, alongTo);
  }
  fit.move = vec3(to) - fit.scale * (fit.turn * vec3(from));
  return fit;
}

}  // namespace vasa
