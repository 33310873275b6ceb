#include "make_human/grow.h"

#include <algorithm>
#include <cmath>

#include "core/hash.h"
#include "make_human/growing_tree.h"
#include "make_human/taper.h"

namespace vasa::human {
namespace {

constexpr float kReferenceSweeps = 4030;
constexpr float kGrowthStep = 0.0035f, kClearance = 0.35e-3f, kFromBone = 0.5e-3f,
                kFitTolerance = 0.25e-3f;                                          // [m] at the reference
constexpr float kHostCell = 0.016f, kObstacleCell = 0.010f, kLeastCell = 0.0015f;  // of grids of segments
constexpr int kCandidates = 8;  // places of which the emptiest is chosen, at first
constexpr int kRelaxations = 8;
constexpr int kFailuresToClose = 150;  // in a row: the region is full
constexpr float kFiner = 0.85f;        // times as thin is what grows where all regions are full
constexpr int kMostFiner = 4;          // times
constexpr int kFailuresToLowerSights =
    8;  // in a row: half as many candidates, and branches that stop on the way
constexpr float kShortenings[] = {1, 0.6f, 0.35f};
constexpr float kStemReserve = 2.3f;  // of a branch's radius over its tip's, for the branches to come
constexpr float kMuch = 0.9f, kLengthOfStemRadius = 55;
constexpr float kShareOfHost = 0.62f;
constexpr float kMostWinding = 1.6f;     // of a branch, over its ends' distance
constexpr float kLeastWinding = 1.025f;  // likewise; straighter ones look like hairs
constexpr float kFarthestMoved = 1.7f;   // of a branch's point from its middle, over what it was

/// Numbers in [0, 1) that depend on a seed and a counter only.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  float next() {
    const std::uint64_t counter = count_++;
    return float(hashOf(std::span(&counter, 1), seed_) >> 40) * 0x1p-24f;
  }
  /// Quasi-random, evenly spread from the first on.
  vec3 place(const Aabb& box) {
    const double n = double(++places_);
    const dvec3 step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    return box.low + box.extent() * vec3(glm::fract(n * step + 0.5));
  }

 private:
  std::uint64_t seed_, count_ = 0, places_ = 0;
};

struct RegionState {
  const Region* region;
  Dice dice;
  Aabb box;
  SegmentGrid leaders, companions;
  VesselKind leaderKind{}, companionKind{};
  float grown = 0;  // sweeps over share
  int failures = 0, leaderCount = 0, companionCount = 0;
};

}  // namespace

struct Grower::State {
 public:
  State(std::vector<LaidVessel>& vessels, const std::vector<Region>& regions, const Surroundings& around,
        const GrowOptions& options)
      : vessels_(vessels),
        around_(around),
        options_(options),
        scale_(std::min(1.0f, std::cbrt(kReferenceSweeps / float(options.sweeps)))),
        tree_(vessels, kGrowthStep * std::max(scale_, 0.4f), kClearance * scale_,
              std::max(kObstacleCell * scale_, kLeastCell)),
        laidCount_(vessels.size()) {
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const SegmentGrid hosts(std::max(kHostCell * scale_, kLeastCell));
      RegionState state{&regions[i], Dice(options.seed * 1000003 + i), regions[i].bounds(around), hosts,
                        hosts};
      for (int leader : regions[i].leaders) enter(state.leaders, leader);
      for (int companion : regions[i].companions) enter(state.companions, companion);
      state.leaderKind = vessels[std::size_t(regions[i].leaders.front())].label.kind;
      if (!regions[i].companions.empty())
        state.companionKind = vessels[std::size_t(regions[i].companions.front())].label.kind;
      states_.push_back(std::move(state));
    }
    for (const LaidVessel& vessel : vessels) sweeps_ += spanCount(vessel.points);
  }

  void run() {
    while (sweeps_ < options_.sweeps) {
      RegionState* poorest = nullptr;
      for (RegionState& state : states_)
        if (state.failures < kFailuresToClose && (!poorest || state.grown < poorest->grown)) poorest = &state;
      if (!poorest) {
        if (!goFiner()) break;
      } else if (!growIn(*poorest)) {
        ++poorest->failures;
      }
    }
    for (std::size_t i = laidCount_; i < vessels_.size(); ++i) setRadii(i);
  }

  bool remove(int vessel) {
    if (vessel < int(laidCount_) || tree_.vessels()[std::size_t(vessel)].removed) return false;
    tree_.remove(vessel);
    sweeps_ -= spanCount(vessels_[std::size_t(vessel)].points);
    for (int child : tree_.vessels()[std::size_t(vessel)].children) remove(child);
    return true;
  }

  std::vector<LaidVessel> finish() {
    std::vector<LaidVessel> kept;
    std::vector<int> numbers;
    for (std::size_t i = 0; i < vessels_.size(); ++i) {
      numbers.push_back(int(kept.size()));
      if (tree_.vessels()[i].removed) continue;
      kept.push_back(vessels_[i]);
      if (i >= laidCount_) kept.back().source.vessel = numbers[std::size_t(kept.back().source.vessel)];
    }
    return kept;
  }

 private:
  /// Opens full regions again, for thinner branches. False where that has been done often enough.
  bool goFiner() {
    if (finer_ == kMostFiner) return false;
    ++finer_;
    scale_ *= kFiner;
    for (RegionState& state : states_) state.failures = 0;
    return true;
  }

  void enter(SegmentGrid& grid, int vessel) {
    const GrowingTree::Vessel& v = tree_.vessels()[std::size_t(vessel)];
    for (std::size_t k = 0; k + 1 < v.branch.points.size(); ++k)
      grid.add({v.branch.points[k], v.branch.points[k + 1], v.radii[k], std::uint32_t(vessel), v.arcs[k]});
  }

  /// The emptiest of some places in the region that a branch can reach; of fewer, where the emptiest could
  /// not be.
  bool findTarget(RegionState& state, vec3& target) {
    float best = 0;
    int found = 0;
    const int candidates = std::max(1, kCandidates >> (state.failures / kFailuresToLowerSights));
    for (int tries = 0; found < candidates && tries < 40 * kCandidates; ++tries) {
      const vec3 p = state.dice.place(state.box);
      if (!state.region->contains(p, around_)) continue;
      ++found;
      if (around_.bones.at(p, state.region->tip + kFromBone)) continue;
      const float distance = state.leaders.nearest(p, 2 * state.region->reach).distance;
      const float worth = distance < state.region->reach ? distance : state.region->reach / 2;
      if (distance < 2 * state.region->reach && worth > best) best = worth, target = p;
    }
    return best > 0;
  }

  bool growIn(RegionState& state) {
    vec3 target{0};
    if (!findTarget(state, target)) return false;
    GrowingTree::Branch leader;
    if (!connect(state, state.leaders, target, leader)) return false;
    GrowingTree::Branch companion;
    const bool pair = !state.region->companions.empty();
    if (pair && !accompany(state, leader, companion)) return false;
    state.failures = 0;
    const auto keep = [&](GrowingTree::Branch branch, SegmentGrid& grid, VesselKind kind, int& count) {
      LaidVessel vessel;
      vessel.label = {state.region->name + " " + std::string(kindName(kind)) + " " + std::to_string(++count),
                      "", kind};
      vessel.source = {Attachment::Kind::side, branch.host,
                       branch.hostArc / tree_.vessels()[std::size_t(branch.host)].length()};
      vessel.points = fitted(branch.points, std::vector<float>(branch.points.size(), branch.tip));
      const float spans = float(spanCount(vessel.points));
      sweeps_ += std::uint32_t(spans);
      state.grown += spans / state.region->share;
      vessels_.push_back(std::move(vessel));
      const int number = tree_.add(std::move(branch));
      enter(grid, number);
    };
    keep(std::move(leader), state.leaders, state.leaderKind, state.leaderCount);
    if (pair) keep(std::move(companion), state.companions, state.companionKind, state.companionCount);
    return true;
  }

  /// A branch from the best near place of the leaders to the target, or towards it.
  bool connect(RegionState& state, const SegmentGrid& hosts, vec3 target, GrowingTree::Branch& branch) {
    struct Root {
      int host;
      float arc, cost;
      vec3 place;
    };
    std::vector<Root> roots;
    const float nearest = hosts.nearest(target, 2 * state.region->reach).distance;
    for (std::uint32_t number :
         hosts.near(target, target, std::min(1.3f * nearest + 0.004f * scale_, state.region->reach))) {
      const SegmentGrid::Segment& s = hosts.segments()[number];
      const float distance = glm::distance(target, s.a);
      if (distance > state.region->reach || distance < 3 * s.radius + 6 * kClearance * scale_) continue;
      // Blood does not turn back: a branch that leaves against the stream costs more.
      const float along = glm::dot(glm::normalize(target - s.a), glm::normalize(s.b - s.a));
      roots.push_back({int(s.owner), s.at, distance * (1.15f - 0.35f * along), s.a});
    }
    std::stable_sort(roots.begin(), roots.end(),
                     [](const Root& a, const Root& b) { return a.cost < b.cost; });
    const bool mayStop = state.failures >= kFailuresToLowerSights;
    int tries = 0;
    vec3 tried{0};
    for (const Root& root : roots) {
      const float length = glm::distance(target, root.place);
      if (tries > 0 && glm::distance(root.place, tried) < 0.1f * length) continue;
      if (!prepare(state, root.host, root.arc, length, branch)) continue;
      if (++tries > 4) break;
      tried = root.place;
      for (float part :
           mayStop ? std::span<const float>(kShortenings) : std::span<const float>(kShortenings, 1)) {
        branch.points = curveTo(root.host, root.arc, glm::mix(root.place, target, part), state.dice);
        if (settleBranch(state, branch)) return true;
      }
    }
    return false;
  }

  bool prepare(const RegionState& state, int host, float arc, float length, GrowingTree::Branch& branch) {
    branch.host = host;
    branch.hostArc = arc;
    branch.tip = state.region->tip * scale_;
    // Where much is to grow, long branches become stems.
    const float stem = scale_ < kMuch ? length / kLengthOfStemRadius : 0;
    branch.reserve =
        std::min(std::max(kStemReserve * branch.tip, stem), kShareOfHost * tree_.radiusAt(host, arc));
    return branch.reserve >= branch.tip && tree_.admits(host, arc, branch.reserve, branch.tip);
  }

  std::vector<vec3> curveTo(int host, float arc, vec3 target, Dice& dice) {
    const vec3 root = tree_.positionAt(host, arc), along = tree_.tangentAt(host, arc);
    const float length = glm::distance(root, target);
    const vec3 direct = (target - root) / length;
    vec3 aside = direct - glm::dot(direct, along) * along;
    aside = glm::length(aside) > 0.05f ? glm::normalize(aside) : anyPerpendicular(along);
    const vec3 leaving = glm::normalize(0.55f * along + 0.85f * aside);
    // One after the other, as the order of calls among arguments is a compiler's own.
    const float z = dice.next(), y = dice.next(), x = dice.next();
    const vec3 wobble = vec3(x, y, z) - 0.5f;
    const vec3 arriving = glm::normalize(direct + 0.6f * wobble);
    const vec3 b1 = root + 0.36f * length * leaving, b2 = target - 0.36f * length * arriving;
    const int steps = std::max(4, int(std::ceil(length / (kGrowthStep * scale_))));
    const float phase = 2 * kPi * dice.next(), waves = 0.4f + dice.next();
    const vec3 across = anyPerpendicular(direct), up = glm::cross(direct, across);
    std::vector<vec3> points;
    for (int k = 0; k <= steps; ++k) {
      const float t = float(k) / float(steps), s = 1 - t;
      const float swing = 0.45f * length * t * t * s * std::sin(2 * kPi * waves * t + phase);
      points.push_back(s * s * s * root + 3 * s * s * t * b1 + 3 * s * t * t * b2 + t * t * t * target +
                       swing * (std::cos(phase) * across + std::sin(phase) * up));
    }
    return points;
  }

  /// How far a branch has to keep from what may be near it.
  struct Limits {
    float fromBone, fromHeart, depth;  ///< [m]; 0: it is nowhere near
  };

  Limits limitsOf(const RegionState& state, const GrowingTree::Branch& branch) const {
    const vec3 middle = 0.5f * (branch.points.front() + branch.points.back());
    float reach = 0;
    for (vec3 p : branch.points) reach = std::max(reach, glm::distance(p, middle));
    reach *= kFarthestMoved;
    Limits limits{
        branch.reserve + kFromBone * scale_, branch.reserve + 0.2e-3f * scale_,
        std::max(state.region->organ ? 0 : state.region->leastDepth, branch.reserve + 1e-3f * scale_)};
    if (!around_.bones.at(middle, reach + 1.3f * limits.fromBone)) limits.fromBone = 0;
    if (!around_.heart.at(middle, reach + 1.3f * limits.fromHeart)) limits.fromHeart = 0;
    if (around_.depth(middle) > 2 * (reach + limits.depth)) limits.depth = 0;
    return limits;
  }

  /// Moves a branch's points off what they touch; whether it is then free everywhere.
  bool settleBranch(const RegionState& state, GrowingTree::Branch& branch) {
    const Limits limits = limitsOf(state, branch);
    std::vector<vec3>& points = branch.points;
    std::vector<vec3> moves(points.size());
    for (int round = 0; round < kRelaxations; ++round) {
      float arc = 0, largest = 0;
      for (std::size_t k = 1; k < points.size(); ++k) {
        arc += glm::distance(points[k], points[k - 1]);
        vec3 move = tree_.push(branch, k, arc) + state.region->back(points[k], branch.reserve, around_);
        for (const auto& [solid, need] :
             {std::pair(&around_.bones, limits.fromBone), std::pair(&around_.heart, limits.fromHeart)})
          if (need > 0)
            if (const auto place = solid->at(points[k], 1.3f * need))
              if (place->distance < 1.2f * need) move += (1.2f * need - place->distance) * place->outwards;
        if (limits.depth > 0)
          if (const float below = around_.depth(points[k]); below < 1.1f * limits.depth)
            move -= (1.1f * limits.depth - below) * glm::normalize(around_.skin.gradient(points[k]));
        moves[k] = move;
        largest = std::max(largest, glm::length(move));
      }
      if (largest < 0.05e-3f * scale_) break;
      moves[0] = vec3(0);
      for (int smoothing = 0; smoothing < 2; ++smoothing)
        for (std::size_t k = 1; k + 1 < points.size(); ++k)
          moves[k] = 0.5f * moves[k] + 0.25f * (moves[k - 1] + moves[k + 1]);
      for (std::size_t k = 1; k < points.size(); ++k) points[k] += moves[k];
      for (std::size_t k = 1; k + 1 < points.size(); ++k)
        points[k] = 0.7f * points[k] + 0.15f * (points[k - 1] + points[k + 1]);
    }
    return isFree(branch, limits);
  }

  bool isFree(const GrowingTree::Branch& branch, const Limits& limits) const {
    const std::vector<vec3>& points = branch.points;
    float length = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const float step = glm::distance(points[k], points[k - 1]);
      if (step < 0.2f * kGrowthStep * scale_) return false;
      length += step;
      if (k + 1 < points.size() &&
          glm::dot(points[k + 1] - points[k], points[k] - points[k - 1]) < 0.5f * step * step)
        return false;  // folded up against something
    }
    const float straight = glm::distance(points.front(), points.back());
    if (length > kMostWinding * straight || length < kLeastWinding * straight || straight < 8 * branch.tip)
      return false;
    for (std::size_t k = 1; k < points.size(); ++k) {
      for (const auto& [solid, need] :
           {std::pair(&around_.bones, limits.fromBone), std::pair(&around_.heart, limits.fromHeart)})
        if (need > 0)
          if (const auto place = solid->at(points[k], need); place && place->distance < need) return false;
      if (limits.depth > 0 && around_.depth(points[k]) < limits.depth) return false;
    }
    return tree_.obstacleOf(branch) < 0;
  }

  /// A companion to a leader's branch, from the nearest companion host.
  bool accompany(RegionState& state, const GrowingTree::Branch& leader, GrowingTree::Branch& companion) {
    const vec3 root = leader.points.front();
    struct Root {
      int host;
      float arc, distance;
    };
    std::vector<Root> roots;
    for (std::uint32_t number : state.companions.near(root, root, 0.5f * state.region->reach)) {
      const SegmentGrid::Segment& s = state.companions.segments()[number];
      roots.push_back({int(s.owner), s.at, glm::distance(root, s.a)});
    }
    std::stable_sort(roots.begin(), roots.end(),
                     [](const Root& a, const Root& b) { return a.distance < b.distance; });
    int tries = 0;
    for (const Root& from : roots) {
      if (!prepare(state, from.host, from.arc, glm::distance(root, leader.points.back()), companion))
        continue;
      if (++tries > 3) break;
      for (int turn = 0; turn < 4; ++turn) {
        companion.points = beside(leader, companion, 0.5f * kPi * float(turn));
        if (settleBranch(state, companion) && clearOf(leader, companion)) return true;
      }
    }
    return false;
  }

  /// From the companion's root over to the leader's side, then along with it.
  std::vector<vec3> beside(const GrowingTree::Branch& leader, const GrowingTree::Branch& companion,
                           float turn) {
    const std::vector<vec3>& way = leader.points;
    const vec3 root = tree_.positionAt(companion.host, companion.hostArc);
    const float offset = leader.reserve + companion.reserve + 2.2f * kClearance * scale_;
    vec3 tangent = glm::normalize(way[1] - way[0]);
    vec3 aside = anyPerpendicular(tangent);
    aside = std::cos(turn) * aside + std::sin(turn) * glm::cross(tangent, aside);
    const float over = std::min(0.6f, (1.2f * glm::distance(root, way.front()) + 0.004f * scale_) /
                                          std::max(glm::distance(way.front(), way.back()), 1e-4f));
    std::vector<vec3> points;
    for (std::size_t k = 0; k < way.size(); ++k) {
      tangent = glm::normalize(way[std::min(k + 1, way.size() - 1)] - way[k > 0 ? k - 1 : 0]);
      aside = glm::normalize(aside - glm::dot(aside, tangent) * tangent);
      const float t = std::min(float(k) / float(way.size() - 1) / over, 1.0f);
      points.push_back(
          glm::mix(root + (way[k] - way.front()) * 0.5f, way[k] + offset * aside, t * t * (3 - 2 * t)));
    }
    points.front() = root;
    return points;
  }

  bool clearOf(const GrowingTree::Branch& a, const GrowingTree::Branch& b) const {
    SegmentGrid grid(0.010f);
    for (std::size_t k = 0; k + 1 < a.points.size(); ++k)
      grid.add({a.points[k], a.points[k + 1], a.reserve, 0, 0});
    const float need = a.reserve + b.reserve + tree_.clearance();
    for (vec3 p : b.points)
      if (grid.nearest(p, need).segment != kNone) return false;
    return true;
  }

  std::vector<vec4> fitted(const std::vector<vec3>& points, const std::vector<float>& radii) const {
    const std::size_t n = points.size();
    return fitCourse(points, radii, glm::normalize(points[1] - points[0]),
                     glm::normalize(points[n - 1] - points[n - 2]), kFitTolerance * scale_);
  }

  void setRadii(std::size_t number) {
    const GrowingTree::Vessel& vessel = tree_.vessels()[number];
    if (vessel.removed) return;
    std::vector<vec4>& points = vessels_[number].points;
    sweeps_ -= spanCount(points);
    std::vector<float> radii = tree_.murrayRadii(int(number));
    float lastFork = 0;
    for (std::size_t i = 0; i < vessel.forks.size(); ++i)
      if (!tree_.vessels()[std::size_t(vessel.children[i])].removed)
        lastFork = std::max(lastFork, vessel.forks[i]);
    thinOut(radii, vessel.length(), vessel.length() - lastFork);
    points = fitted(vessel.branch.points, radii);
    sweeps_ += spanCount(points);
  }

  std::vector<LaidVessel>& vessels_;
  const Surroundings& around_;
  const GrowOptions options_;
  float scale_;  // of lengths, against the reference
  int finer_ = 0;
  GrowingTree tree_;
  std::vector<RegionState> states_;
  std::size_t laidCount_;
  std::uint32_t sweeps_ = 0;
};

Grower::Grower(std::vector<LaidVessel>& vessels, const std::vector<Region>& regions,
               const Surroundings& around, const GrowOptions& options)
    : state_(std::make_unique<State>(vessels, regions, around, options)) {}
Grower::~Grower() = default;

void Grower::run() { state_->run(); }

bool Grower::remove(int vessel) { return state_->remove(vessel); }

std::vector<LaidVessel> Grower::finish() { return state_->finish(); }

}  // namespace vasa::human
