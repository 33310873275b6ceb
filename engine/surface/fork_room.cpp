#include "surface/fork_room.h"

#include <algorithm>
#include <vector>

// With l_i = before_i + after_i and o_i = Σ_{k<i} l_k, the starts x_i = y_i + o_i do not overlap exactly when
// y is monotone; the nearest monotone y to the wanted one is that of pool adjacent violators (Ayer et al.
// 1955), and clamping it keeps it nearest within bounds.
namespace vasa {
namespace {

struct Pool {
  double sum;
  std::size_t count;
  double mean() const { return sum / double(count); }
};

// Lets a gap's two neighbours grow into it.
void growInto(float gap, float& wantLow, float& wantHigh, float sliver) {
  const float want = wantLow + wantHigh;
  if (want >= gap - sliver) {
    const float scale = want > 0 ? gap / want : 0;
    wantLow = want > 0 ? wantLow * scale : gap / 2;
    wantHigh = gap - wantLow;
  }
}

}  // namespace

bool shareRoom(std::span<ForkRoom> rooms, float low, float high, float sliver) {
  double total = 0;
  for (const ForkRoom& room : rooms) total += double(room.before) + room.after;
  if (total > double(high) - low) return false;
  std::vector<Pool> pools;
  double offset = 0;
  for (const ForkRoom& room : rooms) {
    pools.push_back({double(room.centre) - room.before - offset, 1});
    offset += double(room.before) + room.after;
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      pools[pools.size() - 2].sum += pools.back().sum;
      pools[pools.size() - 2].count += pools.back().count;
      pools.pop_back();
    }
  }
  std::size_t i = 0;
  offset = 0;
  for (const Pool& pool : pools)
    for (std::size_t k = 0; k < pool.count; ++k, ++i) {
      ForkRoom& room = rooms[i];
      const double start = std::clamp(pool.mean(), double(low), double(high) - total) + offset;
      offset += double(room.before) + room.after;
      room.low = float(start);
      room.high = float(start + room.before + room.after);
      room.shift = float(start + room.before - room.centre);
      room.centre += room.shift;
    }
  for (std::size_t k = 0; k <= rooms.size(); ++k) {
    const float from = k > 0 ? rooms[k - 1].high : low, to = k < rooms.size() ? rooms[k].low : high;
    const float gap = std::max(to - from, 0.0f);
    float lower = k > 0 ? std::max(rooms[k - 1].want - rooms[k - 1].after, 0.0f) : 0;
    float upper = k < rooms.size() ? std::max(rooms[k].want - rooms[k].before, 0.0f) : 0;
    if (k > 0 && k < rooms.size()) {
      growInto(gap, lower, upper, sliver);
    } else {
      lower = std::min(lower, gap);
      upper = std::min(upper, gap);
      if (gap - lower - upper < sliver) (k > 0 ? lower : upper) = gap;
    }
    const float meeting = lower + upper >= gap ? from + lower : -1;
    if (k > 0) rooms[k - 1].high = k < rooms.size() || lower < gap ? from + lower : to;
    if (k < rooms.size())
      rooms[k].low = meeting >= 0 && k > 0 ? rooms[k - 1].high : (upper < gap ? to - upper : from);
  }
  return true;
}

}  // namespace vasa
