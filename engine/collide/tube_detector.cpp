#include "collide/tube_detector.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "collide/closest_tubes.h"
#include "collide/contact_search.h"
#include "collide/kernels.h"
#include "core/parallel.h"

// Work is cut into tasks: group pairs of some level, found by opening the tree from its root until there are
// enough. Each task has its own working memory and result; the results are joined and sorted, so that neither
// the number of tasks nor their order shows. Candidates are settled in chunks while they are in the cache.
namespace vasa {
namespace {

constexpr std::size_t kChunk = 1024;       // candidates settled at once
constexpr int kVectorLevels = 7;           // halvings in single precision
constexpr std::size_t kMostPieces = 64;    // a candidate; beyond, the search in double takes over
constexpr std::uint32_t kLeafBlock = 512;  // groups refitted by one task
constexpr std::size_t kTasksPerThread = 16;

struct Worker {
  std::vector<GroupPair> stack;
  std::vector<TubePair> candidates;  // slots
  std::vector<TubePair> meeting;     // slots whose capsules meet
  std::vector<PiecePair> pieces, halves;
  std::vector<std::uint8_t> settled;  // by candidate
  std::vector<TubePair> pairs;
  TubeDetector::Statistics statistics;
};

static_assert(sizeof(Bezier) == 16 * sizeof(float));
const float* floatsOf(std::span<const Bezier> tubes) {
  return reinterpret_cast<const float*>(tubes.data());
}

// Least significant digit first, as many digits as tube numbers have.
void sortPairs(std::vector<TubePair>& pairs, std::vector<TubePair>& scratch, std::uint32_t tubes) {
  constexpr int kDigit = 8;
  scratch.resize(pairs.size());
  const int bits = std::bit_width(tubes);
  for (const bool high : {false, true})
    for (int shift = 0; shift < bits; shift += kDigit) {
      const auto digit = [high, shift](const TubePair& pair) {
        return (high ? pair.i : pair.j) >> shift & 0xff;
      };
      std::array<std::uint32_t, (1 << kDigit) + 1> start{};
      for (const TubePair& pair : pairs) ++start[digit(pair) + 1];
      for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
      for (const TubePair& pair : pairs) scratch[start[digit(pair)]++] = pair;
      pairs.swap(scratch);
    }
}

}  // namespace

struct TubeDetector::State {
  State(std::span<const Bezier> rest, const Exclusions& exclusions, DetectorOptions chosen)
      : options(chosen), kernels(chosen.scalar ? scalarKernels() : fastKernels()), tree(rest) {
    groupExclusions(exclusions);
  }

  void groupExclusions(const Exclusions& exclusions);
  void update(std::span<const Bezier> shape, float margin);
  std::vector<GroupPair> tasks();
  void run(Worker& worker, std::span<const GroupPair> work);
  void settle(Worker& worker, std::size_t count);

  DetectorOptions options;
  const Kernels& kernels;
  BoxTree tree;
  std::vector<std::uint32_t> firstExcluded;
  std::vector<ExcludedGroup> excluded;
  std::span<const Bezier> tubes;
  float margin = 0;
  std::vector<Worker> workers;
  std::vector<TubePair> pairs, sortScratch;
  std::vector<Contact> contacts;
};

void TubeDetector::State::groupExclusions(const Exclusions& exclusions) {
  std::vector<std::uint32_t> slotOf(tree.tubeCount);
  for (std::uint32_t slot = 0; slot < tree.tubeCount; ++slot) slotOf[tree.tubes[slot]] = slot;
  const std::uint32_t groups = std::uint32_t(tree.tubes.size()) / kGroup;
  firstExcluded.assign(groups + 1, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> partners;  // slot of the partner, lane in this group
  for (std::uint32_t group = 0; group < groups; ++group) {
    partners.clear();
    for (std::uint32_t lane = 0; lane < kGroup && group * kGroup + lane < tree.tubeCount; ++lane)
      for (const std::uint32_t tube : exclusions.partnersOf(tree.tubes[group * kGroup + lane]))
        if (slotOf[tube] / kGroup >= group) partners.emplace_back(slotOf[tube], lane);
    std::sort(partners.begin(), partners.end());
    const std::size_t begin = excluded.size();
    for (const auto& [slot, lane] : partners) {
      if (excluded.size() == begin || excluded.back().group != slot / kGroup)
        excluded.push_back({slot / kGroup, 0});
      excluded.back().pairs |= LanePairs(1) << (lane * kGroup + slot % kGroup);
    }
    firstExcluded[group + 1] = std::uint32_t(excluded.size());
  }
}

void TubeDetector::State::update(std::span<const Bezier> shape, float wantedMargin) {
  assert(shape.size() == tree.tubeCount);
  tubes = shape;
  margin = wantedMargin;
  if (tubes.empty()) return;
  const BoxTreeView view = tree.view();
  const std::uint32_t groups = tree.groups(0);
  const auto fitBlock = [&](std::size_t block) {
    const std::uint32_t begin = std::uint32_t(block) * kLeafBlock;
    kernels.fitLeaves(view, floatsOf(tubes), 0.5f * margin, begin, std::min(groups, begin + kLeafBlock));
  };
  const std::size_t blocks = (groups + kLeafBlock - 1) / kLeafBlock;
  if (blocks > 2) {
    parallelFor(blocks, 1, fitBlock);
  } else {
    for (std::size_t block = 0; block < blocks; ++block) fitBlock(block);
  }
  for (std::uint32_t level = 1; level < tree.levels(); ++level)
    kernels.fitLevel(view, level, 0, tree.groups(level));
}

std::vector<GroupPair> TubeDetector::State::tasks() {
  std::vector<GroupPair> open{{tree.levels() - 1, 0, 0}};
  const std::size_t wanted = threadCount() > 1 ? kTasksPerThread * threadCount() : 1;
  Traversal work{tree.view(), firstExcluded.data(), excluded.data(), nullptr, 0, nullptr, 0};
  while (open.size() < wanted && open.front().level > 0) {
    std::vector<GroupPair> next;
    for (const GroupPair& pair : open) {
      GroupPair stack[kGroupPairs + 1] = {pair};
      work.stack = stack;
      work.stackSize = 1;
      kernels.openNode(work);
      next.insert(next.end(), stack, stack + work.stackSize);
    }
    if (next.empty()) break;
    open.swap(next);
  }
  return open;
}

// Breadth first: one level of all open pieces at a time, so that the vectors stay full.
void TubeDetector::State::settle(Worker& worker, std::size_t count) {
  if (worker.pieces.size() < count + 1) worker.pieces.resize(count + 1);
  const std::size_t candidates =
      kernels.meetCapsules(tree.view(), worker.candidates.data(), count, worker.pieces.data());
  worker.statistics.boxPairs += count;
  worker.meeting.resize(candidates);
  for (std::size_t c = 0; c < candidates; ++c) worker.meeting[c] = {worker.pieces[c].i, worker.pieces[c].j};
  worker.settled.assign(candidates, 0);
  std::size_t open = candidates;
  for (int level = 0; level < kVectorLevels && open > 0 && open <= kMostPieces * candidates; ++level) {
    worker.statistics.pieces[std::size_t(level)] += open;
    if (worker.halves.size() < 4 * open + 4) worker.halves.resize(4 * open + 4);
    open = kernels.narrow(tree.view(), level, worker.pieces.data(), open, worker.settled.data(),
                          worker.halves.data());
    worker.pieces.swap(worker.halves);
  }
  constexpr std::uint8_t kMeets = 1, kSearched = 2;
  for (const PiecePair& piece : std::span(worker.pieces.data(), open)) {
    std::uint8_t& settled = worker.settled[piece.candidate];
    if (settled) continue;
    ++worker.statistics.searched;
    settled =
        tubesIntersect(tree.shapes[piece.i], tree.shapes[piece.j], options.tolerance) ? kMeets : kSearched;
  }
  for (std::size_t c = 0; c < candidates; ++c)
    if (worker.settled[c] == kMeets)
      worker.pairs.push_back(orderedPair(tree.tubes[worker.meeting[c].i], tree.tubes[worker.meeting[c].j]));
}

void TubeDetector::State::run(Worker& worker, std::span<const GroupPair> work) {
  worker.pairs.clear();
  worker.statistics = {};
  worker.stack.resize(work.size() + kGroupPairs * (tree.levels() + 1));
  worker.candidates.resize(kChunk + kGroupPairs);
  std::copy(work.begin(), work.end(), worker.stack.begin());
  Traversal traversal{tree.view(),
                      firstExcluded.data(),
                      excluded.data(),
                      worker.stack.data(),
                      work.size(),
                      worker.candidates.data(),
                      0};
  while (traversal.stackSize > 0) {
    traversal.candidateCount = 0;
    kernels.traverse(traversal, kChunk);
    settle(worker, traversal.candidateCount);
  }
}

TubeDetector::TubeDetector(std::span<const Bezier> rest, const Exclusions& exclusions,
                           DetectorOptions options)
    : state_(std::make_unique<State>(rest, exclusions, options)) {}
TubeDetector::~TubeDetector() = default;
TubeDetector::TubeDetector(TubeDetector&&) noexcept = default;

void TubeDetector::update(std::span<const Bezier> tubes, float margin) {
  state_->update(tubes, margin);
}

std::span<const TubePair> TubeDetector::detect() {
  State& state = *state_;
  state.pairs.clear();
  if (state.tubes.empty()) return {};
  const std::vector<GroupPair> tasks = state.tasks();
  const std::size_t blocks = threadCount() > 1 ? std::min(tasks.size(), kTasksPerThread * threadCount()) : 1;
  if (state.workers.size() < blocks) state.workers.resize(blocks);
  const auto run = [&](std::size_t block) {
    const std::size_t begin = tasks.size() * block / blocks, end = tasks.size() * (block + 1) / blocks;
    state.run(state.workers[block], std::span(tasks).subspan(begin, end - begin));
  };
  if (blocks > 1) {
    parallelFor(blocks, 1, run);
  } else {
    run(0);
  }
  state.workers.resize(blocks);
  for (const Worker& worker : state.workers)
    state.pairs.insert(state.pairs.end(), worker.pairs.begin(), worker.pairs.end());
  sortPairs(state.pairs, state.sortScratch, state.tree.tubeCount);
  return state.pairs;
}

std::span<const Contact> TubeDetector::contacts() {
  State& state = *state_;
  state.contacts.resize(state.pairs.size());
  parallelFor(state.pairs.size(), 64, [&state](std::size_t k) {
    const TubePair pair = state.pairs[k];
    Contact contact = nearestPlace(state.tubes[pair.i], state.tubes[pair.j]);
    contact.i = pair.i;
    contact.j = pair.j;
    state.contacts[k] = contact;
  });
  return state.contacts;
}

TubeDetector::Statistics TubeDetector::statistics() const {
  Statistics sum;
  for (const Worker& worker : state_->workers) {
    sum.boxPairs += worker.statistics.boxPairs;
    for (std::size_t level = 0; level < sum.pieces.size(); ++level)
      sum.pieces[level] += worker.statistics.pieces[level];
    sum.searched += worker.statistics.searched;
  }
  return sum;
}

std::size_t TubeDetector::treeBytes() const {
  return state_->tree.bytes() + state_->firstExcluded.size() * sizeof(std::uint32_t) +
         state_->excluded.size() * sizeof(ExcludedGroup);
}

}  // namespace vasa
