// Included once for each instruction set (no include guard: see kernels.cpp).
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vasa::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F8 = hn::CappedTag<float, kGroup>;
using FN = hn::CappedTag<float, 16>;
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

// ---- refit

// Component c (0..15: point c/4, coordinate c%4) of the tubes whose first floats lie at `at`.
template <class D, class VI>
HWY_INLINE hn::Vec<D> component(D d, const float* tubes, VI at, int c) {
  return hn::GatherIndex(d, tubes + c, at);
}

void fitLeaves(const BoxTreeView& tree, const float* tubes, float grow, std::uint32_t begin,
               std::uint32_t end) {
  const F8 d;
  const hn::RebindToSigned<F8> di;
  using V = hn::Vec<F8>;
  const hn::CappedTag<float, 16> whole;
  const V relative = hn::Set(d, 2 * kEpsilon), third = hn::Set(d, 1.0f / 3);
  HWY_ALIGN float growth[16] = {};
  for (int k = 0; k < 4; ++k) growth[4 * k + 3] = grow;
  constexpr std::uint32_t kAhead = 3 * kGroup;
  for (std::uint32_t group = begin; group < end; ++group) {
    // In the caller's order a group's tubes lie anywhere: ask for those of later groups now.
    float* own = &tree.shapes[group * kGroup].b[0].x;
    for (std::uint32_t lane = 0; lane < kGroup; ++lane) {
      const std::uint32_t slot = group * kGroup + lane, later = slot + kAhead;
      if (later < end * kGroup) hwy::Prefetch(tubes + std::size_t(16) * tree.tubes[later]);
      const float* from = tubes + std::size_t(16) * tree.tubes[slot];
      for (std::size_t k = 0; k < 16; k += hn::Lanes(whole))
        hn::StoreU(hn::Add(hn::LoadU(whole, from + k), hn::Load(whole, growth + k)), whole,
                   own + 16 * lane + k);
    }
    BoxGroup& box = tree.boxes[group];
    HWY_ALIGN float capsule[7][kGroup];  // start, radius, chord
    for (std::uint32_t lane = 0; lane < kGroup; lane += std::uint32_t(hn::Lanes(d))) {
      const auto at = hn::ShiftLeft<4>(hn::Iota(di, std::int32_t(lane)));
      V r[4];
      for (int k = 0; k < 4; ++k) r[k] = component(d, own, at, 4 * k + 3);
      const V radius = hn::Max(hn::Max(r[0], r[1]), hn::Max(r[2], r[3]));
      V low[3], high[3], first[3], last[3];
      V e1 = hn::Zero(d), e2 = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis) {
        V p[4];
        for (int k = 0; k < 4; ++k) p[k] = component(d, own, at, 4 * k + axis);
        low[axis] = hn::Min(hn::Min(hn::Sub(p[0], r[0]), hn::Sub(p[1], r[1])),
                            hn::Min(hn::Sub(p[2], r[2]), hn::Sub(p[3], r[3])));
        high[axis] = hn::Max(hn::Max(hn::Add(p[0], r[0]), hn::Add(p[1], r[1])),
                             hn::Max(hn::Add(p[2], r[2]), hn::Add(p[3], r[3])));
        const V chord = hn::Sub(p[3], p[0]);
        const V x1 = hn::NegMulAdd(third, chord, hn::Sub(p[1], p[0])),
                x2 = hn::MulAdd(third, chord, hn::Sub(p[2], p[3]));
        e1 = hn::MulAdd(x1, x1, e1);
        e2 = hn::MulAdd(x2, x2, e2);
        first[axis] = p[0];
        last[axis] = p[3];
        hn::Store(p[0], d, &capsule[axis][lane]);
        hn::Store(chord, d, &capsule[4 + axis][lane]);
      }
      const V deviation = hn::Mul(hn::Set(d, 0.75f), hn::Sqrt(hn::Max(e1, e2)));
      const V reach = hn::Mul(hn::Add(radius, deviation), hn::Set(d, kReachSlack));
      V size = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis)
        size = hn::Max(size, hn::Max(hn::Abs(first[axis]), hn::Abs(last[axis])));
      const V rounding = hn::Mul(relative, hn::Add(size, reach));
      hn::Store(reach, d, &capsule[3][lane]);
      // Two boxes hold the tube: the hull's and the capsule's. Their intersection does too.
      for (int axis = 0; axis < 3; ++axis) {
        const V capsuleLow = hn::Sub(hn::Min(first[axis], last[axis]), reach);
        const V capsuleHigh = hn::Add(hn::Max(first[axis], last[axis]), reach);
        hn::Store(hn::Sub(hn::Max(low[axis], capsuleLow), rounding), d, &box.low[axis][lane]);
        hn::Store(hn::Add(hn::Min(high[axis], capsuleHigh), rounding), d, &box.high[axis][lane]);
      }
    }
    float* out = tree.capsules[group * kGroup].start;
    for (std::uint32_t lane = 0; lane < kGroup; ++lane)
      for (std::uint32_t c = 0; c < 7; ++c) out[8 * lane + c] = capsule[c][lane];
  }
  if (end * kGroup > tree.tubeCount && begin < end) {
    for (std::uint32_t slot = tree.tubeCount; slot < end * kGroup; ++slot)
      for (int axis = 0; axis < 3; ++axis) {
        tree.boxes[slot / kGroup].low[axis][slot % kGroup] = std::numeric_limits<float>::infinity();
        tree.boxes[slot / kGroup].high[axis][slot % kGroup] = -std::numeric_limits<float>::infinity();
      }
  }
}

void fitLevel(const BoxTreeView& tree, std::uint32_t level, std::uint32_t begin, std::uint32_t end) {
  const F8 d;
  const BoxGroup* children = &tree.boxes[tree.levelStart[level - 1]];
  const std::uint32_t childCount = tree.levelStart[level] - tree.levelStart[level - 1];
  for (std::uint32_t group = begin; group < end; ++group) {
    BoxGroup& box = tree.boxes[tree.levelStart[level] + group];
    for (std::uint32_t lane = 0; lane < kGroup; ++lane) {
      const std::uint32_t child = group * kGroup + lane;
      for (int axis = 0; axis < 3; ++axis) {
        if (child >= childCount) {
          box.low[axis][lane] = std::numeric_limits<float>::infinity();
          box.high[axis][lane] = -std::numeric_limits<float>::infinity();
          continue;
        }
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
  const F8 d;
  LanePairs pairs = 0;
  for (std::size_t k = 0; k < kGroup; k += hn::Lanes(d)) {
    const auto lowX = hn::Load(d, b.low[0] + k), lowY = hn::Load(d, b.low[1] + k),
               lowZ = hn::Load(d, b.low[2] + k);
    const auto highX = hn::Load(d, b.high[0] + k), highY = hn::Load(d, b.high[1] + k),
               highZ = hn::Load(d, b.high[2] + k);
    std::uint8_t rows[kGroup + 8];
    for (std::size_t i = 0; i < kGroup; ++i) {
      const auto x = hn::And(hn::Le(hn::Set(d, a.low[0][i]), highX), hn::Le(lowX, hn::Set(d, a.high[0][i])));
      const auto y = hn::And(hn::Le(hn::Set(d, a.low[1][i]), highY), hn::Le(lowY, hn::Set(d, a.high[1][i])));
      const auto z = hn::And(hn::Le(hn::Set(d, a.low[2][i]), highZ), hn::Le(lowZ, hn::Set(d, a.high[2][i])));
      hn::StoreMaskBits(d, hn::And(x, hn::And(y, z)), rows + i);
    }
    LanePairs part;
    hwy::CopyBytes<8>(rows, &part);
    pairs |= part << k;
  }
  return pairs;
}

// Of a group against itself: each pair once.
constexpr LanePairs kUpper = 0x80c0e0f0f8fcfeull;          // q > p
constexpr LanePairs kUpperOrSelf = 0x80c0e0f0f8fcfeffull;  // q >= p

void meetGroups(Traversal& work, std::uint32_t ga, std::uint32_t gb) {
  LanePairs pairs = overlaps(work.tree.boxes[ga], work.tree.boxes[gb]);
  if (ga == gb) pairs &= kUpper;
  if (pairs == 0) return;
  const ExcludedGroup* end = work.excluded + work.firstExcluded[ga + 1];
  for (const ExcludedGroup* e = work.excluded + work.firstExcluded[ga]; e != end; ++e)
    if (e->group == gb) pairs &= ~e->pairs;
  for (; pairs; pairs &= pairs - 1) {
    const std::uint32_t bit = std::uint32_t(__builtin_ctzll(pairs));
    work.candidates[work.candidateCount++] = {ga * kGroup + bit / kGroup, gb * kGroup + bit % kGroup};
    // What is read next lies anywhere in memory once the tree is larger than the cache.
    hwy::Prefetch(&work.tree.capsules[ga * kGroup + bit / kGroup]);
    hwy::Prefetch(&work.tree.capsules[gb * kGroup + bit % kGroup]);
  }
}

void openNode(Traversal& work) {
  const GroupPair top = work.stack[--work.stackSize];
  const BoxGroup* boxes = &work.tree.boxes[work.tree.levelStart[top.level]];
  const BoxGroup* below = &work.tree.boxes[work.tree.levelStart[top.level - 1]];
  LanePairs pairs = overlaps(boxes[top.a], boxes[top.b]);
  if (top.a == top.b) pairs &= kUpperOrSelf;
  for (; pairs; pairs &= pairs - 1) {
    const std::uint32_t bit = std::uint32_t(__builtin_ctzll(pairs));
    work.stack[work.stackSize++] = {top.level - 1, top.a * kGroup + bit / kGroup,
                                    top.b * kGroup + bit % kGroup};
    const BoxGroup* later = &below[top.b * kGroup + bit % kGroup];
    hwy::Prefetch(&later->low[0]);
    hwy::Prefetch(&later->low[2]);
    hwy::Prefetch(&later->high[1]);
  }
}

void traverse(Traversal& work, std::size_t enough) {
  while (work.stackSize > 0 && work.candidateCount < enough) {
    const GroupPair top = work.stack[work.stackSize - 1];
    if (top.level > 0) {
      openNode(work);
    } else {
      --work.stackSize;
      meetGroups(work, top.a, top.b);
    }
  }
}

// ---- chord capsules: a lane is a candidate

constexpr std::size_t kMaxLanes = 16;

std::size_t meetCapsules(const BoxTreeView& tree, const TubePair* candidates, std::size_t count,
                         PiecePair* pieces) {
  const FN d;
  const hn::RebindToSigned<FN> di;
  using V = hn::Vec<FN>;
  const float* base = tree.capsules[0].start;
  std::size_t kept = 0;
  HWY_ALIGN std::int32_t first[kMaxLanes], second[kMaxLanes];
  for (std::size_t begin = 0; begin < count; begin += hn::Lanes(d)) {
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      const TubePair& pair = candidates[begin + lane < count ? begin + lane : count - 1];
      first[lane] = std::int32_t(pair.i * 8);
      second[lane] = std::int32_t(pair.j * 8);
    }
    const auto at = hn::Load(di, first), bt = hn::Load(di, second);
    const auto load = [&](decltype(at) index, int c) HWY_ATTR { return hn::GatherIndex(d, base + c, index); };
    const Vec3<V> w = {hn::Sub(load(at, 0), load(bt, 0)), hn::Sub(load(at, 1), load(bt, 1)),
                       hn::Sub(load(at, 2), load(bt, 2))};
    const V reach = hn::Add(load(at, 3), load(bt, 3));
    const Vec3<V> u = {load(at, 4), load(at, 5), load(at, 6)}, v = {load(bt, 4), load(bt, 5), load(bt, 6)};
    const auto near = nearestOnSegments(d, w, u, v);
    const std::uint32_t meet = bitsOf(d, hn::Le(hn::Sub(near.squared, near.slack), hn::Mul(reach, reach)));
    const std::size_t used = count - begin < hn::Lanes(d) ? count - begin : hn::Lanes(d);
    // Written always, kept if the bit is set: no branch to be guessed.
    for (std::size_t lane = 0; lane < used; ++lane) {
      const TubePair& pair = candidates[begin + lane];
      pieces[kept] = {pair.i, pair.j, 0, 0, std::uint32_t(kept)};
      hwy::Prefetch(&tree.shapes[pair.i]);
      hwy::Prefetch(&tree.shapes[pair.j]);
      kept += meet >> lane & 1;
    }
  }
  return kept;
}

// ---- narrow phase: a lane is a candidate

template <class V>
struct TubeLanes {
  Vec3<V> p[4];
  V r[4];
};

template <class D, class VI, class V = hn::Vec<D>>
HWY_INLINE TubeLanes<V> gatherTubes(D d, const float* base, VI at) {
  TubeLanes<V> tube;
  for (int k = 0; k < 4; ++k) {
    tube.p[k] = {component(d, base, at, 4 * k), component(d, base, at, 4 * k + 1),
                 component(d, base, at, 4 * k + 2)};
    tube.r[k] = component(d, base, at, 4 * k + 3);
  }
  return tube;
}

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

template <class D, class V = hn::Vec<D>>
HWY_INLINE V largestCoordinate(D d, const TubeLanes<V>& tube) {
  V largest = hn::Zero(d);
  for (int k = 0; k < 4; ++k)
    largest = hn::Max(largest, hn::Max(hn::Max(hn::Abs(tube.p[k].x), hn::Abs(tube.p[k].y)),
                                       hn::Max(hn::Abs(tube.p[k].z), tube.r[k])));
  return largest;
}

std::size_t narrow(const BoxTreeView& tree, int level, const PiecePair* pieces, std::size_t count,
                   std::uint8_t* settled, PiecePair* halves) {
  const float* base = &tree.shapes[0].b[0].x;
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
    TubeLanes<V> a = gatherTubes(d, base, hn::Load(di, first));
    TubeLanes<V> b = gatherTubes(d, base, hn::Load(di, second));
    const Vec3<V> origin = a.p[0];
    for (int k = 0; k < 4; ++k) a.p[k] = a.p[k] - origin, b.p[k] = b.p[k] - origin;
    const V rounding =
        hn::Mul(hn::Set(d, 8 * kEpsilon), hn::Add(largestCoordinate(d, a), largestCoordinate(d, b)));
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
