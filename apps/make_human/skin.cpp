#include "make_human/skin.h"

#include <algorithm>
#include <cmath>

#include "make_human/path_weights.h"
#include "make_human/polygonise.h"

namespace vasa::human {
namespace {

constexpr float kSkinCell = 0.030f;
constexpr int kSmoothingRounds = 6;
constexpr float kBelow = 0.010f;  // [m] under the skin it is plainer whose flesh this is, as in an armpit

Weights weightsAt(const Shape& shape, const Rig& rig, vec3 p) {
  std::vector<float> distances;
  float nearest = 1;
  for (const Part& part : shape.parts) {
    distances.push_back(part.carve ? 1.0f : part.distance(p));
    nearest = std::min(nearest, distances.back());
  }
  Weights weights(rig.joints.size(), 0);
  float total = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const float range = std::max(0.35f * shape.parts[i].blend, 1e-3f);
    const float share = std::exp(-(distances[i] - nearest) / range);
    if (shape.parts[i].carve || share < 1e-3f) continue;
    addPathWeights(shape.parts[i].path, rig, alongPath(shape.parts[i].path, rig, p), share, weights);
    total += share;
  }
  for (float& weight : weights) weight /= total;
  return weights;
}

void smooth(std::vector<Weights>& weights, const TriangleMesh& mesh) {
  std::vector<Weights> next(weights.size(), Weights(weights[0].size(), 0));
  std::vector<float> counts(weights.size(), 0);
  for (const uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Weights& neighbour = weights[t[(i + 1) % 3]];
      Weights& sum = next[t[i]];
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += neighbour[k];
      ++counts[t[i]];
    }
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t k = 0; k < weights[i].size(); ++k)
      weights[i][k] = 0.5f * weights[i][k] + 0.5f * next[i][k] / counts[i];
}

}  // namespace

SkinnedMesh makeSkin(const Shape& shape, const Rig& rig) {
  SkinnedMesh skin;
  skin.name = "skin";
  skin.colour = {0.85f, 0.62f, 0.52f, 0.32f};
  skin.mesh = polygonise({[&](vec3 p) { return shape.distance(p); },
                          [&](vec3 p, float reach) { return shape.cellSize(p, reach); }, shape.bounds()},
                         kSkinCell);
  std::vector<Weights> weights;
  for (vec3 p : skin.mesh.positions) {
    skin.normals.push_back(glm::normalize(shape.gradient(p)));
    weights.push_back(weightsAt(shape, rig, p - kBelow * skin.normals.back()));
  }
  for (int round = 0; round < kSmoothingRounds; ++round) smooth(weights, skin.mesh);
  for (const Weights& w : weights) skin.influences.push_back(strongest(w));
  return skin;
}

}  // namespace vasa::human
