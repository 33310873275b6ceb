#pragma once
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa {

/// The frames of a moving mesh as few shapes with weights: frame f is first + Σ weights[f][k] · shapes[k].
/// Weights lie within [0, 1], which is all that some programs (Blender) take: where a direction is needed
/// both ways, one more shape with weight 1 in all frames takes the mesh to the end of it.
struct ShapeBasis {
  std::vector<std::vector<vec3>> shapes;    ///< displacements, one a vertex
  std::vector<std::vector<float>> weights;  ///< a row a frame
  /// [m] the farthest a vertex of any frame is from where it should be
  float error = 0;
};

/// The fewest shapes of a least-squares basis that bring every vertex of every frame within the tolerance.
/// Method: principal directions of the frames' displacements from the first (eigenvectors of their Gram
/// matrix), the strongest first, until no vertex is off by more; with as many as there are frames but one it
/// is exact.
/// @param frames     positions [m], at least one frame, all of one size; used up: the residuals are left in
/// it
/// @param tolerance  [m]
/// O(frames · vertices · (frames + shapes)), in parallel; the same for any number of threads.
ShapeBasis shapeBasis(std::vector<std::vector<vec3>>& frames, float tolerance);

/// For another quantity of the same frames (normals), the shapes that fit best to weights that are given, in
/// the sense of least squares.
std::vector<std::vector<vec3>> shapesForWeights(std::span<const std::vector<vec3>> frames,
                                                std::span<const std::vector<float>> weights);

}  // namespace vasa
