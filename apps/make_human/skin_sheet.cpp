#include "make_human/skin_sheet.h"

#include <algorithm>
#include <cassert>
#include <cmath>

// The turn that takes a vertex's edges at rest nearest to those it has: Müller et al. 2016, "A robust method
// to extract the rotational part of deformations". It starts from the last step's, so that few rounds do.
namespace vasa::human {
namespace {

constexpr int kTurnRounds = 2;
constexpr float kSheetRelaxation = 0.7f;  // of the way to where the neighbours want a vertex

quat turnTowards(quat turn, const mat3& covariance) {
  for (int round = 0; round < kTurnRounds; ++round) {
    const mat3 r = glm::mat3_cast(turn);
    const vec3 torque =
        glm::cross(r[0], covariance[0]) + glm::cross(r[1], covariance[1]) + glm::cross(r[2], covariance[2]);
    const float norm = std::abs(glm::dot(r[0], covariance[0]) + glm::dot(r[1], covariance[1]) +
                                glm::dot(r[2], covariance[2]));
    const vec3 axis = torque / (norm + 1e-12f);
    const float angle = glm::length(axis);
    if (angle < 1e-6f) break;
    turn = glm::normalize(glm::angleAxis(std::min(angle, 1.0f), axis / angle) * turn);
  }
  return turn;
}

}  // namespace

SkinSheet::SkinSheet(const TriangleMesh& rest) : rest_(rest), first_(rest.positions.size() + 1, 0) {
  // In a closed mesh each directed edge occurs once.
  for (const uvec3& t : rest.triangles)
    for (int k = 0; k < 3; ++k) ++first_[t[k] + 1];
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
  neighbours_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const uvec3& t : rest.triangles)
    for (int k = 0; k < 3; ++k) neighbours_[next[t[k]]++] = t[(k + 1) % 3];
  edges_.resize(neighbours_.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < rest.positions.size(); ++i)
    for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k)
      edges_[k] = i < neighbours_[k] ? count++ : edges_[find(neighbours_[k], i)];
}

std::size_t SkinSheet::find(std::uint32_t vertex, std::uint32_t neighbour) const {
  const std::span<const std::uint32_t> all = neighbours(vertex);
  const auto found = std::find(all.begin(), all.end(), neighbour);
  assert(found != all.end());
  return first_[vertex] + std::size_t(found - all.begin());
}

void SkinSheet::relax(std::span<vec3> positions, std::span<quat> turns, std::span<const Floor> floors,
                      int steps) const {
  std::vector<vec3> wanted(positions.size());
  // Each edge at rest, seen from its end of the higher number, as its ends turn it. Seen from the other it is
  // the same but for the sign, to the last bit.
  std::vector<vec3> turned(edges_.size() / 2);
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      mat3 covariance(0);  // of edges at rest, by columns of these
      for (std::uint32_t j : neighbours(i)) {
        const vec3 rest = rest_.positions[j] - rest_.positions[i], now = positions[j] - positions[i];
        covariance += glm::outerProduct(now, rest);
      }
      turns[i] = turnTowards(turns[i], covariance);
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      vec3 sum(0);
      for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k) {
        const std::uint32_t j = neighbours_[k];
        vec3& edge = turned[edges_[k]];
        if (i < j) {
          const vec3 rest = rest_.positions[i] - rest_.positions[j];
          edge = 0.5f * (turns[i] * rest + turns[j] * rest);
        }
        sum += i < j ? positions[j] + edge : positions[j] - edge;
      }
      wanted[i] = sum / float(neighbours(i).size());
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i] += kSheetRelaxation * (wanted[i] - positions[i]);
      if (!floors[i].bounds()) continue;
      const float short_ = floors[i].offset - glm::dot(positions[i], floors[i].normal);
      if (short_ > 0) positions[i] += short_ * floors[i].normal;
    }
  }
}

}  // namespace vasa::human
