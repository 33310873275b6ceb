#include "scene/bake.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/cancellation.h"

namespace vasa {
namespace {

// Of all frames' vertices and normals while they are worked on.
constexpr std::size_t kMostMemory = std::size_t(3) << 29;
constexpr SweepShape kShapes[] = {{12, 8}, {10, 6}, {8, 5}, {8, 4}, {6, 4},
                                  {6, 3},  {5, 3},  {4, 3}, {4, 2}, {3, 2}};
constexpr SweepShape kCoarsest = kShapes[std::size(kShapes) - 1];

// How far a pose is from what lies straight between two others: what a player that moves vertices straight
// from key to key gets wrong there.
float sag(const PosedFrame& before, const PosedFrame& pose, const PosedFrame& after, float share = 0.5f) {
  float worst = 0;
  for (std::size_t i = 0; i < pose.points.size(); ++i)
    worst = std::max(worst, glm::distance(vec3(pose.points[i]),
                                          glm::mix(vec3(before.points[i]), vec3(after.points[i]), share)));
  return worst;
}

// Poses a clip: a key a frame or at a rate of its own, and more keys where the motion between two frames is
// curved. Where it jumps (a small vessel gives way all at once) more keys would not bring it nearer, only
// show poses that the frames do not.
class FilmMaker {
 public:
  FilmMaker(const Scene& scene, const Clip* clip, const BakeOptions& options)
      : clip_(clip), options_(options), maker_(scene, options.frame) {}

  Film run() {
    const std::vector<float> times = keyTimes();
    const auto count = std::uint32_t(times.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      checkpoint();
      const float time = times[i];
      PosedFrame frame = posed(time);
      if (i > 0) addBetween(film_.times.back() + start(), time, frame, 0);
      addKey(std::move(frame), time);
      if (options_.progress) options_.progress(i + 1, count);
    }
    for (Candidate& place : between_) film_.between.push_back(std::move(place.between));
    return std::move(film_);
  }

 private:
  static constexpr int kHalvings = 4;  // of the time between two keys: of 10 a second to one in 6 ms
  // Halving the time between two keys quarters the sag of smooth motion and lessens that of most corners; a
  // jump stays.
  static constexpr float kStillCurved = 0.75f;
  static constexpr std::size_t kMostBetween = 5;  // poses between keys that are kept to measure by

  std::vector<float> keyTimes() const {
    if (!clip_) return {0};
    std::vector<float> times;
    if (options_.fps <= 0) {
      for (std::uint32_t frame = options_.first; frame <= options_.last; ++frame)
        times.push_back(clip_->timeOfFrame(frame));
      return times;
    }
    const float from = clip_->timeOfFrame(options_.first), to = clip_->timeOfFrame(options_.last);
    const int steps = std::max(int(std::lround((to - from) * options_.fps)), to > from ? 1 : 0);
    for (int i = 0; i <= steps; ++i)
      times.push_back(steps > 0 ? glm::mix(from, to, float(i) / float(steps)) : from);
    return times;
  }
  float start() const { return clip_->timeOfFrame(options_.first); }
  PosedFrame posed(float time) {
    maker_.make(clip_, time);
    return {{maker_.points().begin(), maker_.points().end()},
            {maker_.knotFrames().begin(), maker_.knotFrames().end()}};
  }
  void addKey(PosedFrame frame, float time) {
    film_.frames.push_back(std::move(frame));
    if (clip_) film_.times.push_back(time - start());
  }
  // From the latest key to `after`, which the caller adds.
  void addBetween(float timeBefore, float timeAfter, const PosedFrame& after, int halvings) {
    const float time = 0.5f * (timeBefore + timeAfter);
    PosedFrame middle = posed(time);
    const PosedFrame& before = film_.frames.back();
    const float off = sag(before, middle, after);
    if (off <= options_.betweenTolerance) return keep(std::move(middle), after, 0.5f);
    PosedFrame early = posed(0.75f * timeBefore + 0.25f * timeAfter),
               late = posed(0.25f * timeBefore + 0.75f * timeAfter);
    const bool curved = std::max(sag(before, early, middle), sag(middle, late, after)) <= kStillCurved * off;
    if (halvings == kHalvings || !curved) {
      keep(std::move(early), after, 0.25f);
      keep(std::move(middle), after, 0.5f);
      return keep(std::move(late), after, 0.75f);
    }
    addBetween(timeBefore, time, middle, halvings + 1);
    addKey(std::move(middle), time);
    addBetween(time, timeAfter, after, halvings + 1);
  }
  // A place between the latest key and `after`, among the worst so far.
  void keep(PosedFrame frame, const PosedFrame& after, float share) {
    const float off = sag(film_.frames.back(), frame, after, share);
    between_.push_back({off, {std::move(frame), std::uint32_t(film_.frames.size() - 1), share}});
    std::ranges::stable_sort(between_, std::greater(), &Candidate::off);
    if (between_.size() > kMostBetween) between_.pop_back();
  }

  struct Candidate {
    float off;
    Film::Between between;
  };
  const Clip* clip_;
  const BakeOptions& options_;
  FrameMaker maker_;
  Film film_;
  std::vector<Candidate> between_;
};

std::size_t vertexBytes(std::size_t vertices, std::size_t triangles, std::size_t shapes, bool normals) {
  const std::size_t vectors = normals ? 24 : 12;
  return vertices * (4 + vectors * (1 + shapes)) + 12 * triangles;
}

bool holdable(const FilmBaker::Size& size, std::size_t frames) {
  return size.vertices * 24 * frames <= kMostMemory;
}

std::size_t bytesOf(const Bake& bake) {
  std::size_t triangles = 0;
  for (const auto& part : bake.mesh.parts) triangles += part.triangles.size();
  return vertexBytes(bake.mesh.positions.size(), triangles, bake.mesh.shapes.size(),
                     !bake.mesh.normals.empty());
}

std::string megabytes(std::size_t bytes) {
  const std::size_t tenths = (bytes + 50'000) / 100'000;
  return std::to_string(tenths / 10) + (tenths % 10 ? "." + std::to_string(tenths % 10) : "") + " MB";
}

Error tooLarge(const SweepShape& shape, std::size_t bytes, std::size_t most) {
  const bool isCoarsest = shape.around == kCoarsest.around && shape.along == kCoarsest.along;
  return {Fault::failed, std::to_string(shape.around) + "x" + std::to_string(shape.along) + " quads take " +
                             megabytes(bytes) + ", the budget is " + megabytes(most) + "; give " +
                             (isCoarsest ? "" : "coarser quads, ") +
                             "fewer frames, a larger --tolerance, --flat or a larger --budget"};
}

// The number of shapes hardly depends on how finely sweeps are cut: a coarse trial tells what each shape will
// take.
Result<Bake> finestThatFits(const FilmBaker& baker, std::size_t frames, const BakeOptions& options) {
  if (const auto size = baker.sizeOf(kCoarsest); !holdable(size, frames))
    return tooLarge(kCoarsest, size.vertices * 24 * frames, kMostMemory);
  Bake trial = baker.run(kCoarsest);
  if (bytesOf(trial) > options.maxBytes) return tooLarge(kCoarsest, bytesOf(trial), options.maxBytes);
  for (const SweepShape& shape : kShapes) {
    if (shape.around > options.shape.around || shape.along > options.shape.along) continue;
    const auto size = baker.sizeOf(shape);
    if (!holdable(size, frames) || vertexBytes(size.vertices, size.triangles, trial.mesh.shapes.size(),
                                               options.mesh.normals) > options.maxBytes)
      continue;
    Bake fine = baker.run(shape);
    if (bytesOf(fine) <= options.maxBytes) return fine;
  }
  return trial;
}

}  // namespace

Result<Bake> bake(const Scene& scene, const Clip* clip, const BakeOptions& options) {
  const Film film = FilmMaker(scene, clip, options).run();
  const FilmBaker baker(scene.network, film, options.mesh);
  auto result = [&]() -> Result<Bake> {
    if (options.finestThatFits) return finestThatFits(baker, film.frames.size(), options);
    const auto size = baker.sizeOf(options.shape);
    if (!holdable(size, film.frames.size()))
      return tooLarge(options.shape, size.vertices * 24 * film.frames.size(), kMostMemory);
    Bake made = baker.run(options.shape);
    if (bytesOf(made) > options.maxBytes) return tooLarge(options.shape, bytesOf(made), options.maxBytes);
    return made;
  }();
  if (result && clip) result->mesh.clip = clip->name;
  return result;
}

}  // namespace vasa
