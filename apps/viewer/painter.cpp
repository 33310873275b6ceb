#include "viewer/painter.h"

#include <algorithm>

namespace vasa::viewer {
namespace {

// Of vessels in a picture that the next one follows at once: less than what a sample a pixel gets wrong.
constexpr float kMovingPixelError = 1;
// Capillaries of such a picture: they take a CPU about as long as all else that moves.
constexpr std::uint32_t kMovingCapillaries = 8'000;

RenderInput inputOf(const Shot& shot) {
  return {.points = shot.body->points,
          .knotFrames = shot.body->knotFrames,
          .jointMatrices = shot.body->jointMatrices,
          .camera = shot.camera,
          .look = shot.look,
          .heartScale = shot.body->heartScale};
}

}  // namespace

void Painter::choose(std::shared_ptr<const Document> document, const Detail& detail, bool timed) {
  if (document == document_ && detail == detail_ && timed == timed_) return;
  last_ = nullptr;
  for (Brush* brush : {&live_, &still_}) {
    if (document && brush->levels != document->levels) *brush = {};  // of another body
    if (!brush->grown || brush->grown == document) continue;
    brush->renderer->grow(nullptr, {});
    brush->grown = nullptr;
    brush->detail.capillaries = 0;
    brush->colours.clear();
  }
  document_ = std::move(document);
  detail_ = detail;
  timed_ = timed;
}

// As it has to be for what is chosen now. Edits leave the body as it is, and one that goes on by dragging
// even the vessels' layout.
Painter::Brush& Painter::brush(const Shot& shot) {
  Brush& brush = shot.fine ? still_ : live_;
  const CapillaryChoice& choice = document_->file.capillaries;
  const RenderOptions options{.width = shot.width,
                              .height = shot.height,
                              .samples = shot.fine ? 4u : 1u,
                              .shape = {std::uint32_t(detail_.around), std::uint32_t(detail_.along)},
                              .pixelError = !detail_.automatic ? 0
                                            : shot.fine        ? kAutoPixelError
                                                               : kMovingPixelError,
                              .levels = document_->levels.get(),
                              .table = document_->table.get(),
                              .bgra = true,
                              .occlusion = shot.fine,
                              .seed = seed_,
                              .compileBehind = !shot.fine && !shot.waits && !compiled_,
                              .timed = timed_};
  const bool anyGrowth = detail_.capillaries > 0,
             made = brush.renderer && brush.timed == timed_ && brush.levels == document_->levels,
             sameQuads = brush.detail.automatic == detail_.automatic &&
                         brush.detail.around == detail_.around && brush.detail.along == detail_.along,
             sameTubes = made && sameQuads && brush.table == document_->table;
  const Brush& other = shot.fine ? live_ : still_;
  const Network& network = document_->scene.network;
  if (!made && other.renderer && other.levels == document_->levels)
    brush.renderer = std::make_unique<Renderer>(device_, network, *other.renderer, options);
  else if (!made)
    brush.renderer = std::make_unique<Renderer>(device_, network, document_->scene.body.meshes, options);
  else if (!sameTubes)
    brush.renderer->take(network, options);
  if (!sameTubes) {  // without capillaries, in the kinds' colours
    brush.detail.capillaries = 0;
    brush.colours.clear();
  }
  if (brush.detail.capillaries != detail_.capillaries || (anyGrowth && brush.grown != document_)) {
    brush.renderer->grow(anyGrowth ? document_->growth.get() : nullptr,
                         {.levels = unsigned(detail_.capillaries),
                          .edges = choice.edges,
                          .budget = shot.fine ? choice.budget : std::min(choice.budget, kMovingCapillaries),
                          .smallest = choice.smallest});
    brush.colours.clear();
  }
  brush.levels = document_->levels;
  brush.table = document_->table;
  brush.grown = anyGrowth ? document_ : nullptr;
  brush.detail = detail_;
  brush.timed = timed_;
  return brush;
}

Renderer& Painter::prepared(const Shot& shot) {
  Brush& chosen = brush(shot);
  chosen.renderer->resize(shot.width, shot.height);
  if (chosen.colours != shot.colours) {
    chosen.renderer->setSweepColours(shot.colours);
    chosen.colours = shot.colours;
  }
  return *chosen.renderer;
}

void Painter::draw(const Shot& shot) {
  Renderer& renderer = prepared(shot);
  RenderInput input = inputOf(shot);
  input.waits = shot.waits || compiled_;
  bare_ = !input.waits && !renderer.isSettled({});
  renderer.draw(input);
  compiled_ = !bare_;
  last_ = &renderer;
}

void Painter::begin(const Shot& shot) {
  Renderer& renderer = prepared(shot);
  if (last_ == &renderer) last_ = nullptr;  // what it shows goes
  renderer.begin(inputOf(shot));
}

bool Painter::step() {
  // Both would have the driver compile the same.
  if (live_.renderer && !live_.renderer->isSettled(std::chrono::milliseconds(long(kSliceTime)))) return true;
  compiled_ = true;
  if (still_.renderer->step()) return true;
  last_ = still_.renderer.get();
  bare_ = false;
  return false;
}

}  // namespace vasa::viewer
