#include "plate/label_layout.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace vasa::plate {
namespace {

constexpr int kSplits = 9;            // upright lines that are tried
constexpr float kSplitReach = 0.35f;  // of the figure's half width, to either side of its middle
constexpr float kSteepCost = 1.5f;    // a line's way up or down, by its way across
constexpr int kAnchorRounds = 3;      // texts move, then lines look for better anchors, so many times
constexpr float kDropCost = 3;        // widths between the columns that leaving out a label is worth
constexpr float kCrowdCost = 0.5f;    // widths that a place in a full stretch of a column is dearer
constexpr float kCrowdReach = 0.08f;  // of the column's height, to either side: such a stretch
constexpr float kFullCost = 0.6f;     // widths that the last place of a column is dearer than the first

struct Entry {
  std::uint32_t label;
  float height;
  vec2 anchor, port;
};

float cross(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

float distanceToLine(vec2 p, vec2 a, vec2 b) {
  const vec2 way = b - a;
  const float square = glm::dot(way, way);
  const float t = square > 0 ? std::clamp(glm::dot(p - a, way) / square, 0.0f, 1.0f) : 0;
  return glm::distance(p, a + t * way);
}

// Of a wish's anchors on one side of the cut, the one with the shortest way to that side's column; earlier
// ones, which are better, may be a little farther.
const vec2* anchorBeside(const LabelWish& wish, bool right, float cut, const LabelColumns& columns,
                         float* cost) {
  const float dearer = 0.02f * (columns.right - columns.left);
  const vec2* best = nullptr;
  *cost = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < wish.anchors.size(); ++k) {
    const vec2& anchor = wish.anchors[k];
    if (right ? anchor.x < cut : anchor.x > cut) continue;
    const float way = (right ? columns.right - anchor.x : anchor.x - columns.left) + dearer * float(k);
    if (way < *cost) *cost = way, best = &anchor;
  }
  return best;
}

struct Division {
  std::vector<std::uint32_t> sides[2];
  std::vector<vec2> heights[2];  // of the anchors, and what their texts take
  std::vector<std::uint32_t> dropped;
};

// How full of texts a column is around a height.
float crowding(std::span<const vec2> taken, float height, float reach) {
  float sum = 0;
  for (const vec2& other : taken)
    if (std::abs(other.x - height) < reach) sum += other.y;
  return sum / (2 * reach);
}

Division divide(std::span<const LabelWish> wishes, const LabelColumns& columns, float cut) {
  Division division;
  const float height = columns.bottom - columns.top;
  float room[2] = {height + columns.gap, height + columns.gap};
  const float whole = room[0];
  for (std::uint32_t i = 0; i < wishes.size(); ++i) {
    float cost[2];
    bool may[2];
    const vec2* anchors[2];
    const float need = wishes[i].size.y + columns.gap;
    for (int side = 0; side < 2; ++side) {
      anchors[side] = anchorBeside(wishes[i], side == 1, cut, columns, &cost[side]);
      may[side] = anchors[side] && room[side] >= need;
      if (may[side])
        cost[side] += kCrowdCost * (columns.right - columns.left) *
                      crowding(division.heights[side], anchors[side]->y, kCrowdReach * height);
      // A column that fills up is the dearer one, so that both fill alike.
      cost[side] += kFullCost * (columns.right - columns.left) * (1 - room[side] / whole);
    }
    if (!may[0] && !may[1]) {
      division.dropped.push_back(i);
      continue;
    }
    const int side = !may[0] || (may[1] && cost[1] < cost[0]);
    division.sides[side].push_back(i);
    division.heights[side].push_back({anchors[side]->y, need});
    room[side] -= need;
  }
  return division;
}

class Column {
 public:
  Column(std::span<const LabelWish> wishes, const LabelColumns& columns, bool right, float cut,
         std::span<const std::uint32_t> labels)
      : wishes_(wishes), columns_(columns), right_(right), cut_(cut) {
    for (const std::uint32_t label : labels) {
      float unused;
      const vec2* anchor = anchorBeside(wishes[label], right, cut, columns, &unused);
      entries_.push_back(
          {label, wishes[label].size.y, *anchor, vec2(right ? columns.right : columns.left, 0)});
    }
    std::ranges::stable_sort(entries_, {}, [](const Entry& e) { return e.anchor.y; });
  }

  void arrange() {
    setTexts();
    uncross();
    for (int round = 0; round < kAnchorRounds; ++round) {
      chooseAnchors();
      setTexts();
      uncross();
    }
  }

  // What still crosses where no order was found for it: the later wish gives way.
  void dropCrossing(std::vector<std::uint32_t>& dropped) {
    for (auto pair = firstCrossing(); pair.first < entries_.size(); pair = firstCrossing()) {
      const std::size_t gone =
          entries_[pair.first].label > entries_[pair.second].label ? pair.first : pair.second;
      dropped.push_back(entries_[gone].label);
      entries_.erase(entries_.begin() + std::ptrdiff_t(gone));
    }
  }

  float cost() const {
    float sum = 0;
    for (const Entry& e : entries_)
      sum += std::abs(e.port.x - e.anchor.x) + kSteepCost * std::abs(e.port.y - e.anchor.y);
    return sum;
  }

  void append(std::vector<PlacedLabel>& placed) const {
    for (const Entry& e : entries_) placed.push_back({e.label, right_, e.port, e.anchor});
  }

 private:
  void setTexts() {
    std::vector<float> wished, heights;
    for (const Entry& e : entries_) wished.push_back(e.anchor.y), heights.push_back(e.height);
    const auto centres = spreadOut(wished, heights, columns_.gap, columns_.top, columns_.bottom);
    for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i].port.y = centres[i];
  }

  std::pair<std::size_t, std::size_t> firstCrossing() const {
    for (std::size_t i = 0; i < entries_.size(); ++i)
      for (std::size_t j = i + 1; j < entries_.size(); ++j)
        if (linesCross(entries_[i].port, entries_[i].anchor, entries_[j].port, entries_[j].anchor))
          return {i, j};
    return {entries_.size(), 0};
  }

  void uncross() {
    // Where texts are of one height an exchange leaves all other lines alone and shortens these two, which
    // ends. Where they are not it might go round, so the number of rounds has an end, too.
    const std::size_t most = 4 * entries_.size() * entries_.size();
    for (std::size_t round = 0; round < most; ++round) {
      const auto [i, j] = firstCrossing();
      if (i == entries_.size()) return;
      std::swap(entries_[i], entries_[j]);
      setInOrder();
    }
  }

  // Texts keep their order and the middle of their stack moves as little as can be.
  void setInOrder() {
    std::vector<float> wished, heights;
    for (const Entry& e : entries_) wished.push_back(e.port.y), heights.push_back(e.height);
    std::ranges::sort(wished);
    const auto centres = spreadOut(wished, heights, columns_.gap, columns_.top, columns_.bottom);
    for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i].port.y = centres[i];
  }

  // A better anchor for each line in turn: short, flat, away from others' anchors, crossing no line.
  void chooseAnchors() {
    for (Entry& e : entries_) {
      float least = std::numeric_limits<float>::infinity();
      vec2 best = e.anchor;
      const auto& anchors = wishes_[e.label].anchors;
      for (std::size_t k = 0; k < anchors.size(); ++k) {
        if (right_ ? anchors[k].x < cut_ : anchors[k].x > cut_) continue;
        const float cost = costOf(e, anchors[k], k);
        if (cost < least) least = cost, best = anchors[k];
      }
      if (least < std::numeric_limits<float>::infinity()) e.anchor = best;
    }
  }

  float costOf(const Entry& e, vec2 anchor, std::size_t rank) const {
    const float width = columns_.right - columns_.left;
    float cost =
        std::abs(e.port.x - anchor.x) + 1.5f * std::abs(e.port.y - anchor.y) + 0.02f * width * float(rank);
    for (const Entry& other : entries_) {
      if (&other == &e) continue;
      if (linesCross(e.port, anchor, other.port, other.anchor)) return std::numeric_limits<float>::infinity();
      if (distanceToLine(other.anchor, e.port, anchor) < columns_.clearance ||
          distanceToLine(anchor, other.port, other.anchor) < columns_.clearance)
        cost += 0.3f * width;
    }
    return cost;
  }

  std::span<const LabelWish> wishes_;
  const LabelColumns& columns_;
  bool right_;
  float cut_;
  std::vector<Entry> entries_;
};

}  // namespace

bool linesCross(vec2 a, vec2 b, vec2 c, vec2 d) {
  const float c1 = cross(b - a, c - a), d1 = cross(b - a, d - a);
  const float a1 = cross(d - c, a - c), b1 = cross(d - c, b - c);
  if (c1 == 0 && d1 == 0) {  // on one line: by their boxes
    const auto apart = [](float p, float q, float r, float s) {
      return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
    };
    return !apart(a.x, b.x, c.x, d.x) && !apart(a.y, b.y, c.y, d.y);
  }
  return c1 * d1 <= 0 && a1 * b1 <= 0;
}

std::vector<float> spreadOut(std::span<const float> wished, std::span<const float> lengths, float gap,
                             float low, float high) {
  assert(wished.size() == lengths.size());
  // Taken from each wish what lies before it in the stack, the wishes have to ascend: isotonic regression,
  // pooled from the left, then held within the ends.
  struct Pool {
    double sum;
    std::size_t count;
    double mean() const { return sum / double(count); }
  };
  std::vector<Pool> pools;
  std::vector<double> before(wished.size());
  double stack = 0;
  for (std::size_t i = 0; i < wished.size(); ++i) {
    before[i] = stack + 0.5 * lengths[i];
    stack += lengths[i] + gap;
    pools.push_back({wished[i] - before[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  const double most = std::max<double>(low, double(high) - (stack - gap));
  std::vector<float> centres;
  for (const Pool& pool : pools)
    for (std::size_t k = 0; k < pool.count; ++k)
      centres.push_back(float(std::clamp(pool.mean(), double(low), most) + before[centres.size()]));
  return centres;
}

namespace {

struct Attempt {
  LabelLayout layout;
  float cost = 0;
};

Attempt layOut(std::span<const LabelWish> wishes, const LabelColumns& columns, float cut) {
  const Division division = divide(wishes, columns, cut);
  Attempt attempt{{{}, division.dropped}, 0};
  for (const bool right : {false, true}) {
    Column column(wishes, columns, right, cut, division.sides[right]);
    column.arrange();
    column.dropCrossing(attempt.layout.dropped);
    column.append(attempt.layout.placed);
    attempt.cost += column.cost();
  }
  attempt.cost += kDropCost * (columns.right - columns.left) * float(attempt.layout.dropped.size());
  std::ranges::sort(attempt.layout.dropped);
  return attempt;
}

}  // namespace

LabelLayout layOutLabels(std::span<const LabelWish> wishes, const LabelColumns& columns) {
  assert(columns.left < columns.right);
  const float middle = 0.5f * (columns.left + columns.right), half = 0.5f * (columns.right - columns.left);
  Attempt best;
  for (int k = 0; k < kSplits; ++k) {
    // From the middle outwards, so that of equal ones the middle is taken.
    const float step = float((k + 1) / 2) / float(kSplits / 2) * (k % 2 ? 1.0f : -1.0f);
    Attempt attempt = layOut(wishes, columns, middle + kSplitReach * half * step);
    if (k == 0 || attempt.cost < best.cost) best = std::move(attempt);
  }
  return std::move(best.layout);
}

}  // namespace vasa::plate
