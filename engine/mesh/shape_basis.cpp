#include "mesh/shape_basis.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace vasa {
namespace {

using Frames = std::vector<std::vector<vec3>>;

// Inner products of all pairs of frames.
Eigen::MatrixXd gramOf(const Frames& frames) {
  const auto count = Eigen::Index(frames.size());
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
  parallelFor(frames.size(), 1, [&](std::size_t i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0;
      // Squares of metres must not hide squares of microns.
      for (std::size_t v = 0; v < frames[i].size(); ++v)
        sum += glm::dot(dvec3(frames[i][v]), dvec3(frames[j][v]));
      gram(Eigen::Index(i), Eigen::Index(j)) = sum;
    }
  });
  return gram.selfadjointView<Eigen::Lower>();
}

float farthest(const Frames& residuals) {
  std::vector<float> most(residuals.size(), 0);
  parallelFor(residuals.size(), 1, [&](std::size_t f) {
    for (const vec3& r : residuals[f]) most[f] = std::max(most[f], glm::dot(r, r));
  });
  return std::sqrt(*std::ranges::max_element(most));
}

// Moves all weights into [0, 1]: V + w S = (V + low S) + (w - low) / (high - low) · (high - low) S.
void makePositive(ShapeBasis& basis) {
  std::vector<vec3> offset;
  for (std::size_t k = 0; k < basis.shapes.size(); ++k) {
    float low = 0, high = 0;
    for (const auto& row : basis.weights) low = std::min(low, row[k]), high = std::max(high, row[k]);
    if (low < 0 && offset.empty()) offset.assign(basis.shapes[k].size(), vec3(0));
    if (low < 0)
      for (std::size_t v = 0; v < offset.size(); ++v) offset[v] += low * basis.shapes[k][v];
    for (vec3& p : basis.shapes[k]) p *= high - low;
    for (auto& row : basis.weights) row[k] = std::clamp((row[k] - low) / (high - low), 0.0f, 1.0f);
  }
  if (offset.empty()) return;
  basis.shapes.push_back(std::move(offset));
  for (auto& row : basis.weights) row.push_back(1);
}

}  // namespace

ShapeBasis shapeBasis(Frames& frames, float tolerance) {
  ShapeBasis basis;
  basis.weights.resize(frames.size());
  const std::vector<vec3> first = frames[0];
  parallelFor(frames.size(), 1, [&](std::size_t f) {
    for (std::size_t v = 0; v < first.size(); ++v) frames[f][v] -= first[v];
  });
  basis.error = farthest(frames);
  if (basis.error <= tolerance) return basis;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gramOf(frames));
  for (Eigen::Index k = solver.eigenvalues().size(); k-- > 0 && basis.error > tolerance;) {
    Eigen::VectorXd direction = solver.eigenvectors().col(k);
    const double largest = direction.cwiseAbs().maxCoeff();
    if (!(solver.eigenvalues()[k] > 0) || !(largest > 0)) break;
    // The shape at weight 1 of the frame that has most of it, and what is left of every frame without it.
    std::vector<vec3> shape(first.size(), vec3(0));
    parallelFor(first.size(), 4096, [&](std::size_t v) {
      dvec3 sum(0);
      for (std::size_t f = 0; f < frames.size(); ++f) sum += direction[Eigen::Index(f)] * dvec3(frames[f][v]);
      shape[v] = vec3(sum * largest);
    });
    direction /= largest;
    direction[0] = 0;  // the first frame is the mesh itself, whatever rounding says
    for (std::size_t f = 0; f < frames.size(); ++f)
      basis.weights[f].push_back(float(direction[Eigen::Index(f)]));
    parallelFor(frames.size(), 1, [&](std::size_t f) {
      const float weight = basis.weights[f].back();
      for (std::size_t v = 0; v < first.size(); ++v) frames[f][v] -= weight * shape[v];
    });
    basis.shapes.push_back(std::move(shape));
    basis.error = farthest(frames);
  }
  makePositive(basis);
  return basis;
}

Frames shapesForWeights(std::span<const std::vector<vec3>> frames,
                        std::span<const std::vector<float>> weights) {
  const std::size_t shapes = weights[0].size();
  Frames result(shapes, std::vector<vec3>(frames[0].size(), vec3(0)));
  if (shapes == 0) return result;
  Eigen::MatrixXd matrix{Eigen::Index(frames.size()), Eigen::Index(shapes)};
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (std::size_t k = 0; k < shapes; ++k) matrix(Eigen::Index(f), Eigen::Index(k)) = double(weights[f][k]);
  // Shapes x frames.
  const Eigen::MatrixXd inverse = matrix.completeOrthogonalDecomposition().pseudoInverse();
  parallelFor(frames[0].size(), 4096, [&](std::size_t v) {
    for (std::size_t k = 0; k < shapes; ++k) {
      dvec3 sum(0);
      for (std::size_t f = 1; f < frames.size(); ++f)
        sum += inverse(Eigen::Index(k), Eigen::Index(f)) * dvec3(frames[f][v] - frames[0][v]);
      result[k][v] = vec3(sum);
    }
  });
  return result;
}

}  // namespace vasa
