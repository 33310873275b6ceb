#include "paper_look.h"

#include <algorithm>

#include "core/clock.h"

namespace vasa::cli {
namespace {

std::vector<Bezier> shapeOf(const NetworkTubes& layout, std::span<const vec4> points) {
  std::vector<Bezier> tubes(layout.count());
  layout.shape(points, tubes);
  return tubes;
}

template <class Detector>
std::pair<std::span<const TubePair>, double> timed(Detector& detector, std::span<const Bezier> tubes) {
  const auto start = Clock::now();
  detector.update(tubes);
  const std::span<const TubePair> pairs = detector.detect();
  return {pairs, msSince(start)};
}

// Of two sorted lists.
std::size_t countOnlyInFirst(std::span<const TubePair> first, std::span<const TubePair> second) {
  return std::size_t(std::ranges::count_if(
      first, [&](const TubePair& pair) { return !std::ranges::binary_search(second, pair); }));
}

}  // namespace

PaperLook::PaperLook(const Network& network)
    : layout_(network),
      rest_(shapeOf(layout_, network.points())),
      tubes_(rest_),
      paper_(rest_, layout_.neighbours(), kPaperTolerance * network.bodyHeight()) {}

PaperLook::Pairs PaperLook::at(std::span<const vec4> points) {
  layout_.shape(points, tubes_);
  // A new one: it knows of nothing that stayed.
  TubeDetector detector(rest_, layout_.neighbours());
  const auto [exact, exactMs] = timed(detector, tubes_);
  const auto [paper, paperMs] = timed(paper_, tubes_);
  return {exact.size(), paper.size(), countOnlyInFirst(paper, exact), countOnlyInFirst(exact, paper),
          exactMs,      paperMs};
}

void addPaperLook(const PaperLook::Pairs& before, const PaperLook::Pairs& after, Report& row) {
  row["exact_pairs_before"] = before.exact;
  row["exact_pairs_after"] = after.exact;
  row["paper_pairs_before"] = before.paper;
  row["paper_pairs_after"] = after.paper;
  row["paper_false_pairs_before"] = before.wrong;
  row["paper_false_pairs_after"] = after.wrong;
  row["paper_missed_pairs"] = before.missed + after.missed;
  row["exact_detect_ms"] = before.exactMs;
  row["paper_detect_ms"] = before.paperMs;
}

}  // namespace vasa::cli
