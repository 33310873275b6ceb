#include "body/surface_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/parallel.h"

namespace vasa {
namespace {

// All starts are looked at roughly, and what comes of them ever more closely.
struct Round {
  std::size_t starts, samples;
  int steps;
};
constexpr Round kRounds[] = {{~std::size_t(0), 60, 8}, {40, 250, 25}, {6, 2000, 60}};
constexpr int kFacings = 4, kHeights = 9;
constexpr int kMostColumns = 12;  // a person with arms held out has 6
constexpr float kColumn =
    0.09f;  // of the body's height, between two places side by side: less than from arm to trunk
constexpr float kTilts[] = {0, -0.6f, 0.6f};  // [rad] sideways, of limbs: arms hang, or are held away
constexpr float kSizes[] = {0.65f, 0.8f, 1, 1.25f, 1.6f};
constexpr float kSmallest = 0.3f, kLargest = 3;  // from a newborn to an adult, and back
constexpr float kFacingSurface = 0.3f;           // least cosine between normals that belong together
constexpr float kFarAtFirst = 0.15f, kNearAtLast = 0.03f;  // of the body's height, between pairs
constexpr float kOddSize = 0.25f;                          // of the logarithm: a size as odd as this ...
constexpr float kOddSizeCost = 0.05f;  // ... is as bad as this share of the surface elsewhere
constexpr float kExact = 0.1f,
                kLeastDoubt = 0.3f;   // ... but for a share of it, where no more of it is elsewhere
constexpr float kTurnedCost = 0.02f;  // and so is another facing than the file's

struct Sample {
  vec3 place, normal;
};

class Fitter {
 public:
  Fitter(const TriangleMesh& surface, const SkinShell& skin,
         const std::function<float(const Similarity&)>& misplaced)
      : skin_(skin), height_(skin.mesh().bounds().extent().y), misplaced_(misplaced) {
    const Aabb box = surface.bounds();
    centre_ = 0.5f * (box.low + box.high), extent_ = box.extent();
    const std::vector<vec3> normals = vertexNormals(surface);
    for (const Round& round : kRounds) {
      std::vector<Sample>& samples = samplesOf_.emplace_back();
      const std::size_t count = std::min(round.samples, surface.positions.size());
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t v = i * surface.positions.size() / count;
        samples.push_back({surface.positions[v], normals[v]});
      }
    }
  }

  SurfaceFit run() const {
    std::vector<Try> tries = starts();
    for (std::size_t k = 0; k < samplesOf_.size(); ++k) {
      std::ranges::stable_sort(tries, {}, &Try::cost);
      tries.resize(std::min(tries.size(), kRounds[k].starts));
      parallelFor(tries.size(), 1, [&](std::size_t i) { refine(tries[i], samplesOf_[k], kRounds[k].steps); });
    }
    const Try& best = *std::ranges::min_element(tries, {}, &Try::cost);
    SurfaceFit fit{best.by, 0, 0, best.cost};
    std::size_t near = 0;
    double sum = 0;
    for (const Sample& sample : samplesOf_.back())
      if (const auto there = partnerOf(sample, best.by, kNearAtLast * height_))
        ++near, sum += glm::distance(*there, best.by(sample.place));
    fit.share = float(near) / float(std::max<std::size_t>(1, samplesOf_.back().size()));
    fit.distance = near ? float(sum / double(near)) : 0;
    return fit;
  }

 private:
  struct Try {
    Similarity by;
    bool turned;
    float cost = 0;
  };

  // The surface's middle at all heights at which it lies between head and feet, and as far aside as it lies
  // between the hands: a whole body or a trunk has its one place there, limbs have several.
  std::vector<Try> starts() const {
    const Aabb box = skin_.mesh().bounds();
    std::vector<Try> tries;
    for (int facing = 0; facing < kFacings; ++facing)
      for (const float size : kSizes) {
        const float half = std::min(0.5f * size * extent_.y, 0.5f * height_);
        const float wide = facing % 2 ? extent_.z : extent_.x;
        const float aside = std::max(0.5f * (box.extent().x - size * wide), 0.0f);
        const int columns =
            int(std::min(aside / (kColumn * height_), float(kMostColumns)));  // on either side
        for (int i = 0; i < kHeights; ++i)
          for (int column = -columns; column <= columns; ++column) {
            const float low = box.low.y + half, high = box.high.y - half;
            const vec3 middle(
                0.5f * (box.low.x + box.high.x) + (columns > 0 ? aside * float(column) / float(columns) : 0),
                glm::mix(low, high, float(i) / float(kHeights - 1)), 0.5f * (box.low.z + box.high.z));
            for (const float tilt : kTilts) {
              if (column == 0 && tilt != 0) continue;
              Similarity by{size,
                            glm::angleAxis(tilt, vec3(0, 0, 1)) *
                                glm::angleAxis(float(facing) * kPi / 2, vec3(0, 1, 0)),
                            vec3(0)};
              by.move = middle - by(centre_);
              tries.push_back({by, facing != 0});
            }
          }
      }
    return tries;
  }

  // The nearest place of the skin, if it is near and faces as the sample does.
  std::optional<vec3> partnerOf(const Sample& sample, const Similarity& by, float within) const {
    return skin_.facing(by(sample.place), by.turn * sample.normal, kFacingSurface, within);
  }

  void refine(Try& one, std::span<const Sample> samples, int steps) const {
    std::vector<std::pair<vec3, vec3>> pairs;
    for (int step = 0; step < steps; ++step) {
      const float within = height_ * glm::mix(kFarAtFirst, kNearAtLast, float(step) / float(steps - 1));
      pairs.clear();
      for (const Sample& sample : samples)
        if (const auto there = partnerOf(sample, one.by, within)) pairs.push_back({sample.place, *there});
      if (pairs.size() < samples.size() / 10 + 3) break;
      Similarity next = fitSimilarity(pairs, false);
      if (next.scale < kSmallest || next.scale > kLargest) {
        const float size = std::clamp(next.scale, kSmallest, kLargest);
        for (auto& pair : pairs) pair.first *= size;
        next = fitSimilarity(pairs, true);
        next.scale = size;
      }
      one.by = next;
    }
    one.cost = costOf(one, samples);
  }

  // The share of the surface that is elsewhere: by how far, and all of it where it faces another way.
  float costOf(const Try& one, std::span<const Sample> samples) const {
    double sum = 0;
    for (const Sample& sample : samples) {
      const float within = 2 * kNearAtLast * height_;
      const auto there = partnerOf(sample, one.by, within);
      sum += there ? glm::distance(*there, one.by(sample.place)) / within : 1;
    }
    const float elsewhere = float(sum / double(std::max<std::size_t>(1, samples.size())));
    const float odd = std::log(one.by.scale) / kOddSize;
    // Where it fits exactly, its size is right however odd: a child's.
    const float doubt = std::clamp(elsewhere / kExact, kLeastDoubt, 1.0f);
    return elsewhere + doubt * kOddSizeCost * odd * odd + (one.turned ? kTurnedCost : 0) +
           (misplaced_ ? misplaced_(one.by) : 0);
  }

  const SkinShell& skin_;
  float height_;
  const std::function<float(const Similarity&)>& misplaced_;
  vec3 centre_{0}, extent_{0};
  std::vector<std::vector<Sample>> samplesOf_;  // a round each
};

}  // namespace

SurfaceFit fitSurface(const TriangleMesh& surface, const SkinShell& skin,
                      const std::function<float(const Similarity&)>& misplaced) {
  return Fitter(surface, skin, misplaced).run();
}

}  // namespace vasa
