#include "surface/fork_plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/hash.h"
#include "surface/fork_item.h"
#include "surface/fork_memory.h"
#include "surface/fork_trials.h"
#include "surface/line_piece.h"
#include "surface/vessel_line.h"

// A line's own ends are settled first (where its tube begins in the wall of its host), then the forks on it
// are given room. A branch without room is dropped; that lengthens its own line again, so lines are gone
// through until no branch is dropped any more. Then forks that fold are mended, and all is done again.
// What was dropped may then find room after all. Branches are only ever dropped, taken in once more, or tried
// in another manner, once each and once over, until the best of them is settled, so this ends. The first
// manners make the widest fillets, which look most like a vessel that opens into another.
namespace vasa {
namespace {

// Ways to make a fork, tried one after the other until it does not fold; in radii of the branch.
struct Manner {
  float clearance, longest;  // of findForkExit()
  float fillet;
};
constexpr Manner kManners[] = {
    {1.3f, 4, 0.9f}, {1.3f, 4, 0.6f},      {1.0f, 3, 0.6f},     {0.35f, 3, 0.35f}, {0.8f, 3, 0.35f},
    {1.4f, 3, 0.5f}, {0.35f, 1.5f, 0.35f}, {0.8f, 2, 0.6f},     {0.3f, 1, 0.15f},  {1.2f, 1.5f, 0.2f},
    {2.5f, 4, 0.5f}, {0.5f, 2, 0.15f},     {1.8f, 2.5f, 0.25f}, {3.5f, 5, 0.35f}};
// Of these, ever narrower ones: what found no room is looked at again in each.
constexpr std::uint32_t kNarrower[] = {0, 1, 2, 3, 6, 8};
// Radii of the host by which what is taken in again moves from its place (at 2.5 hardly more are taken in)
// and by which it moves others, and what it leaves to joins on either side: without that a thin branch took
// the join of two wide veins into its own small fork, which had a crease, and bent a third aside.
constexpr float kMostMoved = 1.5f, kMostPushed = 1, kJoinRoom = 0.5f;
constexpr std::uint8_t kWayBeyond = 16;  // of ForkWays: a manner, and so many times beyond_
static_assert(std::size(kManners) <= kWayBeyond);
constexpr float kNoShift = -1;
constexpr float kSliver = 0.1f;  // of the radius: shorter tubes go to the forks beside them

enum class Fate { none, forked, hidden, tooShort, crowded, folded };

class Planner {
 public:
  using VesselPair = std::array<VesselId, 2>;
  Planner(const Network& network, std::span<const VesselPair> apart, ForkMemory& memory)
      : network_(network), lines_(makeVesselLines(network, apart)), memory_(memory) {
    exits_.resize(2 * lines_.lines.size());
    fates_.resize(exits_.size(), Fate::none);
    children_.resize(lines_.lines.size());
    items_.resize(lines_.lines.size());
    pieces_.resize(lines_.lines.size());
    unsettled_.resize(lines_.lines.size(), true);
    old_.resize(lines_.lines.size(), true);
    for (const VesselLine& line : lines_.lines) keys_.push_back(line.key());
    trials_.resize(exits_.size());
    readmitted_.resize(exits_.size(), false);
    reopened_.resize(exits_.size(), false);
    beyond_.resize(exits_.size(), 0);
    shifts_.resize(exits_.size(), kNoShift);
    for (std::uint32_t end = 0; end < exits_.size(); ++end)
      if (isBranch(end)) children_[leftBy(end).host].push_back(end);
  }

  ForkPlan run(ForkTrials& shapes) {
    for (std::uint32_t end = 0; end < exits_.size(); ++end) findExit(end);
    do {
      giveRoom();
      emitOld();
      tryForks(shapes);
    } while (mendFolds() || readmit());
    return gathered();
  }

  ForkPlan runAs(const ForkWays& before) {
    for (std::uint32_t end = 0; end < exits_.size(); ++end) {
      const std::size_t own = vesselEnd(end);
      const std::uint8_t way = own < before.of.size() ? before.of[own] : std::uint8_t(0);
      const bool tube = way == ForkWays::kTube;
      if (!tube && way / kWayBeyond > 0) hang(end, way / kWayBeyond);
      trials_[end].manner = tube ? 0 : way % kWayBeyond;
      findExit(end);
      if (tube && forked(end)) fates_[end] = Fate::folded;
    }
    giveRoom();
    emitOld();
    return gathered();
  }

  /// Vessels whose join folds at rest in the plan of run().
  std::vector<VesselPair> bent() const {
    std::vector<VesselPair> pairs;
    for (const LinePiece& piece : pieces_)
      for (std::size_t i = 0; i < piece.forks.size(); ++i)
        if (!piece.items[i].branch() && piece.folds[i]->stump)
          pairs.push_back({VesselId{piece.forks[i].vesselA}, VesselId{piece.forks[i].vesselB}});
    return pairs;
  }

 private:
  struct Range {
    float low, high;
  };

  bool isBranch(std::uint32_t end) const { return lines_.ends[end / 2][end % 2].isBranch; }

  // What a branch leaves: its host, or what that one's end leaves.
  const LineEnd& leftBy(std::uint32_t end) const {
    const LineEnd& own = lines_.ends[end / 2][end % 2];
    return beyond_[end] > 0 ? lines_.ends[own.host][beyond_[end] - 1u] : own;
  }

  // @param beyond  the host's end, from 1 on; 0: the host itself
  void hang(std::uint32_t end, std::uint32_t beyond) {
    const std::uint32_t host = lines_.ends[end / 2][end % 2].host;
    if (!isBranch(end) || beyond > 2 || (beyond > 0 && !isBranch(2 * host + beyond - 1))) return;
    touch(end);
    std::erase(children_[leftBy(end).host], end);
    beyond_[end] = std::uint8_t(beyond);
    children_[leftBy(end).host].push_back(end);
  }

  // How a branch leaves is another: that concerns its own line and its host, and no others.
  void touch(std::uint32_t end) {
    const std::uint32_t own = end / 2, host = leftBy(end).host;
    unsettled_[own] = unsettled_[host] = old_[own] = old_[host] = true;
  }

  void drop(std::uint32_t end, Fate fate) {
    fates_[end] = fate;
    touch(end);
  }

  // A manner without room is no better than one that folds: back to the best that had room. @return whether
  // there is one
  bool giveWay(std::uint32_t end) {
    Trial& trial = trials_[end];
    if (trial.settled || trial.least.stump) return false;
    trial.settled = true;
    trial.manner = trial.best;
    findExit(end);
    return forked(end) && fits(end / 2) && fits(leftBy(end).host);
  }

  void findExit(std::uint32_t end) {
    if (!isBranch(end)) return;
    exits_[end] = exitOf(end, leftBy(end));
    fates_[end] = exits_[end].found ? Fate::forked : Fate::hidden;
    clearJoin(end);
    touch(end);
  }

  ForkExit exitOf(std::uint32_t end, const LineEnd& lineEnd) {
    const Manner& manner = kManners[trials_[end].manner];
    const struct {
      std::uint64_t branch, host;
      float hostWay, clearance, longest;
      std::uint32_t last;
    } asked{keys_[end / 2], keys_[lineEnd.host], lineEnd.hostWay, manner.clearance, manner.longest, end % 2};
    static_assert(sizeof asked == 32);
    const auto [found, isNew] = memory_.exits.try_emplace(hashOf(std::span(&asked, 1)));
    if (isNew)
      found->second = findForkExit(lines_.lines[end / 2], end % 2 == 1, lines_.lines[lineEnd.host],
                                   lineEnd.hostWay, manner.clearance, manner.longest);
    return found->second;
  }

  // Between the forks at its ends.
  bool hasRoom(std::uint32_t line) const {
    if (!forked(2 * line) || !forked(2 * line + 1)) return true;
    const float room = lines_.lines[line].length() - exits_[2 * line].ring - exits_[2 * line + 1].ring;
    return room >= kSliver * exits_[2 * line].radius;
  }

  // Lines of which nothing has changed since they were settled have it.
  void giveRoom() {
    for (std::uint32_t line = 0; line < lines_.lines.size(); ++line) {
      if (!hasRoom(line)) giveWay(2 * line);
      if (!hasRoom(line)) giveWay(2 * line + 1);
      if (!hasRoom(line)) drop(2 * line + 1, Fate::tooShort);
    }
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (std::uint32_t line = 0; line < lines_.lines.size(); ++line)
        if (std::exchange(unsettled_[line], false)) dropped = !settle(line) || dropped;
    }
  }

  // What lines have come to, where that is another.
  void emitOld() {
    emitted_.clear();
    for (std::uint32_t line = 0; line < lines_.lines.size(); ++line)
      if (std::exchange(old_[line], false)) emit(line), emitted_.push_back(line);
  }

  // Whether what is new folds.
  void tryForks(ForkTrials& shapes) {
    std::vector<shared::ForkRecord> forks;
    std::vector<shared::ForkBranch> branches;
    std::vector<std::optional<ForkFolds>*> answers;
    for (const std::uint32_t line : emitted_) {
      LinePiece& piece = pieces_[line];
      for (std::size_t i = 0; i < piece.forks.size(); ++i) {
        if (piece.folds[i]) continue;
        piece.addFork(i, forks, branches);
        answers.push_back(&piece.folds[i]);
      }
    }
    const std::vector<ForkFolds> folds = shapes.foldsOf(forks, branches);
    for (std::size_t i = 0; i < folds.size(); ++i) *answers[i] = folds[i];
  }

  ForkPlan gathered() const {
    ForkPlan plan;
    for (const LinePiece& piece : pieces_) {
      plan.tubes.insert(plan.tubes.end(), piece.tubes.begin(), piece.tubes.end());
      for (std::size_t i = 0; i < piece.forks.size(); ++i) {
        piece.addFork(i, plan.forks, plan.branches);
        plan.vesselOfFork.push_back(piece.forks[i].vesselA);
        plan.steps.push_back(piece.folds[i] ? piece.folds[i]->steps : 0);
        for (const ForkLeaving& leaving : piece.items[i].branches) plan.report.leaning += !leaving.exit.clear;
        plan.report.joins += piece.items[i].mustLow < 1e30f;
      }
    }
    std::sort(plan.tubes.begin(), plan.tubes.end(), [](const TubeStretch& a, const TubeStretch& b) {
      return a.vessel != b.vessel ? a.vessel < b.vessel : a.from < b.from;
    });
    count(plan.report);
    plan.ways.of.assign(2 * network_.vessels().size(), 0);
    for (std::uint32_t end = 0; end < exits_.size(); ++end)
      if (isBranch(end))
        plan.ways.of[vesselEnd(end)] =
            forked(end) ? std::uint8_t(kWayBeyond * beyond_[end] + trials_[end].manner) : ForkWays::kTube;
    return plan;
  }

  // How a branch is made, and what became of other ways to make it.
  struct Trial {
    std::uint32_t manner = 0, best = 0;
    std::uint32_t leastTaken = ~0u;
    ForkFolds least{true, ~0u, ~0u, ~0u, ~0u, ~0u};
    bool settled = false;
  };

  // Branches of a line that find no room, as its own fork takes it.
  std::uint32_t taken(std::uint32_t end) const {
    const VesselLine& line = lines_.lines[end / 2];
    return std::uint32_t(std::ranges::count_if(children_[end / 2], [&](std::uint32_t child) {
      const float foot = end % 2 ? line.length() - exits_[child].foot : exits_[child].foot;
      return fates_[child] == Fate::crowded && foot < exits_[end].ring;
    }));
  }

  // Branches of forks that fold are made in another manner; in the best of all, where each of them folds
  // somewhere; as tubes of their own where that is at rest. @return whether anything changed
  bool mendFolds() {
    bool changed = false;
    for (const std::uint32_t line : emitted_)
      for (std::size_t i = 0; i < pieces_[line].forks.size(); ++i)
        for (const ForkLeaving& leaving : pieces_[line].items[i].branches)
          if (const ForkFolds& folds = *pieces_[line].folds[i]; !folds.none() || taken(leaving.child) > 0)
            changed = tryOtherwise(leaving.child, folds) || changed;
    return changed;
  }

  bool tryOtherwise(std::uint32_t end, const ForkFolds& folds) {
    Trial& trial = trials_[end];
    if (trial.settled) {
      if (!folds.stump) return false;
      if (std::exchange(reopened_[end], true)) {
        drop(end, Fate::folded);
      } else {
        trial = {};  // once more: it has other neighbours by now
        findExit(end);
      }
      return true;
    }
    const std::uint32_t takes = taken(end);
    if (std::tie(folds.stump, takes, folds) < std::tie(trial.least.stump, trial.leastTaken, trial.least))
      trial.least = folds, trial.leastTaken = takes, trial.best = trial.manner;
    trial.settled = ++trial.manner == std::size(kManners);
    if (trial.settled) trial.manner = trial.best;
    findExit(end);
    if (trial.settled && trial.least.stump) fates_[end] = Fate::folded;
    return true;
  }

  // What was dropped may find room by now, or in a narrower manner: others were dropped later, or are made
  // otherwise. Or beyond its host. Once each, the thickest first. @return whether any was taken in
  bool readmit() {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t end = 0; end < fates_.size(); ++end)
      if (fates_[end] > Fate::hidden && !std::exchange(readmitted_[end], true)) ends.push_back(end);
    std::ranges::stable_sort(ends, std::greater{}, [&](std::uint32_t end) { return exits_[end].radius; });
    return std::ranges::count_if(ends, [&](std::uint32_t end) { return readmit(end); }) > 0;
  }

  bool readmit(std::uint32_t end) {
    const Fate fate = fates_[end];
    if (takeIn(end)) return true;
    for (const std::uint32_t beyond : {1, 2}) {
      if (beyond_[end] > 0 || !startsBeside(end, beyond - 1)) continue;
      hang(end, beyond);
      if (takeIn(end)) return true;
      hang(end, 0);
    }
    findExit(end);
    fates_[end] = fate;
    return false;
  }

  // In the first manner that finds room; the last one, which needs the least, is asked before all.
  bool takeIn(std::uint32_t end) {
    const auto finds = [&](std::uint32_t manner) {
      trials_[end] = {};
      trials_[end].manner = manner;
      findExit(end);
      return forked(end) && hasRoom(end / 2) && fits(end / 2) && fits(leftBy(end).host);
    };
    return finds(*std::rbegin(kNarrower)) && std::ranges::any_of(kNarrower, finds);
  }

  // Whether a branch starts where its host has not left its own host yet, within its radius of that one's
  // wall.
  bool startsBeside(std::uint32_t end, std::uint32_t hostEnd) const {
    const LineEnd& own = lines_.ends[end / 2][end % 2];
    const VesselLine &branch = lines_.lines[end / 2], &host = lines_.lines[own.host];
    const std::uint32_t left = 2 * own.host + hostEnd;
    const LineEnd& beyond = lines_.ends[own.host][hostEnd];
    if (!forked(left) || beyond_[left] > 0 || beyond.host == end / 2 || beyond.host == own.host) return false;
    if ((hostEnd ? host.length() - own.hostWay : own.hostWay) > exits_[left].ring) return false;
    const vec4 tip = branch.point(end % 2 ? branch.length() : 0);
    const VesselLine::Foot foot =
        lines_.lines[beyond.host].nearest(vec3(tip), beyond.hostWay, exits_[left].ring + tip.w);
    return foot.distance < foot.radius + tip.w;
  }

  // Whether all of a line's forks find room, with one that is new among them: it moves by kMostMoved at most,
  // others and joins hardly give way.
  bool fits(std::uint32_t index) const {
    const VesselLine& line = lines_.lines[index];
    const Range range = rangeOf(index);
    std::vector<ForkItem> items = itemsOf(index, range);
    for (ForkItem& item : items) {
      const float radius = line.point(item.room.centre).w;
      const float before = item.branch() ? shifts_[item.branches[0].child] : kNoShift;
      const float most = before == kNoShift ? kMostMoved : std::max(kMostPushed, before / radius);
      item.shiftLimit = std::min(item.shiftLimit, most * radius);
    }
    std::vector<ForkRoom> rooms;
    if (withoutRoom(items, rooms, range.low, range.high, 0)) return false;
    for (std::size_t i = 0; i < items.size(); ++i)
      if (items[i].mustLow < 1e30f &&
          besideJoin(items[i], rooms[i]) < kJoinRoom * line.point(items[i].mustLow).w)
        if (std::ranges::none_of(items_[index], [&](const ForkItem& before) {
              return before.mustLow == items[i].mustLow &&
                     besideJoin(before, before.room) <= besideJoin(items[i], rooms[i]);
            }))
          return false;
    return true;
  }

  static float besideJoin(const ForkItem& item, const ForkRoom& room) {
    return std::min(item.mustLow - room.low, room.high - item.mustHigh);
  }

  // 2 * vessel, and one more for its last end.
  std::size_t vesselEnd(std::uint32_t end) const {
    const auto parts = lines_.lines[end / 2].parts();
    const VesselLine::Part& part = end % 2 ? parts.back() : parts.front();
    return 2 * part.vessel.value + ((end % 2 == 1) != part.reversed);
  }

  bool forked(std::uint32_t end) const { return fates_[end] == Fate::forked; }

  // A branch's ring too near a join of its own line moves beyond it.
  void clearJoin(std::uint32_t end) {
    if (!forked(end)) return;
    const VesselLine& line = lines_.lines[end / 2];
    ForkExit& exit = exits_[end];
    const auto clear = [&](const VesselLine::Join& join) {
      const bool last = end % 2 == 1;
      const float near = last ? line.length() - join.at - join.gap : join.at;
      const float beside = 2 * kBesideJoin * exit.radius;
      if (exit.ring > near - beside && exit.ring < near + join.gap + beside)
        exit.ring = near + join.gap + beside;
    };
    if (end % 2 == 0)
      for (std::size_t i = 0; i < line.joins().size(); ++i) clear(line.joins()[i]);
    else
      for (std::size_t i = line.joins().size(); i-- > 0;) clear(line.joins()[i]);
    if (exit.ring > 0.98f * line.length()) fates_[end] = Fate::tooShort;
  }

  // What of a line forks may take: between its branch rings, or leaving some tube for a cap.
  Range rangeOf(std::uint32_t index) const {
    const VesselLine& line = lines_.lines[index];
    const float length = line.length();
    const auto margin = [&](std::uint32_t end) {
      if (forked(end)) return exits_[end].ring;
      float least = std::min(0.3f * line.point(end % 2 ? length : 0).w, 0.1f * length);
      for (const VesselLine::Join& join : line.joins())
        least = std::min(least, 0.25f * (end % 2 ? length - join.at - join.gap : join.at));
      return least;
    };
    return {margin(2 * index), length - margin(2 * index + 1)};
  }

  std::vector<ForkItem> itemsOf(std::uint32_t index, Range range) const {
    const VesselLine& line = lines_.lines[index];
    std::vector<ForkItem> branches;
    for (const std::uint32_t end : children_[index])
      if (forked(end)) {
        ForkItem& item = branches.emplace_back(
            branchItem(line, lines_.lines[end / 2], end, exits_[end], kManners[trials_[end].manner].fillet));
        if (readmitted_[end])
          item.shiftLimit = std::min(item.shiftLimit, kMostMoved * line.point(item.room.centre).w);
      }
    return arrangedItems(line, std::move(branches), range.low, range.high);
  }

  // @return false where a branch was dropped
  bool settle(std::uint32_t index) {
    const Range range = rangeOf(index);
    std::vector<ForkItem> items = itemsOf(index, range);
    std::vector<ForkRoom> rooms;
    const float sliver = kSliver * lines_.lines[index].point(range.low).w;
    if (const ForkItem* const item = withoutRoom(items, rooms, range.low, range.high, sliver)) {
      const std::uint32_t end = item->thinnest().child;
      if (!giveWay(end)) drop(end, Fate::crowded);
      return false;
    }
    for (const ForkItem& item : items_[index])
      if (item.branch()) shifts_[item.branches[0].child] = kNoShift;
    for (std::size_t i = 0; i < items.size(); ++i) {
      items[i].room = rooms[i];
      if (items[i].branch()) shifts_[items[i].branches[0].child] = std::abs(rooms[i].shift);
    }
    items_[index] = std::move(items);
    return true;
  }

  std::optional<float> ringOf(std::uint32_t end) const {
    return forked(end) ? std::optional(exits_[end].ring) : std::nullopt;
  }

  void emit(std::uint32_t index) {
    pieces_[index] = pieceOf(network_, lines_.lines, index, {ringOf(2 * index), ringOf(2 * index + 1)},
                             items_[index], pieces_[index]);
  }

  void count(ForkPlan::Report& report) const {
    report.doubles = lines_.doubles;
    for (const Fate fate : fates_) {
      report.branches += fate != Fate::none;
      report.forked += fate == Fate::forked;
      report.hidden += fate == Fate::hidden;
      report.tooShort += fate == Fate::tooShort;
      report.crowded += fate == Fate::crowded;
      report.folded += fate == Fate::folded;
    }
  }

  const Network& network_;
  VesselLines lines_;
  ForkMemory& memory_;
  std::vector<std::uint64_t> keys_;  // of the lines
  std::vector<ForkExit> exits_;      // 2 * line + end
  std::vector<Fate> fates_;
  std::vector<Trial> trials_;
  std::vector<char> readmitted_, reopened_;
  std::vector<std::uint8_t> beyond_;  // of each end: as hang() has it
  std::vector<float> shifts_;  // [m] of a fork's first branch on its host, as settled; kNoShift of others
  std::vector<std::vector<std::uint32_t>> children_;  // branches on each line
  std::vector<std::vector<ForkItem>> items_;
  std::vector<char> unsettled_, old_;  // lines of which something is another since they were settled, emitted
  std::vector<LinePiece> pieces_;
  std::vector<std::uint32_t> emitted_;  // lines, by the last emitOld()
};

}  // namespace

ForkPlan planWithoutForks(const Network& network) {
  ForkPlan plan;
  for (std::uint32_t i = 0; i < network.vessels().size(); ++i)
    plan.tubes.push_back({i, 0, float(network.vessels()[i].spanCount()), true, true});
  return plan;
}

ForkPlan planForksAs(const Network& network, const ForkWays& before, ForkMemory& memory) {
  memory.trim();
  ForkPlan plan = Planner(network, before.apart, memory).runAs(before);
  plan.ways = before;
  return plan;
}

ForkPlan planForks(const Network& network) {
  ForkMemory memory;
  return planForks(network, memory);
}

ForkPlan planForks(const Network& network, ForkMemory& memory) {
  memory.trim();
  std::vector<Planner::VesselPair> apart;
  ForkTrials shapes(network, memory);
  for (;;) {
    Planner planner(network, apart, memory);
    ForkPlan plan = planner.run(shapes);
    plan.ways.apart = apart;
    const std::size_t before = apart.size();
    for (const Planner::VesselPair& pair : planner.bent())
      if (pair[0] != pair[1]) apart.push_back(pair);
    if (apart.size() == before) return plan;
  }
}

}  // namespace vasa
