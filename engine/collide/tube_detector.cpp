#include "collide/tube_detector.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>

#include "collide/closest_tubes.h"
#include "collide/contact_search.h"
#include "collide/kernels.h"
#include "collide/narrow_phase.h"
#include "core/parallel.h"

// Work is cut into tasks: group pairs of some level, found by opening the tree from its root until there are
// enough. Each task has its own working memory and result; the results are joined and sorted, so that neither
// the number of tasks nor their order shows. Candidates are settled in chunks while they are in the cache.
namespace vasa {
namespace {

constexpr std::size_t kChunk = 1024;       // candidates settled at once
constexpr std::uint32_t kLeafBlock = 512;  // groups refitted by one task
constexpr std::size_t kTasksPerThread = 16;
constexpr double kExact = 1e-8;  // [m]

struct Worker {
  std::vector<GroupPair> stack;
  std::vector<TubePair> candidates;
  NarrowPhase narrow;
  std::vector<TubePair> pairs;
};

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
      : options(chosen),
        kernels(chosen.scalar ? scalarKernels() : fastKernels()),
        tree(rest),
        moved(rest.size(), true) {
    groupExclusions(exclusions);
  }

  void groupExclusions(const Exclusions& exclusions);
  void update(std::span<const Bezier> shape, float margin);
  void markMoved(bool all);
  bool haveMoved(TubePair pair) const { return moved[pair.i] || moved[pair.j]; }
  void findTasks();
  void run(Worker& worker, std::span<const GroupPair> work);

  DetectorOptions options;
  const Kernels& kernels;
  BoxTree tree;
  std::vector<std::uint32_t> firstExcluded;
  std::vector<ExcludedGroups> excluded;
  std::vector<GroupPair> tasks, nextTasks;
  std::vector<Worker> workers;
  std::size_t workersUsed = 0;
  std::vector<TubePair> pairs, sortScratch;
  std::vector<Contact> contacts, lastContacts;  // of the last two detect(); empty where nobody asked
  std::vector<Bezier> lastTubes;                // as the last detect() saw them; none before the first ...
  float lastGrow = -1;                          // ... with this; -1 where it did not come to its end
  std::vector<char> moved;                      // since then, a tube each
};

void TubeDetector::State::groupExclusions(const Exclusions& exclusions) {
  std::vector<std::uint32_t> slotOf(tree.tubeCount);
  for (std::uint32_t slot = 0; slot < tree.tubeCount; ++slot) slotOf[tree.tubeAt(slot)] = slot;
  const std::uint32_t groups = tree.slots() / kGroup;
  firstExcluded.assign(groups + 1, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> partners;  // slot of the partner, lane in this group
  for (std::uint32_t group = 0; group < groups; ++group) {
    partners.clear();
    for (std::uint32_t lane = 0; lane < kGroup && group * kGroup + lane < tree.tubeCount; ++lane)
      for (const std::uint32_t tube : exclusions.partnersOf(tree.tubeAt(group * kGroup + lane)))
        if (slotOf[tube] / kGroup >= group) partners.emplace_back(slotOf[tube], lane);
    std::sort(partners.begin(), partners.end());
    std::uint32_t last = kNoGroup;
    std::size_t used = 4;  // of the last entry's four
    for (const auto& [slot, lane] : partners) {
      if (slot / kGroup != last) {
        last = slot / kGroup;
        if (used == 4) excluded.push_back({{kNoGroup, kNoGroup, kNoGroup, kNoGroup}, {}}), used = 0;
        excluded.back().group[used++] = last;
      }
      excluded.back().pairs[used - 1] |= LanePairs(1) << (lane * kGroup + slot % kGroup);
    }
    firstExcluded[group + 1] = std::uint32_t(excluded.size());
  }
}

// Tubes, and the groups above them. @param all  the groups as if everything had moved
void TubeDetector::State::markMoved(bool all) {
  for (std::uint32_t tube = 0; tube < tree.tubeCount; ++tube)
    moved[tube] = lastTubes.empty() || std::memcmp(&tree.tubes[tube], &lastTubes[tube], sizeof(Bezier)) != 0;
  std::ranges::fill(tree.moved, std::uint8_t(0));
  for (std::uint32_t slot = 0; slot < tree.slots(); ++slot)
    tree.moved[slot / kGroup] |= std::uint8_t((all || moved[tree.tubeAt(slot)]) << slot % kGroup);
  for (std::uint32_t level = 1; level < tree.levels(); ++level)
    for (std::uint32_t child = 0; child < tree.groups(level - 1); ++child)
      tree.moved[tree.levelStart[level] + child / kGroup] |=
          std::uint8_t((tree.moved[tree.levelStart[level - 1] + child] != 0) << child % kGroup);
}

void TubeDetector::State::update(std::span<const Bezier> shape, float margin) {
  assert(shape.size() == tree.tubeCount);
  if (shape.empty()) return;
  tree.setShape(shape, 0.5f * margin);
  const BoxTreeView view = tree.view();
  const std::uint32_t groups = tree.groups(0);
  const auto fitBlock = [&](std::size_t block) {
    const std::uint32_t begin = std::uint32_t(block) * kLeafBlock;
    kernels.fitLeaves(view, begin, std::min(groups, begin + kLeafBlock));
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

void TubeDetector::State::findTasks() {
  tasks.assign(1, {tree.levels() - 1, 0, 0});
  const std::size_t wanted = threadCount() > 1 ? kTasksPerThread * threadCount() : 1;
  Traversal work{tree.view(), firstExcluded.data(), excluded.data(), nullptr, 0, nullptr, 0};
  while (tasks.size() < wanted && tasks.front().level > 0) {
    nextTasks.clear();
    for (const GroupPair& pair : tasks) {
      GroupPair stack[kGroupPairs + 1] = {pair};
      work.stack = stack;
      work.stackSize = 1;
      kernels.openNode(work);
      nextTasks.insert(nextTasks.end(), stack, stack + work.stackSize);
    }
    tasks.swap(nextTasks);
    if (tasks.empty()) return;
  }
}

void TubeDetector::State::run(Worker& worker, std::span<const GroupPair> work) {
  worker.pairs.clear();
  worker.narrow.statistics = {};
  worker.stack.resize(work.size() + kGroupPairs * (tree.levels() + 1));
  worker.candidates.resize(kChunk + kMostAdded);
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
    worker.narrow.settle(kernels, tree.view(), {worker.candidates.data(), traversal.candidateCount},
                         options.tolerance, worker.pairs);
  }
}

TubeDetector::TubeDetector(std::span<const Bezier> rest, const Exclusions& exclusions,
                           DetectorOptions options)
    : state_(std::make_unique<State>(rest, exclusions, options)) {}
TubeDetector::~TubeDetector() = default;
TubeDetector::TubeDetector(TubeDetector&&) noexcept = default;

void TubeDetector::update(std::span<const Bezier> tubes, float margin) { state_->update(tubes, margin); }

std::span<const TubePair> TubeDetector::detect() {
  State& state = *state_;
  if (state.tree.tubes.empty()) return {};
  const bool sameMargin = state.tree.grow == std::exchange(state.lastGrow, -1.0f);
  state.markMoved(!sameMargin);
  if (!sameMargin) state.pairs.clear(), state.contacts.clear();
  std::erase_if(state.pairs, [&](TubePair pair) { return state.haveMoved(pair); });
  state.contacts.swap(state.lastContacts);
  state.contacts.clear();
  state.findTasks();
  const std::span<const GroupPair> tasks = state.tasks;
  const std::size_t blocks = std::min(tasks.size(), threadCount() > 1 ? kTasksPerThread * threadCount() : 1);
  if (state.workers.size() < blocks) state.workers.resize(blocks);
  const auto run = [&](std::size_t block) {
    const std::size_t begin = tasks.size() * block / blocks, end = tasks.size() * (block + 1) / blocks;
    state.run(state.workers[block], tasks.subspan(begin, end - begin));
  };
  if (blocks == 1)
    run(0);
  else
    parallelFor(blocks, 1, run);
  state.workersUsed = blocks;
  for (const Worker& worker : std::span(state.workers.data(), blocks))
    state.pairs.insert(state.pairs.end(), worker.pairs.begin(), worker.pairs.end());
  sortPairs(state.pairs, state.sortScratch, state.tree.tubeCount);
  state.lastTubes.assign(state.tree.tubes.begin(), state.tree.tubes.end());
  state.lastGrow = state.tree.grow;
  return state.pairs;
}

std::span<const Contact> TubeDetector::contacts() {
  State& state = *state_;
  const std::span<const Bezier> tubes = state.tree.tubes;
  const auto pairOf = [](const Contact& contact) { return TubePair{contact.i, contact.j}; };
  state.contacts.resize(state.pairs.size());
  parallelFor(state.pairs.size(), 64, [&](std::size_t k) {
    const TubePair pair = state.pairs[k];
    if (!state.haveMoved(pair)) {
      const auto last = std::ranges::lower_bound(state.lastContacts, pair, {}, pairOf);
      if (last != state.lastContacts.end() && pairOf(*last) == pair) {
        state.contacts[k] = *last;
        return;
      }
    }
    const Bezier &a = tubes[pair.i], &b = tubes[pair.j];
    Contact contact = nearestPlace(a, b);
    // Newton steps from the nearest chords may end in another local minimum than the one for which the pair
    // was reported.
    if (contact.f >= 2 * state.tree.grow) contact = closestOfTubes(a, b, kExact);
    contact.i = pair.i;
    contact.j = pair.j;
    state.contacts[k] = contact;
  });
  return state.contacts;
}

std::span<const char> TubeDetector::moved() const { return state_->moved; }

TubeDetector::Statistics TubeDetector::statistics() const {
  Statistics sum;
  for (const Worker& worker : std::span(state_->workers.data(), state_->workersUsed)) {
    const Statistics& own = worker.narrow.statistics;
    sum.boxPairs += own.boxPairs;
    for (std::size_t level = 0; level < sum.pieces.size(); ++level) sum.pieces[level] += own.pieces[level];
    sum.searched += own.searched;
  }
  return sum;
}

std::size_t TubeDetector::treeBytes() const {
  return state_->tree.bytes() + state_->firstExcluded.size() * sizeof(std::uint32_t) +
         state_->excluded.size() * sizeof(ExcludedGroups);
}

}  // namespace vasa
