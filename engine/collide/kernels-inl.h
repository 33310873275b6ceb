// Included once for each instruction set (no include guard: see kernels.cpp).
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vasa::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F8 = hn::CappedTag<float, kGroup>;
using FN = hn::CappedTag<float, 16>;
using S8 = hn::CappedTag<std::int16_t, kGroup>;
constexpr float kEpsilon = 1.1920929e-7f;
// A computed squared distance may exceed the true minimum by rounding errors of the squared lengths
// (math/segment_distance.h); a computed reach may be short by a few of its own.
constexpr float kDistanceSlack = 32 * kEpsilon;
constexpr float kReachSlack = 1 + 16 * kEpsilon;

template <class V>
struct Vec3 {
  V x, y, z;
};
template <class V>
HWY_INLINE Vec3<V> operator-(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec3<V> operator+(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec3<V> scaled(const Vec3<V>& a, V k) {
  return {hn::Mul(a.x, k), hn::Mul(a.y, k), hn::Mul(a.z, k)};
}
template <class V>
HWY_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V clampUnit(D d, V v) {
  return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0f));
}

template <class V>
struct Nearest {
  V s, t;
  V squared;  // of the distance at s, t
  V slack;    // the true minimum is no less than squared - slack
};

// Segments w + s u and t v. Coordinate descent from the inner stationary point: exact where that is well
// conditioned or the segments are parallel, and within the slack in between.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Nearest<V> nearestOnSegments(D d, const Vec3<V>& w, const Vec3<V>& u, const Vec3<V>& v) {
  const V tiny = hn::Set(d, 1e-37f);
  const V uu = hn::Max(dot(u, u), tiny), vv = hn::Max(dot(v, v), tiny), uv = dot(u, v), uw = dot(u, w),
          vw = dot(v, w);
  const V one = hn::Set(d, 1.0f);
  const V perU = hn::Div(one, uu), perV = hn::Div(one, vv);
  // Divided by uu vv, so that nothing overflows or vanishes for very large or small tubes.
  const V cosine2 = hn::Mul(hn::Mul(uv, perU), hn::Mul(uv, perV));
  const V determinant = hn::Max(hn::Sub(one, cosine2), hn::Set(d, kEpsilon));
  const V numerator = hn::Sub(hn::Mul(hn::Mul(uv, perU), hn::Mul(vw, perV)), hn::Mul(uw, perU));
  V s = clampUnit(d, hn::Div(numerator, determinant));
  const V t = clampUnit(d, hn::Mul(hn::MulAdd(s, uv, vw), perV));
  s = clampUnit(d, hn::Mul(hn::MulSub(t, uv, uw), perU));
  const Vec3<V> gap = {hn::NegMulAdd(t, v.x, hn::MulAdd(s, u.x, w.x)),
                       hn::NegMulAdd(t, v.y, hn::MulAdd(s, u.y, w.y)),
                       hn::NegMulAdd(t, v.z, hn::MulAdd(s, u.z, w.z))};
  const V slack = hn::Mul(hn::Set(d, kDistanceSlack), hn::Add(hn::Add(uu, vv), dot(w, w)));
  return {s, t, dot(gap, gap), slack};
}

template <class V>
struct TubeLanes {
  Vec3<V> p[4];
  V r[4];
};

// A lane for each of the tubes whose first floats lie at `at`, radii grown.
template <class D, class VI, class V = hn::Vec<D>>
HWY_INLINE TubeLanes<V> gatherTubes(D d, const BoxTreeView& tree, VI at) {
  static_assert(sizeof(Bezier) == 16 * sizeof(float));
  const float* base = reinterpret_cast<const float*>(tree.tubes);
  const V grow = hn::Set(d, tree.grow);
  TubeLanes<V> tube;
  for (int k = 0; k < 4; ++k) {
    const float* point = base + 4 * k;
    tube.p[k] = {hn::GatherIndex(d, point, at), hn::GatherIndex(d, point + 1, at),
                 hn::GatherIndex(d, point + 2, at)};
    tube.r[k] = hn::Add(hn::GatherIndex(d, point + 3, at), grow);
  }
  return tube;
}

// Radius of a capsule around the chord that holds the tube: largest radius and deviation from the chord.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V capsuleRadius(D d, const TubeLanes<V>& tube, const Vec3<V>& chord) {
  const V radius = hn::Max(hn::Max(tube.r[0], tube.r[1]), hn::Max(tube.r[2], tube.r[3]));
  const Vec3<V> third = scaled(chord, hn::Set(d, 1.0f / 3));
  const Vec3<V> x1 = tube.p[1] - tube.p[0] - third, x2 = tube.p[2] - tube.p[3] + third;
  const V deviation = hn::Mul(hn::Set(d, 0.75f), hn::Sqrt(hn::Max(dot(x1, x1), dot(x2, x2))));
  return hn::Mul(hn::Add(radius, deviation), hn::Set(d, kReachSlack));
}

// ---- refit

template <class V>
HWY_INLINE V largestCoordinate(const Vec3<V>& p) {
  return hn::Max(hn::Abs(p.x), hn::Max(hn::Abs(p.y), hn::Abs(p.z)));
}

// Steps of BoxGrid along one axis, and `more`.
template <class V>
HWY_INLINE void storeSteps(F8 d, const BoxGrid& grid, int axis, V v, int more, std::int16_t* to) {
  const hn::Rebind<std::int16_t, F8> narrow;
  const hn::RebindToSigned<F8> whole;
  const V most = hn::Set(d, float(BoxGrid::kMost));
  const V steps = hn::Mul(hn::Sub(v, hn::Set(d, grid.middle[axis])), hn::Set(d, grid.stepsPerMetre[axis]));
  const V held = hn::Max(hn::Neg(most), hn::Min(steps, most));
  hn::Store(hn::DemoteTo(narrow, hn::Add(hn::ConvertTo(whole, held), hn::Set(whole, more))), narrow, to);
}

HWY_INLINE void fitLanes(const BoxTreeView& tree, BoxGroup& box, std::uint32_t lane) {
  const F8 d;
  const hn::RebindToSigned<F8> di;
  using V = hn::Vec<F8>;
  const auto tubes = hn::Load(di, reinterpret_cast<const std::int32_t*>(box.tubes) + lane);
  const TubeLanes<V> tube = gatherTubes(d, tree, hn::ShiftLeft<4>(tubes));
  const Vec3<V>* p = tube.p;
  const V reach = capsuleRadius(d, tube, p[3] - p[0]);
  const V size = hn::Max(largestCoordinate(p[0]), largestCoordinate(p[3]));
  const V rounding = hn::Mul(hn::Set(d, 2 * kEpsilon), hn::Add(size, reach));
  // Two boxes hold the tube: the hull's and the capsule's. Their intersection does too.
  const auto fitAxis = [&](int axis, V Vec3<V>::*at) HWY_ATTR {
    V low = hn::Sub(p[0].*at, tube.r[0]), high = hn::Add(p[0].*at, tube.r[0]);
    for (int k = 1; k < 4; ++k) {
      low = hn::Min(low, hn::Sub(p[k].*at, tube.r[k]));
      high = hn::Max(high, hn::Add(p[k].*at, tube.r[k]));
    }
    low = hn::Max(low, hn::Sub(hn::Min(p[0].*at, p[3].*at), reach));
    high = hn::Min(high, hn::Add(hn::Max(p[0].*at, p[3].*at), reach));
    storeSteps(d, tree.grid, axis, hn::Sub(low, rounding), 0, &box.low[axis][lane]);
    storeSteps(d, tree.grid, axis, hn::Add(high, rounding), 1, &box.high[axis][lane]);
  };
  fitAxis(0, &Vec3<V>::x);
  fitAxis(1, &Vec3<V>::y);
  fitAxis(2, &Vec3<V>::z);
}

HWY_INLINE void emptyLane(BoxGroup& box, std::uint32_t lane) {
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis][lane] = BoxGrid::kMost + 1;
    box.high[axis][lane] = -BoxGrid::kMost - 2;
  }
}

void fitLeaves(const BoxTreeView& tree, std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kAhead = 3;
  for (std::uint32_t group = begin; group < end; ++group) {
    // In the caller's order a group's tubes lie anywhere: ask for those of later groups now.
    if (group + kAhead < end)
      for (const std::uint32_t tube : tree.boxes[group + kAhead].tubes) hwy::Prefetch(tree.tubes + tube);
    for (std::uint32_t lane = 0; lane < kGroup; lane += std::uint32_t(hn::Lanes(F8())))
      fitLanes(tree, tree.boxes[group], lane);
  }
  if (begin < end)
    for (std::uint32_t slot = tree.tubeCount; slot < end * kGroup; ++slot)
      emptyLane(tree.boxes[slot / kGroup], slot % kGroup);
}

void fitLevel(const BoxTreeView& tree, std::uint32_t level, std::uint32_t begin, std::uint32_t end) {
  const S8 d;
  const BoxGroup* children = &tree.boxes[tree.levelStart[level - 1]];
  const std::uint32_t childCount = tree.levelStart[level] - tree.levelStart[level - 1];
  for (std::uint32_t group = begin; group < end; ++group) {
    BoxGroup& box = tree.boxes[tree.levelStart[level] + group];
    for (std::uint32_t lane = 0; lane < kGroup; ++lane) {
      const std::uint32_t child = group * kGroup + lane;
      if (child >= childCount) {
        emptyLane(box, lane);
        continue;
      }
      for (int axis = 0; axis < 3; ++axis) {
        auto low = hn::Load(d, children[child].low[axis]);
        auto high = hn::Load(d, children[child].high[axis]);
        for (std::size_t k = hn::Lanes(d); k < kGroup; k += hn::Lanes(d)) {
          low = hn::Min(low, hn::Load(d, children[child].low[axis] + k));
          high = hn::Max(high, hn::Load(d, children[child].high[axis] + k));
        }
        box.low[axis][lane] = hn::GetLane(hn::MinOfLanes(d, low));
        box.high[axis][lane] = hn::GetLane(hn::MaxOfLanes(d, high));
      }
    }
  }
}

// ---- traversal

template <class D, class M>
HWY_INLINE std::uint32_t bitsOf(D d, M mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0] | std::uint32_t(bits[1]) << 8;
}

// Which lanes of a and b have boxes that meet. No branches: all 64 pairs are tested.
HWY_INLINE LanePairs overlaps(const BoxGroup& a, const BoxGroup& b) {
#if HWY_TARGET == HWY_SCALAR
  LanePairs pairs = 0;
  for (std::size_t i = 0; i < kGroup; ++i)
    for (std::size_t j = 0; j < kGroup; ++j) {
      bool meet = true;
      for (int axis = 0; axis < 3; ++axis)
        meet &= a.low[axis][i] < b.high[axis][j] && b.low[axis][j] < a.high[axis][i];
      pairs |= LanePairs(meet) << (i * kGroup + j);
    }
  return pairs;
#else
  // Blocks of eight lanes: each holds one box of a against all of b.
  const hn::CappedTag<std::int16_t, 32> d;
  const hn::Repartition<std::uint8_t, decltype(d)> bytes;
  const std::size_t rowsAtOnce = hn::Lanes(d) / kGroup;
  const auto place = hn::Iota(bytes, 0);
  // Of a's lanes, the bytes of the one that each block is to hold.
  auto own =
      hn::Or(hn::And(hn::ShiftRight<3>(place), hn::Set(bytes, 0xfe)), hn::And(place, hn::Set(bytes, 1)));
  std::uint8_t rows[kGroup + 8];
  for (std::size_t i = 0; i < kGroup; i += rowsAtOnce) {
    const auto meet = [&](int axis) HWY_ATTR {
      const auto low = hn::TableLookupBytes(hn::LoadDup128(d, a.low[axis]), hn::BitCast(d, own)),
                 high = hn::TableLookupBytes(hn::LoadDup128(d, a.high[axis]), hn::BitCast(d, own));
      return hn::And(hn::Lt(low, hn::LoadDup128(d, b.high[axis])),
                     hn::Lt(hn::LoadDup128(d, b.low[axis]), high));
    };
    hn::StoreMaskBits(d, hn::And(meet(0), hn::And(meet(1), meet(2))), rows + i);
    own = hn::Add(own, hn::Set(bytes, std::uint8_t(2 * rowsAtOnce)));
  }
  LanePairs pairs;
  hwy::CopyBytes<8>(rows, &pairs);
  return pairs;
#endif
}

// Of a group against itself: each pair once.
constexpr LanePairs kUpper = 0x80c0e0f0f8fcfeull;          // q > p
constexpr LanePairs kUpperOrSelf = 0x80c0e0f0f8fcfeffull;  // q >= p

// Pairs of which one has moved, or both. @param a, b  BoxTreeView::moved
HWY_INLINE LanePairs movedPairs(std::uint8_t a, std::uint8_t b) {
  constexpr LanePairs kOnes = 0x0101010101010101ull, kDiagonal = 0x8040201008040201ull;
  // Bit p of a, alone in byte p, to all bits of that byte.
  const LanePairs own = ((a * kOnes & kDiagonal) + 0x7f * kOnes) >> 7 & kOnes;
  return own * 0xff | b * kOnes;
}

// The pairs of children whose boxes meet. @param out  room for kGroupPairs
HWY_INLINE std::size_t openPair(const BoxTreeView& tree, const GroupPair& pair, GroupPair* out) {
  const std::uint32_t first = tree.levelStart[pair.level];
  LanePairs pairs = overlaps(tree.boxes[first + pair.a], tree.boxes[first + pair.b]) &
                    movedPairs(tree.moved[first + pair.a], tree.moved[first + pair.b]);
  if (pair.a == pair.b) pairs &= kUpperOrSelf;
  std::size_t count = 0;
  for (; pairs; pairs &= pairs - 1) {
    const std::uint32_t bit = std::uint32_t(__builtin_ctzll(pairs));
    out[count++] = {pair.level - 1, pair.a * kGroup + bit / kGroup, pair.b * kGroup + bit % kGroup};
  }
  return count;
}

void openNode(Traversal& work) {
  const GroupPair top = work.stack[--work.stackSize];
  work.stackSize += openPair(work.tree, top, work.stack + work.stackSize);
}

// Takes pairs off the stack down to the leaves. @param leaves  room for kLeafBatch + kGroupPairs
HWY_INLINE std::size_t findLeaves(Traversal& work, GroupPair* leaves) {
  std::size_t count = 0;
  while (work.stackSize > 0 && count < kLeafBatch) {
    const GroupPair top = work.stack[--work.stackSize];
    if (top.level > 1) {
      work.stackSize += openPair(work.tree, top, work.stack + work.stackSize);
    } else if (top.level == 1) {
      count += openPair(work.tree, top, leaves + count);
    } else {
      leaves[count++] = top;
    }
  }
  return count;
}

HWY_INLINE LanePairs excludedPairs(const Traversal& work, const GroupPair& leaves) {
  LanePairs pairs = 0;
  const ExcludedGroups* end = work.excluded + work.firstExcluded[leaves.a + 1];
  for (const ExcludedGroups* e = work.excluded + work.firstExcluded[leaves.a]; e != end; ++e)
    for (int k = 0; k < 4; ++k) pairs |= e->pairs[k] & -LanePairs(e->group[k] == leaves.b);
  return pairs;
}

// Keeps the pairs of leaves that hold tubes whose boxes meet, and which those are.
HWY_INLINE std::size_t meetLeaves(const Traversal& work, GroupPair* leaves, std::size_t count,
                                  LanePairs* meeting) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const GroupPair pair = leaves[k];
    const LanePairs once = pair.a == pair.b ? kUpper : ~LanePairs(0);
    const LanePairs pairs = overlaps(work.tree.boxes[pair.a], work.tree.boxes[pair.b]) &
                            movedPairs(work.tree.moved[pair.a], work.tree.moved[pair.b]) & once;
    leaves[kept] = pair;
    meeting[kept] = pairs & ~excludedPairs(work, pair);
    kept += meeting[kept] != 0;
  }
  return kept;
}

// @param meeting  has a zero behind its last
HWY_INLINE void listCandidates(Traversal& work, const GroupPair* leaves, const LanePairs* meeting,
                               std::size_t count) {
  TubePair* out = work.candidates + work.candidateCount;
  LanePairs pairs = meeting[0];
  for (std::size_t k = 0; k < count; ++out) {
    const std::uint32_t bit = std::uint32_t(__builtin_ctzll(pairs));
    out->i = work.tree.boxes[leaves[k].a].tubes[bit / kGroup];
    out->j = work.tree.boxes[leaves[k].b].tubes[bit % kGroup];
    // What is read next lies anywhere in memory once the tubes are more than the cache holds.
    hwy::Prefetch(work.tree.tubes + out->i);
    hwy::Prefetch(work.tree.tubes + out->j);
    pairs &= pairs - 1;
    k += pairs == 0;
    pairs |= meeting[k] & -LanePairs(pairs == 0);
  }
  work.candidateCount = std::size_t(out - work.candidates);
}

// In stages without branches on what was found: in a large tree the processor would guess most of them
// wrongly, and each wrong guess also holds up the reads behind it.
void traverse(Traversal& work, std::size_t enough) {
  GroupPair leaves[kLeafBatch + kGroupPairs];
  LanePairs meeting[kLeafBatch + kGroupPairs + 1];
  while (work.stackSize > 0 && work.candidateCount < enough) {
    const std::size_t count = meetLeaves(work, leaves, findLeaves(work, leaves), meeting);
    meeting[count] = 0;
    listCandidates(work, leaves, meeting, count);
  }
}

// ---- chord capsules: a lane is a candidate

constexpr std::size_t kMaxLanes = 16;

std::size_t meetCapsules(const BoxTreeView& tree, const TubePair* candidates, std::size_t count,
                         PiecePair* pieces) {
  const FN d;
  const hn::RebindToSigned<FN> di;
  using V = hn::Vec<FN>;
  std::size_t kept = 0;
  HWY_ALIGN std::int32_t first[kMaxLanes], second[kMaxLanes];
  for (std::size_t begin = 0; begin < count; begin += hn::Lanes(d)) {
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      const TubePair& pair = candidates[begin + lane < count ? begin + lane : count - 1];
      first[lane] = std::int32_t(pair.i * 16);
      second[lane] = std::int32_t(pair.j * 16);
    }
    const TubeLanes<V> a = gatherTubes(d, tree, hn::Load(di, first));
    const TubeLanes<V> b = gatherTubes(d, tree, hn::Load(di, second));
    const Vec3<V> w = a.p[0] - b.p[0], u = a.p[3] - a.p[0], v = b.p[3] - b.p[0];
    const V reach = hn::Add(capsuleRadius(d, a, u), capsuleRadius(d, b, v));
    const auto near = nearestOnSegments(d, w, u, v);
    const std::uint32_t meet = bitsOf(d, hn::Le(hn::Sub(near.squared, near.slack), hn::Mul(reach, reach)));
    const std::size_t used = count - begin < hn::Lanes(d) ? count - begin : hn::Lanes(d);
    // Written always, kept if the bit is set: no branch to be guessed.
    for (std::size_t lane = 0; lane < used; ++lane) {
      const TubePair& pair = candidates[begin + lane];
      pieces[kept] = {pair.i, pair.j, 0, 0, std::uint32_t(kept)};
      kept += meet >> lane & 1;
    }
  }
  return kept;
}

// ---- narrow phase: a lane is a candidate

template <class V>
struct Ball {
  Vec3<V> centre;
  V radius;
};

// The true curve at t.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Ball<V> ballAt(D d, const TubeLanes<V>& tube, V t) {
  const V one = hn::Set(d, 1.0f), three = hn::Set(d, 3.0f), s = hn::Sub(one, t);
  const V ss = hn::Mul(s, s), tt = hn::Mul(t, t);
  const V w0 = hn::Mul(ss, s), w1 = hn::Mul(three, hn::Mul(ss, t)), w2 = hn::Mul(three, hn::Mul(s, tt)),
          w3 = hn::Mul(tt, t);
  const auto mix = [&](V a, V b, V c, V e) HWY_ATTR {
    return hn::MulAdd(w0, a, hn::MulAdd(w1, b, hn::MulAdd(w2, c, hn::Mul(w3, e))));
  };
  return {{mix(tube.p[0].x, tube.p[1].x, tube.p[2].x, tube.p[3].x),
           mix(tube.p[0].y, tube.p[1].y, tube.p[2].y, tube.p[3].y),
           mix(tube.p[0].z, tube.p[1].z, tube.p[2].z, tube.p[3].z)},
          mix(tube.r[0], tube.r[1], tube.r[2], tube.r[3])};
}

// Filip's bounds for centre line and radius of a piece of length 2^-level, together.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V deviation(D d, const TubeLanes<V>& tube, int level) {
  const V two = hn::Set(d, 2.0f);
  V largest = hn::Zero(d), radius = hn::Zero(d);
  for (int k = 0; k < 2; ++k) {
    const Vec3<V> bend = tube.p[k] + tube.p[k + 2] - scaled(tube.p[k + 1], two);
    largest = hn::Max(largest, dot(bend, bend));
    radius = hn::Max(radius, hn::Abs(hn::NegMulAdd(two, tube.r[k + 1], hn::Add(tube.r[k], tube.r[k + 2]))));
  }
  return hn::Mul(hn::Add(hn::Sqrt(largest), radius), hn::Set(d, 0.75f / float(1 << (2 * level))));
}

template <class V>
HWY_INLINE V largestCoordinate(const TubeLanes<V>& tube) {
  V largest = tube.r[0];
  for (int k = 0; k < 4; ++k) largest = hn::Max(largest, hn::Max(largestCoordinate(tube.p[k]), tube.r[k]));
  return largest;
}

std::size_t narrow(const BoxTreeView& tree, int level, const PiecePair* pieces, std::size_t count,
                   std::uint8_t* settled, PiecePair* halves) {
  const FN d;
  const hn::RebindToSigned<FN> di;
  using V = hn::Vec<FN>;
  std::size_t open = 0;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN std::int32_t first[kMaxLanes], second[kMaxLanes];
  HWY_ALIGN float fromS[kMaxLanes], fromT[kMaxLanes];
  const float halfLength = 0.5f / float(1 << level);
  const V half = hn::Set(d, halfLength), whole = hn::Set(d, 1.0f / float(1 << level));
  for (std::size_t begin = 0; begin < count; begin += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const PiecePair& pair = pieces[begin + lane < count ? begin + lane : count - 1];
      first[lane] = std::int32_t(pair.i * 16);
      second[lane] = std::int32_t(pair.j * 16);
      fromS[lane] = pair.s;
      fromT[lane] = pair.t;
    }
    TubeLanes<V> a = gatherTubes(d, tree, hn::Load(di, first));
    TubeLanes<V> b = gatherTubes(d, tree, hn::Load(di, second));
    const Vec3<V> origin = a.p[0];
    for (int k = 0; k < 4; ++k) a.p[k] = a.p[k] - origin, b.p[k] = b.p[k] - origin;
    const V rounding = hn::Mul(hn::Set(d, 8 * kEpsilon), hn::Add(largestCoordinate(a), largestCoordinate(b)));
    const V slackReach = hn::Add(hn::Add(deviation(d, a, level + 1), deviation(d, b, level + 1)), rounding);
    const V s0 = hn::Load(d, fromS), t0 = hn::Load(d, fromT);
    const Ball<V> sampleA[3] = {ballAt(d, a, s0), ballAt(d, a, hn::Add(s0, half)),
                                ballAt(d, a, hn::Add(s0, whole))};
    const Ball<V> sampleB[3] = {ballAt(d, b, t0), ballAt(d, b, hn::Add(t0, half)),
                                ballAt(d, b, hn::Add(t0, whole))};
    V bestGap = hn::Set(d, 3e38f), bestS = hn::Zero(d), bestT = hn::Zero(d);
    std::uint32_t mayMeet[4];
    for (int child = 0; child < 4; ++child) {
      const int i = child / 2, j = child % 2;
      const auto near = nearestOnSegments(d, sampleA[i].centre - sampleB[j].centre,
                                          sampleA[i + 1].centre - sampleA[i].centre,
                                          sampleB[j + 1].centre - sampleB[j].centre);
      const V radii = hn::Add(hn::Max(sampleA[i].radius, sampleA[i + 1].radius),
                              hn::Max(sampleB[j].radius, sampleB[j + 1].radius));
      const V reach = hn::Add(radii, slackReach);
      mayMeet[child] = bitsOf(d, hn::Le(hn::Sub(near.squared, near.slack), hn::Mul(reach, reach)));
      const V gap = hn::Sub(hn::Sqrt(near.squared), radii);
      const auto better = hn::Lt(gap, bestGap);
      bestGap = hn::Min(gap, bestGap);
      bestS = hn::IfThenElse(better, hn::MulAdd(half, hn::Add(near.s, hn::Set(d, float(i))), s0), bestS);
      bestT = hn::IfThenElse(better, hn::MulAdd(half, hn::Add(near.t, hn::Set(d, float(j))), t0), bestT);
    }
    const Ball<V> ballA = ballAt(d, a, bestS), ballB = ballAt(d, b, bestT);
    const Vec3<V> between = ballA.centre - ballB.centre;
    const V sure = hn::Max(hn::Sub(hn::Add(ballA.radius, ballB.radius), rounding), hn::Zero(d));
    const std::uint32_t meet = bitsOf(d, hn::Lt(dot(between, between), hn::Mul(sure, sure)));
    const std::size_t used = count - begin < lanes ? count - begin : lanes;
    for (std::size_t lane = 0; lane < used; ++lane) {
      const PiecePair& piece = pieces[begin + lane];
      settled[piece.candidate] |= std::uint8_t(meet >> lane & 1);
      const std::uint32_t still = settled[piece.candidate] ^ 1u;
      for (std::uint32_t child = 0; child < 4; ++child) {
        halves[open] = {piece.i, piece.j, piece.s + halfLength * float(child / 2),
                        piece.t + halfLength * float(child % 2), piece.candidate};
        open += mayMeet[child] >> lane & still;
      }
    }
  }
  return open;
}

}  // namespace
}  // namespace vasa::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
