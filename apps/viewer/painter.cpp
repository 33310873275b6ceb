#include "viewer/painter.h"

namespace vasa::viewer {
namespace {

// Of vessels in a picture that the next one follows at once: less than what a sample a pixel gets wrong.
constexpr float kMovingPixelError = 1;

}  // namespace

void Painter::choose(std::shared_ptr<const Document> document, const Detail& detail, bool timed) {
  if (document == document_ && detail == detail_ && timed == timed_) return;
  last_ = nullptr;
  live_ = {};
  still_ = {};
  document_ = std::move(document);
  detail_ = detail;
  timed_ = timed;
}

Painter::Brush& Painter::brush(const Shot& shot) {
  Brush& brush = shot.fine ? still_ : live_;
  if (brush.renderer) return brush;
  RenderOptions options{.width = shot.width,
                        .height = shot.height,
                        .samples = shot.fine ? 4u : 1u,
                        .shape = {std::uint32_t(detail_.around), std::uint32_t(detail_.along)},
                        .pixelError = !detail_.automatic ? 0 : shot.fine ? kAutoPixelError : kMovingPixelError,
                        .levels = &document_->levels,
                        .table = &document_->table,
                        .bgra = true,
                        .occlusion = shot.fine,
                        .seed = seed_,
                        .timed = timed_};
  if (detail_.capillaries > 0) options.growth = document_->growth.get();
  options.capillaries = {.levels = unsigned(detail_.capillaries),
                         .edges = document_->file.capillaries.edges,
                         .budget = document_->file.capillaries.budget,
                         .smallest = document_->file.capillaries.smallest};
  brush.renderer = std::make_unique<Renderer>(device_, document_->scene.network, document_->scene.body.meshes, options);
  return brush;
}

void Painter::draw(const Shot& shot) {
  Brush& chosen = brush(shot);
  Renderer& renderer = *chosen.renderer;
  renderer.resize(shot.width, shot.height);
  if (chosen.colours != shot.colours) {
    renderer.setSweepColours(shot.colours);
    chosen.colours = shot.colours;
  }
  renderer.draw({.points = shot.body->points,
                 .knotFrames = shot.body->knotFrames,
                 .jointMatrices = shot.body->jointMatrices,
                 .camera = shot.camera,
                 .look = shot.look,
                 .heartScale = shot.body->heartScale});
  last_ = &renderer;
}

}  // namespace vasa::viewer
