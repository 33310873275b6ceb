#include "surface/line_piece.h"

#include <algorithm>
#include <utility>

namespace vasa {
namespace {

void addTube(const Network& network, const VesselLine& line, float from, float to, bool capFrom, bool capTo,
             LinePiece& piece) {
  if (to <= from) return;
  const LinePlace a = line.place(from), b = line.place(to);
  const float start = b.reversed ? float(network.vessels()[b.vessel].spanCount()) : 0;
  TubeStretch tube{b.vessel, a.vessel == b.vessel ? a.u : start, b.u, capFrom, capTo};
  if (b.reversed) {
    std::swap(tube.from, tube.to);
    std::swap(tube.capFrom, tube.capTo);
  }
  if (tube.to > tube.from) piece.tubes.push_back(tube);
}

ForkCourse courseOf(std::span<const VesselLine> lines, const VesselLine& line, const ForkItem& item) {
  ForkCourse course{.low = line.place(item.room.low),
                    .high = line.place(item.room.high),
                    .length = item.room.high - item.room.low};
  for (const ForkLeaving& leaving : item.branches) {
    const VesselLine& branch = lines[leaving.child / 2];
    const bool last = leaving.child % 2 == 1;
    const auto way = [&](float fromEnd) { return last ? branch.length() - fromEnd : fromEnd; };
    course.branches.push_back({branch.place(way(leaving.exit.ring)), branch.place(way(leaving.exit.cross)),
                               last, vec3(line.point(leaving.centre + item.room.shift)), leaving.hole,
                               leaving.around, leaving.cornerAround, leaving.cornerAlong});
  }
  return course;
}

}  // namespace

void LinePiece::addFork(std::size_t index, std::vector<shared::ForkRecord>& allForks,
                        std::vector<shared::ForkBranch>& allBranches) const {
  shared::ForkRecord fork = forks[index];
  const auto own = std::span(branches).subspan(fork.firstBranch, fork.branchCount);
  fork.firstBranch = std::uint32_t(allBranches.size());
  allBranches.insert(allBranches.end(), own.begin(), own.end());
  allForks.push_back(fork);
}

LinePiece pieceOf(const Network& network, std::span<const VesselLine> lines, std::uint32_t index,
                  std::array<std::optional<float>, 2> rings, std::span<const ForkItem> items,
                  const LinePiece& before) {
  const VesselLine& line = lines[index];
  LinePiece piece;
  float from = rings[0].value_or(0);
  bool cap = !rings[0];
  for (const ForkItem& item : items) {
    addTube(network, line, from, item.room.low, cap, false, piece);
    piece.items.push_back(item);
    if (const auto same = std::ranges::find(before.items, item); same != before.items.end()) {
      const auto known = std::size_t(same - before.items.begin());
      before.addFork(known, piece.forks, piece.branches);
      piece.folds.push_back(before.folds[known]);
    } else {
      piece.forks.push_back(makeForkRecord(network, courseOf(lines, line, item), piece.branches));
      piece.folds.emplace_back();
    }
    from = item.room.high;
    cap = false;
  }
  addTube(network, line, from, line.length() - rings[1].value_or(0), cap, !rings[1], piece);
  return piece;
}

}  // namespace vasa
