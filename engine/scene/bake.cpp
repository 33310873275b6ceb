#include "scene/bake.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

constexpr std::size_t kMostMemory = std::size_t(3) << 29;  // of all frames' vertices and normals while they are worked on
constexpr SweepShape kShapes[] = {{12, 8}, {10, 6}, {8, 5}, {8, 4}, {6, 4}, {6, 3}, {5, 3}, {4, 3}, {4, 2}, {3, 2}};

std::optional<Film> poseAll(const Scene& scene, const Clip* clip, const BakeOptions& options) {
  constexpr std::uint32_t kBetween = 5;
  FrameMaker maker(scene, options.frame);
  const auto posed = [&](float time) {
    maker.make(clip, time);
    return PosedFrame{{maker.points().begin(), maker.points().end()}, {maker.knotFrames().begin(), maker.knotFrames().end()}};
  };
  Film film;
  const std::uint32_t count = options.last - options.first + 1, step = std::max(1u, count / kBetween);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (options.stopRequested && options.stopRequested()) return std::nullopt;
    const float time = clip ? clip->timeOfFrame(options.first + i) : 0;
    film.frames.push_back(posed(time));
    if (clip) film.times.push_back(time - clip->timeOfFrame(options.first));
    if (clip && i + 1 < count && i % step == step / 2) {
      film.between.push_back(posed(0.5f * (time + clip->timeOfFrame(options.first + i + 1))));
      film.betweenAt.push_back(i);
    }
    if (options.progress) options.progress(i + 1, count);
  }
  return film;
}

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
  return vertexBytes(bake.mesh.positions.size(), triangles, bake.mesh.shapes.size(), !bake.mesh.normals.empty());
}

Error tooLarge(const SweepShape& shape, std::size_t bytes, std::size_t most) {
  return {Fault::failed, std::to_string(shape.around) + "x" + std::to_string(shape.along) + " quads take " + std::to_string(bytes >> 20) + " MB, the budget is " +
                             std::to_string(most >> 20) + " MB; give coarser quads, fewer frames, a larger --tolerance or a larger --budget"};
}

// The number of shapes hardly depends on how finely sweeps are cut: a coarse trial tells what each shape will take.
Result<Bake> finestThatFits(const FilmBaker& baker, std::size_t frames, const BakeOptions& options) {
  constexpr SweepShape coarsest{3, 2};
  if (const auto size = baker.sizeOf(coarsest); !holdable(size, frames)) return tooLarge(coarsest, size.vertices * 24 * frames, kMostMemory);
  Bake trial = baker.run(coarsest);
  if (bytesOf(trial) > options.maxBytes) return tooLarge(coarsest, bytesOf(trial), options.maxBytes);
  for (const SweepShape& shape : kShapes) {
    if (shape.around > options.shape.around || shape.along > options.shape.along) continue;
    const auto size = baker.sizeOf(shape);
    if (!holdable(size, frames) || vertexBytes(size.vertices, size.triangles, trial.mesh.shapes.size(), options.mesh.normals) > options.maxBytes) continue;
    Bake fine = baker.run(shape);
    if (bytesOf(fine) <= options.maxBytes) return fine;
  }
  return trial;
}

}  // namespace

Result<Bake> bake(const Scene& scene, const Clip* clip, const BakeOptions& options) {
  const auto film = poseAll(scene, clip, options);
  if (!film) return Error{Fault::interrupted, "stopped"};
  const FilmBaker baker(scene.network, *film, options.mesh);
  auto result = [&]() -> Result<Bake> {
    if (options.finestThatFits) return finestThatFits(baker, film->frames.size(), options);
    const auto size = baker.sizeOf(options.shape);
    if (!holdable(size, film->frames.size())) return tooLarge(options.shape, size.vertices * 24 * film->frames.size(), kMostMemory);
    Bake made = baker.run(options.shape);
    if (bytesOf(made) > options.maxBytes) return tooLarge(options.shape, bytesOf(made), options.maxBytes);
    return made;
  }();
  if (result && clip) result->mesh.clip = clip->name;
  return result;
}

}  // namespace vasa
