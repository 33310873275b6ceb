#include "make_human/skin_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "body/skinning.h"
#include "core/ids.h"
#include "core/parallel.h"
#include "make_human/extreme_poses.h"
#include "make_human/path_weights.h"
#include "make_human/skin_sheet.h"
#include "make_human/solid.h"
#include "make_human/weight_fit.h"

// Weights and shapes are sought by turns: where the skin is with the weights it has, the sheet relaxes and is
// pushed out by the bones; then the weights come as near to that as they can. Blended joints can do less than
// a sheet, so that what is left over is pushed again.
namespace vasa::human {
namespace {

constexpr int kFittedPoses = 3;
constexpr int kFitRounds = 4, kSheetSteps = 25, kFieldRounds = 12;
constexpr float kThickness = 5e-3f;   // [m] of skin over a bone, at least, if it has as much at rest
constexpr float kRestShare = 0.8f;    // of what it has at rest
constexpr float kSkinReach = 0.05f;   // [m] bones deeper than this at rest never come near the skin
constexpr float kPushReach = 0.05f;   // [m] from the skin to a bone that has come out of it
constexpr float kJointReach = 0.10f;  // [m] along the skin from where a joint moves it
constexpr float kMovesIt = 0.05f;     // weight from which on a joint moves the skin at first
constexpr float kStayNear = 3e-4f, kBeSmooth = 5e-4f;  // [m²] price of a whole weight's change
constexpr float kPushedCounts = 10;                    // times as much as a sheet's wish, where a bone pushes
constexpr float kThinnest = 0.3e-3f;                   // [m] of skin, at least
constexpr std::size_t kBoneStep = 3;                   // bones' vertices looked at
constexpr float kFirst = 1;  // [m] more than any push: what covers a bone at rest goes before what is near

using Floor = SkinSheet::Floor;

bool canMove(const SoughtWeights& sought, std::uint16_t joint) {
  const auto end = sought.joints.begin() + sought.count;
  return std::find(sought.joints.begin(), end, joint) != end;
}

/// The joints that may move each vertex, nearest along the skin first.
std::vector<SoughtWeights> candidates(const SkinnedMesh& skin, const SkinSheet& sheet, std::size_t joints) {
  const std::size_t count = skin.influences.size();
  std::vector<std::vector<std::pair<float, std::uint16_t>>> found(count);
  std::vector<float> way(count);
  using Open = std::pair<float, std::uint32_t>;
  for (std::size_t joint = 0; joint < joints; ++joint) {
    std::fill(way.begin(), way.end(), kJointReach);
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    for (std::uint32_t i = 0; i < count; ++i)
      for (int k = 0; k < 4; ++k)
        if (skin.influences[i].joints[std::size_t(k)] == joint && skin.influences[i].weights[k] > kMovesIt)
          way[i] = 0, open.emplace(0.0f, i);
    while (!open.empty()) {
      const auto [length, i] = open.top();
      open.pop();
      if (length > way[i]) continue;
      found[i].emplace_back(length, std::uint16_t(joint));
      for (std::uint32_t j : sheet.neighbours(i)) {
        const float next = length + glm::distance(skin.mesh.positions[i], skin.mesh.positions[j]);
        if (next < way[j]) way[j] = next, open.emplace(next, j);
      }
    }
  }
  std::vector<SoughtWeights> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::sort(found[i].begin(), found[i].end());
    SoughtWeights& sought = result[i];
    for (const auto& [length, joint] : found[i]) {
      if (sought.count == SoughtWeights::kMost) break;
      if (canMove(sought, joint)) continue;
      sought.joints[std::size_t(sought.count++)] = joint;
    }
    float total = 0;
    for (int c = 0; c < sought.count; ++c)
      for (int k = 0; k < 4; ++k)
        if (skin.influences[i].joints[std::size_t(k)] == sought.joints[std::size_t(c)])
          sought.weights[std::size_t(c)] += skin.influences[i].weights[k];
    for (int c = 0; c < sought.count; ++c) total += sought.weights[std::size_t(c)];
    for (int c = 0; c < sought.count; ++c) sought.weights[std::size_t(c)] /= std::max(total, 1e-6f);
  }
  return result;
}

vec3 blended(const SoughtWeights& sought, const std::vector<mat4>& matrices, vec3 rest) {
  vec3 sum(0);
  for (int c = 0; c < sought.count; ++c)
    if (const float w = sought.weights[std::size_t(c)]; w > 0)
      sum += w * vec3(matrices[sought.joints[std::size_t(c)]] * vec4(rest, 1));
  return sum;
}

quat mainTurn(const SoughtWeights& sought, const std::vector<mat4>& matrices) {
  int best = 0;
  for (int c = 1; c < sought.count; ++c)
    if (sought.weights[std::size_t(c)] > sought.weights[std::size_t(best)]) best = c;
  return glm::normalize(glm::quat_cast(mat3(matrices[sought.joints[std::size_t(best)]])));
}

class Fit {
 public:
  explicit Fit(Body& body) : skin_(body.meshes[0]), bones_(body.meshes[1]), sheet_(skin_.mesh) {
    for (const Pose& pose : extremePoses(body, kFittedPoses))
      matrices_.push_back(skinMatrices(body.skeleton, pose));
    joints_ = body.skeleton.joints.size();
    start_ = sought_ = candidates(skin_, sheet_, joints_);
    findThickness();
  }

  void run() {
    for (int round = 0; round < kFitRounds; ++round) {
      shapes_.resize(matrices_.size());
      parallelFor(matrices_.size(), 1, [&](std::size_t p) { shapes_[p] = wantedShape(matrices_[p]); });
      if (round + 2 == kFitRounds) keepFour();
      fitWeights();
    }
    for (std::size_t i = 0; i < sought_.size(); ++i) {
      Weights weights(joints_, 0);
      for (int c = 0; c < sought_[i].count; ++c)
        weights[sought_[i].joints[std::size_t(c)]] = sought_[i].weights[std::size_t(c)];
      skin_.influences[i] = strongest(weights);
    }
  }

 private:
  struct Shape {
    std::vector<vec3> at;
    std::vector<char> pushed;
  };

  /// How much skin there has to be over each of the bones' vertices that is near it at rest; 0: it is not.
  void findThickness() {
    const TriangleTree tree(skin_.mesh);
    thickness_.assign(bones_.mesh.positions.size(), 0);
    cover_.resize(thickness_.size());
    parallelFor(thickness_.size(), 256, [&](std::size_t i) {
      if (i % kBoneStep) return;
      const vec3 p = bones_.mesh.positions[i];
      const TriangleTree::Nearest nearest = tree.nearest(p, kSkinReach);
      if (nearest.triangle == kNone || nearest.distance < 1e-6f) return;
      thickness_[i] = std::min(kThickness, std::max(kRestShare * nearest.distance, kThinnest));
      cover_[i] = {nearest.triangle, (nearest.point - p) / nearest.distance};
    });
  }

  /// What keeps the skin outside of the bones.
  std::vector<Floor> floorsOf(const TriangleMesh& posed, const std::vector<mat4>& matrices) const {
    std::vector<vec3> bones;
    skinPositions(bones_, matrices, bones);
    std::vector<Floor> floors(posed.positions.size());
    std::vector<float> short_(posed.positions.size(), 0);
    const Solid solid(posed);
    const TriangleTree tree(posed);
    for (std::size_t i = 0; i < bones.size(); ++i) {
      const float thickness = thickness_[i];
      if (thickness == 0) continue;
      const bool inside = solid.winding(bones[i]) > 0;
      const TriangleTree::Nearest nearest = tree.nearest(bones[i], inside ? thickness : kPushReach);
      if (nearest.triangle == kNone || nearest.distance < 1e-6f) continue;
      const std::uint16_t joint = bones_.influences[i].joints[0];
      const auto push = [&](std::uint32_t triangle, vec3 away, float urgency) {
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t v = posed.triangles[triangle][k];
          const float offset = glm::dot(bones[i], away) + thickness;
          const float wanting = offset - glm::dot(posed.positions[v], away);
          if (wanting > 0 && wanting + urgency > short_[v] && canMove(sought_[v], joint))
            short_[v] = wanting + urgency, floors[v] = {away, offset};
        }
      };
      if (!inside) push(cover_[i].triangle, mat3(matrices[joint]) * cover_[i].away, kFirst);
      push(nearest.triangle,
           (inside ? nearest.point - bones[i] : bones[i] - nearest.point) / nearest.distance, 0);
    }
    return floors;
  }

  Shape wantedShape(const std::vector<mat4>& matrices) const {
    TriangleMesh posed{{}, skin_.mesh.triangles};
    std::vector<quat> turns;
    for (std::size_t i = 0; i < sought_.size(); ++i) {
      posed.positions.push_back(blended(sought_[i], matrices, skin_.mesh.positions[i]));
      turns.push_back(mainTurn(sought_[i], matrices));
    }
    const std::vector<Floor> floors = floorsOf(posed, matrices);
    sheet_.relax(posed.positions, turns, floors, kSheetSteps);
    Shape shape{std::move(posed.positions), std::vector<char>(floors.size(), 0)};
    for (std::size_t i = 0; i < floors.size(); ++i) shape.pushed[i] = floors[i].bounds();
    return shape;
  }

  WeightQuadric quadricOf(std::size_t i) const {
    WeightQuadric q;
    const SoughtWeights& sought = sought_[i];
    const vec3 rest = skin_.mesh.positions[i];
    for (std::size_t p = 0; p < matrices_.size(); ++p) {
      std::array<vec3, SoughtWeights::kMost> moves;
      for (int c = 0; c < sought.count; ++c)
        moves[std::size_t(c)] =
            vec3(matrices_[p][sought.joints[std::size_t(c)]] * vec4(rest, 1)) - shapes_[p].at[i];
      const float counts = shapes_[p].pushed[i] ? kPushedCounts : 1.0f;
      for (int c = 0; c < sought.count; ++c)
        for (int d = 0; d < sought.count; ++d)
          q.a[std::size_t(c)][std::size_t(d)] +=
              counts * glm::dot(moves[std::size_t(c)], moves[std::size_t(d)]);
    }
    return q;
  }

  void fitWeights() {
    std::vector<WeightQuadric> quadrics(sought_.size());
    parallelFor(sought_.size(), 256, [&](std::size_t i) { quadrics[i] = quadricOf(i); });
    for (int round = 0; round < kFieldRounds; ++round) {
      std::vector<SoughtWeights> next = sought_;
      parallelFor(sought_.size(), 256, [&](std::size_t i) {
        WeightQuadric q = quadrics[i];
        const SoughtWeights around = meanAround(i);
        for (int c = 0; c < next[i].count; ++c) {
          const std::size_t k = std::size_t(c);
          q.a[k][k] += kStayNear + kBeSmooth;
          q.b[k] += kStayNear * start_[i].weights[k] + kBeSmooth * around.weights[k];
        }
        lower(q, next[i]);
      });
      sought_ = std::move(next);
    }
  }

  /// The neighbours' mean weights of the joints that may move a vertex.
  SoughtWeights meanAround(std::size_t i) const {
    SoughtWeights mean = sought_[i];
    mean.weights = {};
    for (std::uint32_t j : sheet_.neighbours(i))
      for (int c = 0; c < mean.count; ++c)
        for (int d = 0; d < sought_[j].count; ++d)
          if (sought_[j].joints[std::size_t(d)] == mean.joints[std::size_t(c)])
            mean.weights[std::size_t(c)] += sought_[j].weights[std::size_t(d)];
    for (float& w : mean.weights) w /= float(sheet_.neighbours(i).size());
    return mean;
  }

  void keepFour() {
    for (std::size_t i = 0; i < sought_.size(); ++i) {
      std::array<int, SoughtWeights::kMost> order{};
      const SoughtWeights all = sought_[i], start = start_[i];
      for (int c = 0; c < all.count; ++c) order[std::size_t(c)] = c;
      std::stable_sort(order.begin(), order.begin() + all.count, [&](int a, int b) {
        return all.weights[std::size_t(a)] > all.weights[std::size_t(b)];
      });
      SoughtWeights& kept = sought_[i];
      kept.count = std::min(all.count, 4);
      float total = 0;
      for (int c = 0; c < kept.count; ++c) {
        const std::size_t from = std::size_t(order[std::size_t(c)]);
        kept.joints[std::size_t(c)] = all.joints[from];
        total += kept.weights[std::size_t(c)] = all.weights[from];
        start_[i].weights[std::size_t(c)] = start.weights[from];
      }
      for (int c = 0; c < kept.count; ++c) kept.weights[std::size_t(c)] /= total;
    }
  }

  SkinnedMesh& skin_;
  const SkinnedMesh& bones_;
  SkinSheet sheet_;
  std::size_t joints_ = 0;
  std::vector<std::vector<mat4>> matrices_;  // of each pose
  std::vector<SoughtWeights> start_, sought_;
  struct Cover {  // the skin over a bone's vertex at rest
    std::uint32_t triangle = 0;
    vec3 away{0};
  };
  std::vector<float> thickness_;
  std::vector<Cover> cover_;
  std::vector<Shape> shapes_;
};

}  // namespace

void fitSkin(Body& body) { Fit(body).run(); }

}  // namespace vasa::human
