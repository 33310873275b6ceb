#include "body/skin_warp.h"

#include <algorithm>

#include "core/parallel.h"

namespace vasa {
namespace {

constexpr int kWarpRounds = 4;
constexpr int kSmoothing = 24;       // rounds of averaging over edges
constexpr float kFacingSkin = 0.2f;  // least cosine between two skins' normals that belong together
constexpr float kFarthest = 0.12f;   // of the body's height, that a wish may ask for
constexpr std::size_t kWarpSamples = 3000;
constexpr float kWarpBlur = 0.012f;  // of the body's height

struct Wishes {
  std::vector<vec3> move;
  std::vector<float> weight;  // 0: none of its own
};

Wishes askAll(const TriangleMesh& skin, const std::vector<vec3>& normals, const SkinShell& target,
              float farthest) {
  Wishes wishes{std::vector<vec3>(skin.positions.size(), vec3(0)),
                std::vector<float>(skin.positions.size(), 0)};
  parallelFor(skin.positions.size(), 64, [&](std::size_t v) {
    if (const auto there = target.facing(skin.positions[v], normals[v], kFacingSkin, farthest))
      wishes.move[v] = *there - skin.positions[v], wishes.weight[v] = 1;
  });
  return wishes;
}

// Averages over edges; a vertex without a wish takes its neighbours'.
void smooth(const TriangleMesh& skin, Wishes& wishes) {
  for (int round = 0; round < kSmoothing; ++round) {
    std::vector<vec3> sum(wishes.move.size(), vec3(0));
    std::vector<float> weight(wishes.move.size(), 0);
    for (const uvec3& t : skin.triangles)
      for (int k = 0; k < 3; ++k)
        for (const std::uint32_t other : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
          sum[t[k]] += wishes.weight[other] * wishes.move[other];
          weight[t[k]] += wishes.weight[other];
        }
    for (std::size_t v = 0; v < sum.size(); ++v) {
      if (!(weight[v] > 0)) continue;
      const vec3 around = sum[v] / weight[v];
      wishes.move[v] = wishes.weight[v] > 0 ? 0.5f * (wishes.move[v] + around) : around;
      wishes.weight[v] = std::max(wishes.weight[v], 0.2f);
    }
  }
}

}  // namespace

SkinWarp::SkinWarp(TriangleMesh skin, const SkinShell& target, float height) {
  for (int round = 0; round < kWarpRounds; ++round) {
    const std::vector<vec3> normals = vertexNormals(skin);
    Wishes wishes = askAll(skin, normals, target, kFarthest * height);
    smooth(skin, wishes);
    Round done;
    done.blur = kWarpBlur * height;
    const std::size_t step = std::max<std::size_t>(1, skin.positions.size() / kWarpSamples);
    for (std::size_t v = 0; v < skin.positions.size(); v += step) {
      done.places.push_back(skin.positions[v]);
      done.normals.push_back(normals[v]);
      done.moves.push_back(wishes.move[v]);
    }
    for (std::size_t v = 0; v < skin.positions.size(); ++v) skin.positions[v] += wishes.move[v];
    rounds_.push_back(std::move(done));
  }
}

void SkinWarp::run(std::span<vec4> points) const {
  parallelFor(points.size(), 64, [&](std::size_t i) {
    for (const Round& round : rounds_) {
      const vec3 p(points[i]);
      vec3 sum(0);
      float weights = 0;
      for (std::size_t k = 0; k < round.places.size(); ++k) {
        const vec3 way = round.places[k] - p;
        const float squared = glm::dot(way, way), facing = glm::dot(way, round.normals[k]);
        if (facing < 0 && facing * facing > 0.06f * squared) continue;
        const float near = 1 / (squared + round.blur * round.blur);
        sum += near * near * round.moves[k];
        weights += near * near;
      }
      if (weights > 0) points[i] += vec4(sum / weights, 0);
    }
  });
}

}  // namespace vasa
